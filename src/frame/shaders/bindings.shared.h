// Binding points of the frame, shared by C++ and GLSL. A technique's own passes use units and bindings from 24 up
// (textures), 8 up (blocks).
#ifndef SHOAL_FRAME_BINDINGS_SHARED_H
#define SHOAL_FRAME_BINDINGS_SHARED_H

// Uniform blocks.
#define SHOAL_BLOCK_VIEW 0    // ViewBlock: matrices, eye, size, time (frame/view.shared.h)
#define SHOAL_BLOCK_LIGHT 1   // LightBlock: sun, environment, counts (frame/light.shared.h)
#define SHOAL_BLOCK_SHADOW 2  // ShadowBlock: cascades, spots (frame/shadow.shared.h)
#define SHOAL_BLOCK_PASS 3    // the pass's own parameters

// Storage blocks.
#define SHOAL_STORAGE_INSTANCES 0
#define SHOAL_STORAGE_MATERIALS 1
#define SHOAL_STORAGE_LIGHTS 2  // punctual lights
#define SHOAL_STORAGE_PASS 3    // 3..7: the pass's own

// Texture units.
#define SHOAL_UNIT_PASS 0        // 0..7: the pass's own inputs; the shading pass: G-buffer
#define SHOAL_UNIT_BASE_COLOR 8  // 8..12: a material's textures
#define SHOAL_UNIT_METAL_ROUGH 9
#define SHOAL_UNIT_NORMAL 10
#define SHOAL_UNIT_OCCLUSION 11
#define SHOAL_UNIT_EMISSION 12
#define SHOAL_UNIT_OPAQUE_COPY 13
#define SHOAL_UNIT_OPAQUE_DEPTH 14            // view depth behind transparent surfaces
#define SHOAL_UNIT_ENVIRONMENT 16             // lat-long or cube, sharp
#define SHOAL_UNIT_SPECULAR 17                // prefiltered by roughness
#define SHOAL_UNIT_ENVIRONMENT_IRRADIANCE 18  // LightOverrides::environmentIrradiance
#define SHOAL_UNIT_SUN_SHADOW 19              // depth array, plain (blocker search)
#define SHOAL_UNIT_SUN_SHADOW_CMP 20          // the same with comparison
#define SHOAL_UNIT_SPOT_SHADOW 21             // depth array with comparison
#define SHOAL_UNIT_AO 22
#define SHOAL_UNIT_SUN_IRRADIANCE 23  // LightOverrides::sunIrradiance

#endif
