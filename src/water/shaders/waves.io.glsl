// The wave field at a point: height above the mean level and its derivatives. GpuWaves::bind() binds what it reads; the
// same numbers as WaveField::at. Where a field has no tiles or no circular wave a program may leave their code out by
// SHOAL_WAVES_NO_TILES, SHOAL_WAVES_NO_CIRCLE (waveDefines): llvmpipe runs it in any case.
#ifndef SHOAL_WATER_WAVES_IO_GLSL
#define SHOAL_WATER_WAVES_IO_GLSL

#include "water/waves.shared.h"

// A layer a tile: (h, hx, hz, hxz); its mips hold means of (h, hx, hz, hx^2 + hz^2). Repeats.
layout(binding = SHOAL_UNIT_WAVE_TILES) uniform sampler2DArray waveTiles;

struct Wave {
    float h;          // metres
    vec2 slope;       // dh/dx, dh/dz
    vec3 curvature;   // hxx, hxz, hzz, 1/m
};

// What is left of the waves where a pixel covers many of them.
struct FilteredWave {
    float h;                // metres, mean
    vec2 slope;             // mean
    float slopeVariance;    // of the slopes left out: mean of |slope - mean|^2, both axes together
};

const float kWaveTurn = 6.283185307;

// Sine and cosine of `turns` whole turns: minimax polynomials, off by 3e-7. Faster on llvmpipe than its own, which each
// reduce the angle again, and the same on every device.
vec2 waveSinCos(float turns) {
    float u = turns - floor(turns + 0.5), a = abs(u);
    vec2 v = vec2(0.25 - abs(a - 0.25), 0.25 - a), q = v * v;
    v *= 6.283185005 + q * (-41.34165573 + q * (81.60100555 + q * (-76.54977982 + q * 39.53670502)));
    return vec2(u < 0.0 ? -v.x : v.x, v.y);
}

// Turns of plane wave p at `whole` metres and a `part` of one (0..1), without most whole ones.
float wavePlaneTurns(vec4 p, vec2 whole, vec2 part) {
    vec2 first = floor(p.yz * waveBlock.center.w) * waveBlock.center.z;
    float exact = dot(first, whole);
    return (exact - floor(exact)) + (dot(p.yz - first, whole) + (dot(p.yz, part) + p.w));
}

// Texel coordinates in a tile: whole ones below 0 or above the size are to be wrapped.
void waveTexelAt(vec2 xz, int tile, out ivec2 corner, out vec2 part) {
    vec4 t = waveBlock.tiles[tile];
    vec2 metres = floor(xz), exact = t.x * metres, below = floor(exact);
    vec2 rest = (exact - below) + t.y * metres + (t.x + t.y) * (xz - metres), restBelow = floor(rest);
    corner = ivec2(below) + ivec2(restBelow);
    part = rest - restBelow;
}

// A cell's corners: texels (h, hx, hz, hxz).
struct WaveCell {
    vec4 left0, right0, left1, right1;
    vec2 part;       // 0..1 within
    float metres;    // side
};

WaveCell waveCellAt(vec2 xz, int tile) {
    WaveCell c;
    ivec2 corner;
    waveTexelAt(xz, tile, corner, c.part);
    int mask = int(waveBlock.counts.z) - 1;
    ivec2 a = corner & mask, b = (corner + 1) & mask;
    c.left0 = texelFetch(waveTiles, ivec3(a, tile), 0);
    c.right0 = texelFetch(waveTiles, ivec3(b.x, a.y, tile), 0);
    c.left1 = texelFetch(waveTiles, ivec3(a.x, b.y, tile), 0);
    c.right1 = texelFetch(waveTiles, ivec3(b, tile), 0);
    c.metres = waveBlock.tiles[tile].z;
    return c;
}

// Weights of the cubic through p0 and p1 with derivatives d0 and d1, d metres apart: of p1 - p0, d0 and d1, for the
// value above p0, the first and the second derivative.
vec3 cubicValue(float u, float d) {
    return vec3(u * u * (3.0 - 2.0 * u), u * (1.0 - u) * (1.0 - u) * d, u * u * (u - 1.0) * d);
}
vec3 cubicFirst(float u, float d) {
    return vec3(6.0 * u * (1.0 - u) / d, 1.0 + u * (3.0 * u - 4.0), u * (3.0 * u - 2.0));
}
vec3 cubicSecond(float u, float d) {
    return vec3((6.0 - 12.0 * u) / (d * d), (6.0 * u - 4.0) / d, (6.0 * u - 2.0) / d);
}

// (h, hz) or a derivative of them by x, in a row.
vec2 waveAlongX(vec3 w, vec4 left, vec4 right) { return w.x * (right.xz - left.xz) + w.y * left.yw + w.z * right.yw; }
// From the two rows' (value, derivative by z).
float waveAlongZ(vec3 w, vec2 row0, vec2 row1) { return w.x * (row1.x - row0.x) + w.y * row0.y + w.z * row1.y; }

// Height and slopes.
vec3 waveSlopeOfCell(WaveCell c) {
    vec3 x0 = cubicValue(c.part.x, c.metres), x1 = cubicFirst(c.part.x, c.metres);
    vec3 z0 = cubicValue(c.part.y, c.metres), z1 = cubicFirst(c.part.y, c.metres);
    vec2 h0 = c.left0.xz + waveAlongX(x0, c.left0, c.right0), h1 = c.left1.xz + waveAlongX(x0, c.left1, c.right1);
    vec2 s0 = waveAlongX(x1, c.left0, c.right0), s1 = waveAlongX(x1, c.left1, c.right1);
    return vec3(h0.x + waveAlongZ(z0, h0, h1), s0.x + waveAlongZ(z0, s0, s1), waveAlongZ(z1, h0, h1));
}

Wave waveAt(vec2 xz) {
    Wave w = Wave(0.0, vec2(0.0), vec3(0.0));
    int planeCount = int(waveBlock.counts.x), tileCount = int(waveBlock.counts.y);
    vec2 whole = floor(xz), part = xz - whole;
    for (int i = 0; i < planeCount; ++i) {
        vec4 p = waveBlock.planes[i];
        vec2 sc = p.x * waveSinCos(wavePlaneTurns(p, whole, part));
        w.h += sc.y;
        vec2 k = kWaveTurn * p.yz;
        w.slope -= sc.x * k;
        w.curvature -= sc.y * vec3(k.x * k.x, k.x * k.y, k.y * k.y);
    }
#ifndef SHOAL_WAVES_NO_CIRCLE
    if (waveBlock.circular.x != 0.0) {
        // a cos(k rho + phase), rho^2 = r^2 + 1 / k^2: derivatives along and across the radius.
        float k = waveBlock.circular.y;
        vec2 away = xz - waveBlock.center.xy;
        float rho = sqrt(dot(away, away) + 1.0 / (k * k));
        vec2 e = away / rho;
        vec2 sc = waveBlock.circular.x * waveSinCos(waveBlock.circular.w * rho + waveBlock.circular.z);
        float first = -k * sc.x, across = first / rho, along = -k * k * sc.y - across;
        w.h += sc.y;
        w.slope += first * e;
        w.curvature += vec3(along * e.x * e.x + across, along * e.x * e.y, along * e.y * e.y + across);
    }
#endif
#ifndef SHOAL_WAVES_NO_TILES
    for (int i = 0; i < tileCount; ++i) {
        WaveCell c = waveCellAt(xz, i);
        vec3 x0 = cubicValue(c.part.x, c.metres), x1 = cubicFirst(c.part.x, c.metres);
        vec3 x2 = cubicSecond(c.part.x, c.metres);
        vec3 z0 = cubicValue(c.part.y, c.metres), z1 = cubicFirst(c.part.y, c.metres);
        vec2 h0 = c.left0.xz + waveAlongX(x0, c.left0, c.right0), h1 = c.left1.xz + waveAlongX(x0, c.left1, c.right1);
        vec2 s0 = waveAlongX(x1, c.left0, c.right0), s1 = waveAlongX(x1, c.left1, c.right1);
        vec2 k0 = waveAlongX(x2, c.left0, c.right0), k1 = waveAlongX(x2, c.left1, c.right1);
        w.h += h0.x + waveAlongZ(z0, h0, h1);
        w.slope += vec2(s0.x + waveAlongZ(z0, s0, s1), waveAlongZ(z1, h0, h1));
        w.curvature += vec3(k0.x + waveAlongZ(z0, k0, k1), waveAlongZ(z1, s0, s1),
                            waveAlongZ(cubicSecond(c.part.y, c.metres), h0, h1));
    }
#endif
    return w;
}

// Height and slopes alone.
vec3 waveSlopeAt(vec2 xz) {
    vec3 w = vec3(0.0);
    int planeCount = int(waveBlock.counts.x), tileCount = int(waveBlock.counts.y);
    vec2 whole = floor(xz), part = xz - whole;
    for (int i = 0; i < planeCount; ++i) {
        vec4 p = waveBlock.planes[i];
        vec2 sc = p.x * waveSinCos(wavePlaneTurns(p, whole, part));
        w += vec3(sc.y, (-kWaveTurn * sc.x) * p.yz);
    }
#ifndef SHOAL_WAVES_NO_CIRCLE
    if (waveBlock.circular.x != 0.0) {
        float k = waveBlock.circular.y;
        vec2 away = xz - waveBlock.center.xy;
        float rho = sqrt(dot(away, away) + 1.0 / (k * k));
        vec2 sc = waveBlock.circular.x * waveSinCos(waveBlock.circular.w * rho + waveBlock.circular.z);
        w += vec3(sc.y, -sc.x * k / rho * away);
    }
#endif
#ifndef SHOAL_WAVES_NO_TILES
    for (int i = 0; i < tileCount; ++i) w += waveSlopeOfCell(waveCellAt(xz, i));
#endif
    return w;
}

// Height alone: what a search along a ray asks for.
float waveHeightAt(vec2 xz) {
    float h = 0.0;
    int planeCount = int(waveBlock.counts.x), tileCount = int(waveBlock.counts.y);
    vec2 whole = floor(xz), part = xz - whole;
    for (int i = 0; i < planeCount; ++i)
        h += waveBlock.planes[i].x * waveSinCos(wavePlaneTurns(waveBlock.planes[i], whole, part)).y;
#ifndef SHOAL_WAVES_NO_CIRCLE
    if (waveBlock.circular.x != 0.0) {
        float k = waveBlock.circular.y;
        vec2 away = xz - waveBlock.center.xy;
        float rho = sqrt(dot(away, away) + 1.0 / (k * k));
        h += waveBlock.circular.x * waveSinCos(waveBlock.circular.w * rho + waveBlock.circular.z).y;
    }
#endif
#ifndef SHOAL_WAVES_NO_TILES
    for (int i = 0; i < tileCount; ++i) {
        WaveCell c = waveCellAt(xz, i);
        vec3 x0 = cubicValue(c.part.x, c.metres);
        vec2 h0 = c.left0.xz + waveAlongX(x0, c.left0, c.right0), h1 = c.left1.xz + waveAlongX(x0, c.left1, c.right1);
        h += h0.x + waveAlongZ(cubicValue(c.part.y, c.metres), h0, h1);
    }
#endif
    return h;
}

// A plane wave (k2: its wave number squared) seen through a footprint: a square's mean has the variance
// footprint^2 / 12 an axis, and a bell of that variance is what waves are weighted with.
float waveFade(float k2, float footprintM) { return exp(-k2 * footprintM * footprintM / 24.0); }

// Mean height and slopes over a square of footprintM metres round the point, and how much the slopes vary within.
FilteredWave waveSlopeFiltered(vec2 xz, float footprintM) {
    vec3 w = vec3(0.0);
    float variance = 0.0;
    int planeCount = int(waveBlock.counts.x), tileCount = int(waveBlock.counts.y);
    vec2 whole = floor(xz), part = xz - whole;
    for (int i = 0; i < planeCount; ++i) {
        vec4 p = waveBlock.planes[i];
        float k2 = kWaveTurn * kWaveTurn * dot(p.yz, p.yz), fade = waveFade(k2, footprintM);
        vec2 sc = fade * p.x * waveSinCos(wavePlaneTurns(p, whole, part));
        w += vec3(sc.y, (-kWaveTurn * sc.x) * p.yz);
        variance += 0.5 * (1.0 - fade * fade) * p.x * p.x * k2;
    }
#ifndef SHOAL_WAVES_NO_CIRCLE
    if (waveBlock.circular.x != 0.0) {
        float k = waveBlock.circular.y, a = waveBlock.circular.x, fade = waveFade(k * k, footprintM);
        vec2 away = xz - waveBlock.center.xy;
        float rho = sqrt(dot(away, away) + 1.0 / (k * k));
        vec2 sc = fade * a * waveSinCos(waveBlock.circular.w * rho + waveBlock.circular.z);
        w += vec3(sc.y, -sc.x * k / rho * away);
        variance += 0.5 * (1.0 - fade * fade) * a * a * k * k;
    }
#endif
#ifndef SHOAL_WAVES_NO_TILES
    for (int i = 0; i < tileCount; ++i) {
        ivec2 corner;
        vec2 f;
        waveTexelAt(xz, i, corner, f);
        float size = waveBlock.counts.z, level = log2(max(footprintM / waveBlock.tiles[i].z, 1.0));
        // Texel (0, 0) stands at the origin; a sampler puts its middle at half a texel.
        vec2 uv = (vec2(corner & (int(size) - 1)) + f + 0.5) / size;
        vec4 t = textureLod(waveTiles, vec3(uv, float(i)), max(level, 1.0));
        vec4 blurred = vec4(t.xyz, max(t.w - dot(t.yz, t.yz), 0.0));
        if (level < 1.0) blurred = mix(vec4(waveSlopeOfCell(waveCellAt(xz, i)), 0.0), blurred, level);
        w += blurred.xyz;
        variance += blurred.w;
    }
#endif
    return FilteredWave(w.x, w.yz, variance);
}

#endif
