// What a shading pass reads of light: block, local lights, environment. Lighting::bind() binds all of it.
#ifndef SHOAL_FRAME_LIGHTING_IO_GLSL
#define SHOAL_FRAME_LIGHTING_IO_GLSL

#include "frame/light.shared.h"

layout(std430, binding = SHOAL_STORAGE_LIGHTS) readonly buffer LocalLights { LocalLight localLights[]; };

// Lat-long, mip-mapped.
layout(binding = SHOAL_UNIT_ENVIRONMENT) uniform sampler2D sharpEnvironment;
// On the square of brdf.lib.glsl, a roughness a mip level.
layout(binding = SHOAL_UNIT_SPECULAR) uniform sampler2D prefilteredEnvironment;
// 1 open.
layout(binding = SHOAL_UNIT_AO) uniform sampler2D occlusionTexture;

#endif
