// Finds the sun's disc in an environment map and takes it out.
// A sun is the brightest texel and what hangs together with it, when that is small (a lamp in a studio is larger than 3
// degrees), far brighter than the sky around it (an overcast sky's brightest cloud is not), and carries a part of the
// map's light that one would miss (a street lamp far away does not).
#include <shoal/light/environment.h>

#include <vector>

#include <shoal/core/assert.h>

namespace shoal::light {
namespace {

constexpr double kLargestRadius =
    3.0 * kPiD / 180;  // radians; blurred by clouds, leaves and the camera, not the disc's 0.27 degrees
constexpr double kRingInner = 4.0 * kPiD / 180, kRingOuter = 8.0 * kPiD / 180;  // where the surroundings are measured
constexpr double kLeastContrast = 20;                                           // brightest texel to mean of the ring
constexpr double kLeastShare = 0.01;                                            // of the whole sphere's flux
constexpr double kCoreThreshold = 0.1;                                          // of the peak: what must be small
constexpr double kGlareThreshold = 2;                                           // times the ring: what is taken out

struct Map {
    const Environment& environment;
    const Image& image;
    double texelSize;  // radians
    double luminance(int x, int y) const {
        const float* p = image.at(x, y);
        return double(shoal::luminance({p[0], p[1], p[2]}));
    }
    double solidAngle(int y) const {
        return 2 * kPiD / image.width * (std::cos(kPiD * y / image.height) - std::cos(kPiD * (y + 1) / image.height));
    }
};

double angleBetween(Vec3 a, Vec3 b) {
    // The chord keeps its precision at small angles, where acos has lost it.
    return 2 * std::asin(std::min(1.0, double(length(a - b)) / 2));
}

IVec2 brightestTexel(const Map& map) {
    IVec2 best{0, 0};
    for (int y = 0; y < map.image.height; ++y)
        for (int x = 0; x < map.image.width; ++x)
            if (map.luminance(x, y) > map.luminance(best.x, best.y)) best = {x, y};
    return best;
}

double totalFlux(const Map& map) {
    double sum = 0;
    for (int y = 0; y < map.image.height; ++y)
        for (int x = 0; x < map.image.width; ++x) sum += std::max(0.0, map.luminance(x, y)) * map.solidAngle(y);
    return sum;
}

double meanOfRing(const Map& map, Vec3 center) {
    const double inner = std::max(kRingInner, 2.5 * map.texelSize), outer = std::max(kRingOuter, 5 * map.texelSize);
    const double polar = std::acos(std::clamp(double(center.y), -1.0, 1.0));
    const int firstRow = std::max(0, int((polar - outer) / map.texelSize) - 1);
    const int endRow = std::min(map.image.height, int((polar + outer) / map.texelSize) + 2);
    double sum = 0, area = 0;
    for (int y = firstRow; y < endRow; ++y)
        for (int x = 0; x < map.image.width; ++x) {
            const double angle = angleBetween(center, directionOfTexel(map.environment, x, y));
            if (angle < inner || angle > outer) continue;
            sum += std::max(0.0, map.luminance(x, y)) * map.solidAngle(y);
            area += map.solidAngle(y);
        }
    return area > 0 ? sum / area : 0;
}

struct Region {
    std::vector<IVec2> texels;
    std::vector<IVec2> border;  // neighbours that are not in it
    double radius = 0;          // largest angle from the seed
};

// Texels that hang together with `seed`, are brighter than `threshold` and within `limit` radians of it.
Region grow(const Map& map, IVec2 seed, double threshold, double limit) {
    enum : unsigned char { unseen, inside, outside };
    const int width = map.image.width, height = map.image.height;
    std::vector<unsigned char> state(std::size_t(width) * std::size_t(height), unseen);
    const Vec3 center = directionOfTexel(map.environment, seed.x, seed.y);
    Region region;
    std::vector<IVec2> open{seed};
    state[std::size_t(seed.y) * std::size_t(width) + std::size_t(seed.x)] = inside;
    while (!open.empty()) {
        const IVec2 at = open.back();
        open.pop_back();
        region.texels.push_back(at);
        region.radius = std::max(region.radius, angleBetween(center, directionOfTexel(map.environment, at.x, at.y)));
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const IVec2 next{(at.x + dx + width) % width, at.y + dy};
                if (next.y < 0 || next.y >= height) continue;
                unsigned char& s = state[std::size_t(next.y) * std::size_t(width) + std::size_t(next.x)];
                if (s != unseen) continue;
                const bool belongs = map.luminance(next.x, next.y) > threshold &&
                                     angleBetween(center, directionOfTexel(map.environment, next.x, next.y)) <= limit;
                s = belongs ? inside : outside;
                (belongs ? open : region.border).push_back(next);
            }
    }
    return region;
}

Vec3 meanRadiance(const Map& map, const std::vector<IVec2>& texels) {
    double sum[3]{}, area = 0;
    for (const IVec2 t : texels) {
        for (int k = 0; k < 3; ++k) sum[k] += double(map.image.at(t.x, t.y)[k]) * map.solidAngle(t.y);
        area += map.solidAngle(t.y);
    }
    if (area <= 0) return {};
    return max({float(sum[0] / area), float(sum[1] / area), float(sum[2] / area)}, {0, 0, 0});
}

// Replaces the region by `fill` where it is brighter; the sun gets what that takes away.
Sun takeOut(Environment& environment, const Map& map, const Region& region, Vec3 fill) {
    const double rest[3] = {double(fill.x), double(fill.y), double(fill.z)};
    const auto excess = [&](IVec2 t, int k) { return std::max(0.0, double(map.image.at(t.x, t.y)[k]) - rest[k]); };
    double sum[3]{};
    for (const IVec2 t : region.texels) {
        const Vec3 d = directionOfTexel(environment, t.x, t.y);
        const double weight =
            (0.2126 * excess(t, 0) + 0.7152 * excess(t, 1) + 0.0722 * excess(t, 2)) * map.solidAngle(t.y);
        sum[0] += weight * double(d.x), sum[1] += weight * double(d.y), sum[2] += weight * double(d.z);
    }
    Sun sun;
    sun.toSun = normalize(Vec3{float(sum[0]), float(sum[1]), float(sum[2])});
    double irradiance[3]{};
    for (const IVec2 t : region.texels) {
        const double cosine = double(dot(sun.toSun, directionOfTexel(environment, t.x, t.y)));
        for (int k = 0; k < 3; ++k) {
            irradiance[k] += excess(t, k) * map.solidAngle(t.y) * cosine;
            float& value = environment.radiance.at(t.x, t.y)[k];
            value = std::min(value, float(rest[k]));
        }
    }
    sun.irradiance = {float(irradiance[0]), float(irradiance[1]), float(irradiance[2])};
    return sun;
}

}  // namespace

std::optional<Sun> extractSun(Environment& environment) {
    if (environment.radiance.empty()) return std::nullopt;
    SHOAL_ASSERT_GE(environment.radiance.channelCount, 3);
    const Map map{environment, environment.radiance, kPiD / environment.radiance.height};
    const IVec2 seed = brightestTexel(map);
    const Vec3 center = directionOfTexel(environment, seed.x, seed.y);
    const double peak = map.luminance(seed.x, seed.y), around = meanOfRing(map, center);
    if (!(peak > 0) || peak < kLeastContrast * around) return std::nullopt;

    const double limit = std::max(kLargestRadius, 1.5 * map.texelSize);
    if (grow(map, seed, around + kCoreThreshold * (peak - around), 2 * limit).radius > limit) return std::nullopt;

    const Region region = grow(map, seed, std::max(kGlareThreshold * around, 1e-4 * peak), limit);
    double flux = 0;
    for (const IVec2 t : region.texels) flux += (map.luminance(t.x, t.y) - around) * map.solidAngle(t.y);
    if (flux < kLeastShare * totalFlux(map)) return std::nullopt;
    return takeOut(environment, map, region, meanRadiance(map, region.border));
}

}  // namespace shoal::light
