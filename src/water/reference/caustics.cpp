// Light on what is seen, ray by ray: from the sun and lamps above through the surface to the first triangle; where the
// eye sees that point in a straight line, the ray's flux is added to its pixel. A pixel's irradiance is its flux over
// the area that it covers. No density estimate: what is left is noise, which falls with the number of rays.
#include <atomic>
#include <cmath>

#include <shoal/core/parallel.h>
#include <shoal/core/random.h>
#include <shoal/water/reference.h>

#include "water/reference/emission.h"
#include "water/reference/eye_rays.h"

namespace shoal::water {

namespace {

constexpr int kSamplesPerSide = 4;  // of a pixel, for the area it covers

// The first surface in every pixel.
struct Seen {
    std::vector<double> areas;  // m2 a pixel covers
    std::vector<SeenBox> boxes;
};

Seen findSeen(const EyeRays& eye, const Triangles& triangles, int width, int height) {
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    Seen seen;
    seen.areas.resize(pixels);
    std::vector<SeenBox> boxes(pixels, SeenBox{{}, {}, 0});
    parallelFor(std::size_t(height), 4, [&](std::size_t row) {
        for (int column = 0; column < width; ++column) {
            const std::size_t pixel = row * std::size_t(width) + std::size_t(column);
            Bounds bounds;
            // One sample more on each side: the box holds the pixel's own edges.
            for (int j = -1; j <= kSamplesPerSide; ++j)
                for (int i = -1; i <= kSamplesPerSide; ++i) {
                    const EyeRays::Ray ray =
                        eye.through(column + (i + 0.5) / kSamplesPerSide, double(row) + (j + 0.5) / kSamplesPerSide);
                    const auto hit = triangles.first(ray.origin, ray.direction, 0, 1e30);
                    if (!hit) continue;
                    bounds.add(narrowed(ray.origin + ray.direction * hit->distance));
                    if (i < 0 || j < 0 || i == kSamplesPerSide || j == kSamplesPerSide) continue;
                    seen.areas[pixel] +=
                        eye.pixelArea(ray, hit->distance, hit->normal) / (kSamplesPerSide * kSamplesPerSide);
                }
            if (!bounds.empty()) boxes[pixel] = {bounds.lo, bounds.hi, 1};
        }
    });
    for (const SeenBox& box : boxes)
        if (box.weight > 0) seen.boxes.push_back(box);
    return seen;
}

// Some rows of one cell: a piece of work.
struct Task {
    std::size_t cell;
    std::uint32_t row;
    std::uint32_t rowEnd;
};

std::vector<Task> tasksOf(const std::vector<EmissionCell>& cells) {
    constexpr std::uint32_t kRays = 1u << 14;
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint32_t rows = std::max(1u, kRays / cells[i].raysPerSide);
        for (std::uint32_t row = 0; row < cells[i].raysPerSide; row += rows)
            tasks.push_back({i, row, std::min(row + rows, cells[i].raysPerSide)});
    }
    return tasks;
}

// Flux by pixel and channel, as integers: any order of the rays gives the same sums.
struct PixelSums {
    std::vector<std::atomic<std::uint64_t>> units;  // pixels x 3
    double unit = 1;                                // units a watt
    void add(std::size_t pixel, DVec3 watts) {
        const double w[3] = {watts.x, watts.y, watts.z};
        for (std::size_t c = 0; c < 3; ++c)
            units[3 * pixel + c].fetch_add(std::uint64_t(w[c] * unit + 0.5), std::memory_order_relaxed);
    }
};

DVec3 dimmed(DVec3 flux, Vec3 attenuation, double metres) {
    return {flux.x * std::exp(-double(attenuation.x) * metres), flux.y * std::exp(-double(attenuation.y) * metres),
            flux.z * std::exp(-double(attenuation.z) * metres)};
}

// The pixel that sees a lit point from the side that the light comes from; nothing where none does.
std::optional<std::size_t> pixelThatSees(const EyeRays& eye, const Triangles& triangles, int width, DVec3 point,
                                         DVec3 normal, DVec3 light) {
    const auto place = eye.project(point);
    if (!place || dot(normal, place->toEye) * dot(normal, -light) <= 0) return {};
    if (triangles.blocked(point, place->toEye, 4 * leave(point), place->distance)) return {};
    return std::size_t(place->y) * std::size_t(width) + std::size_t(place->x);
}

// The most watts that any one pixel could be given: all that falls on the cells.
double mostWatts(const std::vector<EmissionCell>& cells, const LightSource& source, const Body& body) {
    double irradiance = std::max({source.irradiance.x, source.irradiance.y, source.irradiance.z});
    if (source.lamp) {
        const Vec3 i = source.lamp->intensity;
        const double closest = std::max(1e-4f, source.lamp->radius);
        irradiance = std::max({i.x, i.y, i.z}) / (closest * closest);
    }
    double area = 0;
    for (const EmissionCell& cell : cells) area += cell.size * cell.size;
    return irradiance * area * (1.2 + body.waves->bounds().slope);
}

// What all rays share.
struct Trace {
    const Body& body;
    const Triangles& triangles;
    const EyeRays& eye;
    int width;
    PixelSums& sums;

    void ray(const SurfaceLight& light, const EmissionCell& cell, std::uint32_t column, std::uint32_t row,
             std::uint32_t seed) const {
        const double step = cell.size / cell.raysPerSide;
        const Jitter jitter = jitterOf(column, row, seed);
        const LitEntry entry =
            light.at(cell.x + (column + jitter.x) * step, cell.z + (row + jitter.z) * step, column, row, seed);
        if (!entry.isLit()) return;
        const auto hit = triangles.first(entry.position, entry.direction, leave(entry.position), 1e30);
        if (!hit) return;
        const DVec3 point = entry.position + entry.direction * hit->distance;
        const auto pixel = pixelThatSees(eye, triangles, width, point, hit->normal, entry.direction);
        if (!pixel) return;
        sums.add(*pixel, dimmed(entry.flux, body.optics.beamAttenuation(), hit->distance) * cell.rayArea());
    }

    void rows(const SurfaceLight& light, const EmissionCell& cell, const Task& task, std::uint32_t seed) const {
        for (std::uint32_t row = task.row; row < task.rowEnd; ++row)
            for (std::uint32_t column = 0; column < cell.raysPerSide; ++column) ray(light, cell, column, row, seed);
    }
};

}  // namespace

Result<Image> referenceCaustics(const ReferenceScene& scene, const Body& body, const BodyLights& lights,
                                const light::View& view, const ReferenceOptions& options) {
    Image image(view.width, view.height, 3);
    image.channelNames = {"R", "G", "B"};
    SHOAL_TRY_ASSIGN(const Triangles triangles, Triangles::create(scene.triangles));
    const EyeRays eye(view);
    const Seen seen = findSeen(eye, triangles, view.width, view.height);
    const std::vector<LightSource> sources = lightsAbove(body, lights);
    std::vector<std::vector<EmissionCell>> cells;
    std::vector<std::vector<Task>> tasks;
    double watts = 0;
    std::uint64_t done = 0, total = 0;
    for (const LightSource& source : sources) {
        cells.push_back(emissionCells(body, source, seen.boxes, options.rays));
        tasks.push_back(tasksOf(cells.back()));
        watts += mostWatts(cells.back(), source, body);
        total += tasks.back().size();
    }
    if (!(watts > 0)) return image;
    PixelSums sums{std::vector<std::atomic<std::uint64_t>>(image.pixels.size()),
                   std::exp2(std::floor(62 - std::log2(watts)))};
    const Trace trace{body, triangles, eye, view.width, sums};
    constexpr std::size_t kBatch = 64;  // tasks between two words of progress
    for (std::size_t s = 0; s < sources.size(); ++s) {
        const SurfaceLight light(body, sources[s], triangles);
        const std::uint32_t seed = randomBits(options.seed, std::uint32_t(s));
        for (std::size_t begin = 0; begin < tasks[s].size(); begin += kBatch) {
            const std::size_t count = std::min(kBatch, tasks[s].size() - begin);
            parallelFor(count, 1, [&](std::size_t i) {
                const Task& task = tasks[s][begin + i];
                trace.rows(light, cells[s][task.cell], task, randomBits(seed, std::uint32_t(task.cell)));
            });
            done += count;
            if (options.progress && !options.progress(done, total))
                return Error{ErrorKind::cancelled, "reference: stopped"};
        }
    }
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const double area = seen.areas[i / 3];
        if (area > 0) image.pixels[i] = float(double(sums.units[i].load()) / sums.unit / area);
    }
    return image;
}

}  // namespace shoal::water
