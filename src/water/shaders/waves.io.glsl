// The wave field at a point: height above the mean level and its derivatives. GpuWaves::bind() binds what it reads; the
// same numbers as WaveField::at.
#ifndef SHOAL_WATER_WAVES_IO_GLSL
#define SHOAL_WATER_WAVES_IO_GLSL

#include "water/waves.shared.h"

// Two layers a tile: (h, hx, hz, 0) and (hxx, hxz, hzz, 0); repeats, with mips.
layout(binding = SHOAL_UNIT_WAVE_TILES) uniform sampler2DArray waveTiles;

struct Wave {
    float h;          // metres
    vec2 slope;       // dh/dx, dh/dz
    vec3 curvature;   // hxx, hxz, hzz, 1/m
};

// Bilinear with exact weights: a sampler's have 8 bits.
vec4 waveTexel(vec2 xz, int tile, int layer) {
    int size = int(waveBlock.counts.z);
    vec2 at = xz * waveBlock.tiles[tile].x * float(size);
    vec2 corner = floor(at), f = at - corner;
    ivec2 a = ivec2(corner) & (size - 1), b = (a + 1) & (size - 1);
    int slice = 2 * tile + layer;
    vec4 low = mix(texelFetch(waveTiles, ivec3(a, slice), 0), texelFetch(waveTiles, ivec3(b.x, a.y, slice), 0), f.x);
    vec4 high = mix(texelFetch(waveTiles, ivec3(a.x, b.y, slice), 0), texelFetch(waveTiles, ivec3(b, slice), 0), f.x);
    return mix(low, high, f.y);
}

Wave waveAt(vec2 xz) {
    Wave w = Wave(0.0, vec2(0.0), vec3(0.0));
    int planeCount = int(waveBlock.counts.x), tileCount = int(waveBlock.counts.y);
    for (int i = 0; i < planeCount; ++i) {
        vec4 p = waveBlock.planes[i];
        float angle = p.y * xz.x + p.z * xz.y + p.w;
        float c = p.x * cos(angle), s = -p.x * sin(angle);
        w.h += c;
        w.slope += s * p.yz;
        w.curvature -= c * vec3(p.y * p.y, p.y * p.z, p.z * p.z);
    }
    if (waveBlock.circular.x != 0.0) {
        // a cos(k r + phase): derivatives along and across the radius.
        vec2 away = xz - waveBlock.center.xy;
        float r = max(length(away), 1e-4), k = waveBlock.circular.y;
        vec2 e = away / r;
        float angle = k * r + waveBlock.circular.z;
        float first = -waveBlock.circular.x * k * sin(angle), second = -waveBlock.circular.x * k * k * cos(angle);
        w.h += waveBlock.circular.x * cos(angle);
        w.slope += first * e;
        float across = first / r;
        w.curvature += vec3(second * e.x * e.x + across * e.y * e.y, (second - across) * e.x * e.y,
                            second * e.y * e.y + across * e.x * e.x);
    }
    for (int i = 0; i < tileCount; ++i) {
        vec4 t = waveTexel(xz, i, 0);
        w.h += t.x;
        w.slope += t.yz;
        w.curvature += waveTexel(xz, i, 1).xyz;
    }
    return w;
}

// Height and slopes alone.
vec3 waveSlopeAt(vec2 xz) {
    vec3 w = vec3(0.0);
    int planeCount = int(waveBlock.counts.x), tileCount = int(waveBlock.counts.y);
    for (int i = 0; i < planeCount; ++i) {
        vec4 p = waveBlock.planes[i];
        float angle = p.y * xz.x + p.z * xz.y + p.w;
        w += p.x * vec3(cos(angle), -sin(angle) * p.yz);
    }
    if (waveBlock.circular.x != 0.0) {
        vec2 away = xz - waveBlock.center.xy;
        float r = max(length(away), 1e-4), angle = waveBlock.circular.y * r + waveBlock.circular.z;
        w += waveBlock.circular.x * vec3(cos(angle), -sin(angle) * waveBlock.circular.y * away / r);
    }
    for (int i = 0; i < tileCount; ++i) w += waveTexel(xz, i, 0).xyz;
    return w;
}

#endif
