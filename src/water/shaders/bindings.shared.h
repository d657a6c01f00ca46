// Binding points of the water technique (above the frame's: textures from 24, blocks from 8).
#ifndef SHOAL_WATER_BINDINGS_SHARED_H
#define SHOAL_WATER_BINDINGS_SHARED_H

// Uniform blocks.
#define SHOAL_BLOCK_WAVES 8        // WaveBlock (waves.shared.h)
#define SHOAL_BLOCK_LIGHT_SPACE 9  // LightSpaceBlock (light_space.shared.h)
#define SHOAL_BLOCK_WATER 10       // WaterBlock (water.shared.h): level, area, optics
#define SHOAL_BLOCK_WATER_PASS 11  // the pass's own

// Storage blocks: 8 to 11, the pass's own.
#define SHOAL_STORAGE_WATER 8

// Texture units.
#define SHOAL_UNIT_WAVE_TILES 24     // sampler2DArray
#define SHOAL_UNIT_LIT_DEPTH 25      // sampler2DArray: two layers a slot, height of what light meets
#define SHOAL_UNIT_AIR_DEPTH 26      // sampler2DArray: one layer a slot, what stands between light and water
#define SHOAL_UNIT_CAUSTIC_MAPS 27   // sampler2DArray: Photons::maps()
#define SHOAL_UNIT_SHAFT_SLICES 28   // sampler3D or array
#define SHOAL_UNIT_WATER_SURFACE 29  // sampler2D: WaterPaths::surfaceDepth
#define SHOAL_UNIT_WATER_NORMAL 30   // sampler2D: WaterPaths::surfaceNormal
#define SHOAL_UNIT_WATER_PATH 31     // sampler2D: WaterPaths::path

#endif
