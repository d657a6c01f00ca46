// The state of exposure on the GPU: what exposure.comp measures and the passes behind it use.
#ifndef SHOAL_FRAME_EXPOSURE_IO_GLSL
#define SHOAL_FRAME_EXPOSURE_IO_GLSL

#include "frame/exposure.shared.h"

layout(std430, binding = SHOAL_STORAGE_PASS) buffer ExposureState {
    uint bins[SHOAL_EXPOSURE_BINS];   // pixels by log2 luminance
    float measured;                   // factor that brings the picture to middle grey, without the user's stops
    float adapted;                    // the same, following `measured` over time
    float antialiasing;               // factor that weighs samples for the display: displayWeight()
    uint known;                       // 1 when `adapted` has a value to go on from
} exposureState;

float luminanceOf(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// Weight of a sample among those of its pixel: the slope of a display curve at its brightness.
float displayWeight(vec3 radiance) { return 1.0 / (1.0 + luminanceOf(radiance) * exposureState.antialiasing); }

#endif
