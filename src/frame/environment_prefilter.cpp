// Prefilters an environment by the roughness of what reflects it, on the CPU: in this form (few samples through a
// pyramid) plain C++ on two cores takes a fraction of what the same loop takes in a compute shader on llvmpipe, and
// every machine gets the same bits.
//   [Karis 2013] Real Shading in Unreal Engine 4: the lobe seen along the normal stands for all.
//   [Krivanek & Colbert 2008] Real-time Shading with Filtered Importance Sampling: each sample reads the pyramid at the
//   level whose texels are as large as the solid angle that the sample stands for.
#include <array>
#include <cmath>

#include <shoal/core/parallel.h>
#include <shoal/core/random.h>

#include "frame/environment_map.h"
#include "frame/glsl_compat.h"

namespace shoal::frame {
namespace glsl {
#include "frame/brdf.lib.glsl"
}  // namespace glsl
namespace {

constexpr int kLargestSize = 256;  // texels a side of level 0
constexpr int kSmallestSize = 16;  // and of the last level; with 8 the facets of bilinear look-ups show on rough metal
constexpr int kSampleCount = 32;   // at the first filtered level; doubled from level to level

// A square of radiance with texel centres inside (unlike PrefilteredLevel): what samples are read from.
struct SourceLevel {
    int size = 0;
    std::vector<Vec3> radiance;

    // Beyond the border the square goes on mirrored about the border's middle: that is where the fold joins it.
    Vec3 texel(int x, int y) const {
        if (x < 0 || x >= size) x = x < 0 ? 0 : size - 1, y = size - 1 - y;
        if (y < 0 || y >= size) y = y < 0 ? 0 : size - 1, x = size - 1 - x;
        return radiance[std::size_t(y) * std::size_t(size) + std::size_t(x)];
    }
    Vec3 at(Vec3 direction) const {
        const glsl::vec2 square = glsl::squareFromDirection({direction.x, direction.y, direction.z});
        const float u = square.x * float(size) - 0.5f, v = square.y * float(size) - 0.5f;
        const int x = int(u + 1) - 1, y = int(v + 1) - 1;  // floors for u, v >= -1
        const float fx = u - float(x), fy = v - float(y);
        if (x >= 0 && y >= 0 && x + 1 < size && y + 1 < size) {
            const Vec3* p = &radiance[std::size_t(y) * std::size_t(size) + std::size_t(x)];
            return lerp(lerp(p[0], p[1], fx), lerp(p[size], p[size + 1], fx), fy);
        }
        return lerp(lerp(texel(x, y), texel(x + 1, y), fx), lerp(texel(x, y + 1), texel(x + 1, y + 1), fx), fy);
    }
};

Vec3 fromGlsl(glsl::vec3 v) { return {v.x, v.y, v.z}; }

// Mean radiance around a direction: the map's texels within the footprint, by a grid of bilinear look-ups.
SourceLevel resample(const light::Environment& environment, int size) {
    SourceLevel level{size, std::vector<Vec3>(std::size_t(size) * std::size_t(size))};
    // A texel of the square spans about 360 / (2 size) degrees; the map's spans 360 / width.
    const int side = std::clamp(environment.radiance.width / (2 * size), 1, 4);
    parallelFor(std::size_t(size), 4, [&](std::size_t y) {
        for (int x = 0; x < size; ++x) {
            Vec3 sum;
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i) {
                    const float u = (float(x) + (float(i) + 0.5f) / float(side)) / float(size);
                    const float v = (float(y) + (float(j) + 0.5f) / float(side)) / float(size);
                    sum += light::lookUp(environment, fromGlsl(glsl::directionFromSquare({u, v})));
                }
            level.radiance[y * std::size_t(size) + std::size_t(x)] = sum / float(side * side);
        }
    });
    return level;
}

SourceLevel halved(const SourceLevel& fine) {
    const int size = fine.size / 2;
    SourceLevel level{size, std::vector<Vec3>(std::size_t(size) * std::size_t(size))};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            level.radiance[std::size_t(y) * std::size_t(size) + std::size_t(x)] =
                (fine.texel(2 * x, 2 * y) + fine.texel(2 * x + 1, 2 * y) + fine.texel(2 * x, 2 * y + 1) +
                 fine.texel(2 * x + 1, 2 * y + 1)) *
                0.25f;
    return level;
}

// A direction to sample, about +z, its weight, and the source level to read.
struct LobeSample {
    Vec3 direction;
    float weight;
    int level;
};

std::vector<LobeSample> lobeSamples(float roughness, int count, int baseSize, int levelCount) {
    const float alpha = roughness * roughness;
    const float texelAngle = 4 * kPi / float(baseSize * baseSize);  // solid angle, sr
    std::vector<LobeSample> samples;
    for (int i = 0; i < count; ++i) {
        const float u = (float(i) + 0.5f) / float(count), v = float(radicalInverse(2, std::uint64_t(i)));
        // Half vectors distributed as D(h) cos(h), seen along the normal.
        const float cosHalf = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u)),
                    sinHalf = std::sqrt(std::max(1 - cosHalf * cosHalf, 0.0f));
        const Vec3 half{sinHalf * std::cos(2 * kPi * v), sinHalf * std::sin(2 * kPi * v), cosHalf};
        const Vec3 toLight = half * (2 * cosHalf) - Vec3{0, 0, 1};
        if (toLight.z <= 0) continue;
        // pdf of toLight = D cos(h) / (4 cos(h)).
        const float density = glsl::distributionGgx(cosHalf, alpha) / 4;
        const float sampleAngle = 1 / (float(count) * density);
        const float level = 0.5f * std::log2(sampleAngle / texelAngle) + 0.5f;
        samples.push_back({toLight, toLight.z, std::clamp(int(level + 0.5f), 0, levelCount - 1)});
    }
    float sum = 0;
    for (const LobeSample& s : samples) sum += s.weight;
    for (LobeSample& s : samples) s.weight /= sum;
    return samples;
}

// Any orthonormal frame about a unit vector [Duff et al. 2017].
std::array<Vec3, 2> tangents(Vec3 n) {
    const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {Vec3{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, Vec3{b, sign + n.y * n.y * a, -n.y}};
}

template <class F>
PrefilteredLevel filled(int size, const F& radianceAlong) {
    PrefilteredLevel level{size, std::vector<Vec3>(std::size_t(size) * std::size_t(size))};
    parallelFor(std::size_t(size), 2, [&](std::size_t y) {
        for (int x = 0; x < size; ++x)
            level.radiance[y * std::size_t(size) + std::size_t(x)] = radianceAlong(
                fromGlsl(glsl::directionFromSquare({float(x) / float(size - 1), float(y) / float(size - 1)})));
    });
    return level;
}

}  // namespace

std::vector<PrefilteredLevel> prefilterEnvironment(const light::Environment& environment) {
    int size = 2 * kSmallestSize;
    while (size < kLargestSize && 2 * size <= environment.radiance.width / 2) size *= 2;
    std::vector<SourceLevel> source{resample(environment, size)};
    while (source.back().size > 4) source.push_back(halved(source.back()));

    int levelCount = 1;
    while (size >> levelCount >= kSmallestSize) ++levelCount;
    std::vector<PrefilteredLevel> levels{filled(size, [&](Vec3 d) { return source[0].at(d); })};
    for (int l = 1; l < levelCount; ++l) {
        const float roughness = glsl::roughnessOfLevel(float(l), float(levelCount));
        const std::vector<LobeSample> samples =
            lobeSamples(roughness, kSampleCount << (l - 1), size, int(source.size()));
        levels.push_back(filled(size >> l, [&](Vec3 n) {
            const auto [t, b] = tangents(n);
            Vec3 sum;
            for (const LobeSample& s : samples)
                sum += source[std::size_t(s.level)].at(t * s.direction.x + b * s.direction.y + n * s.direction.z) *
                       s.weight;
            return sum;
        }));
    }
    return levels;
}

}  // namespace shoal::frame
