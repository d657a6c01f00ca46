#version 450 core
// One thread turns the histogram into an exposure: the mean log luminance between two percentiles becomes kTarget.
// The darkest half hardly matters to what a photographer exposes for, and the brightest 2 % (lamps, the sun) must not
// darken the rest.
#include "frame/exposure.io.glsl"

layout(local_size_x = 1) in;
// x: fraction of the way to go this time, y: 1 forgets the past, z: 1 sets `antialiasing`
layout(location = 0) uniform vec4 rate;

const float kLowPercentile = 0.40;
const float kHighPercentile = 0.98;
// Two thirds of a stop above middle grey (0.18): what counts is the brighter part of the picture.
const float kTarget = 0.285;

void main() {
    float total = 0.0;
    for (int i = 0; i < SHOAL_EXPOSURE_BINS; ++i) total += float(exposureState.bins[i]);
    float low = total * kLowPercentile, high = total * kHighPercentile;
    float sum = 0.0, count = 0.0, before = 0.0;
    for (int i = 0; i < SHOAL_EXPOSURE_BINS; ++i) {
        float after = before + float(exposureState.bins[i]);
        float inside = max(min(after, high) - max(before, low), 0.0);
        sum += inside * (SHOAL_EXPOSURE_LOWEST + (float(i) + 0.5) * SHOAL_EXPOSURE_STOPS_A_BIN);
        count += inside;
        before = after;
        exposureState.bins[i] = 0u;
    }
    float measured = count > 0.0 ? kTarget / exp2(sum / count) : 1.0;
    if (rate.z > 0.0) {
        exposureState.antialiasing = measured;
        return;
    }
    bool fresh = rate.y > 0.0 || exposureState.known == 0u;
    float from = fresh ? measured : exposureState.adapted;
    exposureState.measured = measured;
    exposureState.adapted = from * exp2((log2(measured) - log2(from)) * rate.x);   // eyes adapt in stops
    exposureState.known = 1u;
}
