// A body of water and its sun as passes read them (std140). Filled in src/water/surface/water_block.cpp.
#ifndef SHOAL_WATER_WATER_SHARED_H
#define SHOAL_WATER_WATER_SHARED_H

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::water {
using vec4 = Vec4;
#define SHOAL_WATER_BLOCK_BEGIN struct WaterBlock
#else
#include "water/bindings.shared.h"
#define SHOAL_WATER_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_WATER) uniform WaterBlock
#endif

SHOAL_WATER_BLOCK_BEGIN {
    vec4 shape;               // x: level m, y: index of refraction, z: 1 where the surface is drawn, w: bound on |h| m
    vec4 area;                // least x, z and greatest x, z of the water
    vec4 beamAttenuation;     // 1/m: Optics::beamAttenuation(); w: the least of the three
    vec4 beamScattering;      // 1/m: Optics::beamScattering()
    vec4 diffuseAttenuation;  // 1/m: Kd of light from above and from the sky
    vec4 sunDiffuseAttenuation;  // 1/m: Kd of the sun's light at its angle (diffuseAttenuationAt)
    vec4 scattering;             // 1/m: all of it, b
    vec4 phase;                  // of optics.lib.glsl's waterPhase
    vec4 toSun;                  // unit, world; w: 1 where there is a sun
    vec4 sunIrradiance;          // W/m2 on a plane facing the sun (in the air)
    vec4 sunRefracted;   // unit: where the sun's light travels under level water; w: Fresnel transmittance there
    vec4 skyIrradiance;  // W/m2 of the environment on a level plane in the air
}
#ifndef __cplusplus
waterBlock
#endif
    ;

#ifdef __cplusplus
}  // namespace shoal::water
#endif
#undef SHOAL_WATER_BLOCK_BEGIN

#endif
