// Single scattering along straight view rays: at stratified points of the path in the water, all light that comes
// there (LightMesh) times phase function and scattering, dimmed on both ways. The sun's disc: 16 directions, each with
// its own mesh, in turn along the path.
#include <cmath>

#include <shoal/core/parallel.h>
#include <shoal/core/random.h>
#include <shoal/water/reference.h>

#include "water/reference/eye_rays.h"
#include "water/reference/light_mesh.h"

namespace shoal::water {

namespace {

constexpr double kFarthest = 300;   // metres of a path that meets nothing
constexpr double kFaintest = 1e-4;  // transmittance where a path ends
constexpr std::uint32_t kDiscDirections = 16;

// The part of a view ray that lies in the water.
struct Path {
    DVec3 origin, direction;  // of the first point in the water
    double length = 0;
};

// What is common to all rays.
struct Medium {
    const Body& body;
    const Triangles& triangles;
    Vec3 attenuation, scattering;
    double least;    // of the attenuation's channels, 1/m
    double longest;  // metres of a path

    explicit Medium(const Body& b, const Triangles& t)
        : body(b), triangles(t), attenuation(b.optics.beamAttenuation()), scattering(b.optics.beamScattering()),
          least(std::min({attenuation.x, attenuation.y, attenuation.z})),
          longest(least > 0 ? std::min(kFarthest, -std::log(kFaintest) / least) : kFarthest) {}

    // Metres along a path by share of what its transmittance loses; and metres a share there.
    double distance(double share, double length) const {
        const double lost = -std::expm1(-least * length);
        return lost > 1e-9 ? -std::log1p(-share * lost) / least : share * length;
    }
    double metresPerShare(double distance, double length) const {
        const double lost = -std::expm1(-least * length);
        return lost > 1e-9 ? lost / least * std::exp(least * distance) : length;
    }
};

// Cuts [near, far] along one axis to where the ray is between lo and hi.
void cut(double origin, double direction, double lo, double hi, double& near, double& far) {
    if (std::abs(direction) < 1e-12) {
        if (origin < lo || origin > hi) far = near - 1;
        return;
    }
    const double a = (lo - origin) / direction, b = (hi - origin) / direction;
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
}

Path pathInWater(const Medium& medium, const EyeRays& eye, bool orthographic, double x, double y) {
    const EyeRays::Ray ray = eye.through(x, y);
    const BodyParams& water = medium.body.params;
    // From the eye itself where there is one.
    const double before = orthographic ? 0 : ray.originDepth / ray.axial;
    const DVec3 start = ray.origin - ray.direction * before;
    double near = 0, far = 1e30;
    if (const auto hit = medium.triangles.first(ray.origin, ray.direction, 0, 1e30)) far = before + hit->distance;
    cut(start.x, ray.direction.x, water.areaMin.x, water.areaMax.x, near, far);
    cut(start.y, ray.direction.y, -1e30, water.level, near, far);
    cut(start.z, ray.direction.z, water.areaMin.y, water.areaMax.y, near, far);
    if (!(far > near)) return {};
    return {start + ray.direction * near, ray.direction, std::min(far - near, medium.longest)};
}

// Boxes round what the paths pass through: between the rays through four neighbouring corners of (blocks of) pixels.
std::vector<SeenBox> boxesOf(const Medium& medium, const EyeRays& eye, const light::View& view) {
    constexpr int kSegments = 24, kMostBlocks = 1 << 16;
    int stride = 1;
    while ((view.width / stride + 1) * (view.height / stride + 1) > kMostBlocks) ++stride;
    const int columns = (view.width + stride - 1) / stride, rows = (view.height + stride - 1) / stride;
    std::vector<Path> corners(std::size_t(columns + 1) * std::size_t(rows + 1));
    parallelFor(std::size_t(rows + 1), 4, [&](std::size_t row) {
        for (int column = 0; column <= columns; ++column)
            corners[row * std::size_t(columns + 1) + std::size_t(column)] =
                pathInWater(medium, eye, view.orthographic, double(column) * stride, double(row) * stride);
    });
    std::vector<SeenBox> boxes;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const std::size_t first = std::size_t(row) * std::size_t(columns + 1) + std::size_t(column);
            const std::size_t four[4] = {first, first + 1, first + std::size_t(columns + 1),
                                         first + std::size_t(columns + 2)};
            for (int segment = 0; segment < kSegments; ++segment) {
                Bounds bounds;
                for (const std::size_t corner : four)
                    for (const int end : {segment, segment + 1}) {
                        const Path& path = corners[corner];
                        if (path.length <= 0) continue;
                        const double t = medium.distance(double(end) / kSegments, path.length);
                        bounds.add(narrowed(path.origin + path.direction * t));
                    }
                if (!bounds.empty()) boxes.push_back({bounds.lo, bounds.hi, 1});
            }
        }
    return boxes;
}

DVec3 operator*(DVec3 a, DVec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

DVec3 transmittance(Vec3 attenuation, double metres) {
    return {std::exp(-double(attenuation.x) * metres), std::exp(-double(attenuation.y) * metres),
            std::exp(-double(attenuation.z) * metres)};
}

// Calls sample(point, weight) at stratified points of a path; weight: metres that the point stands for, dimmed. Only
// every `period`-th from `phase` on.
template <class Sample>
void alongPath(const Medium& medium, const Path& path, int steps, std::uint32_t seed, std::uint32_t ray,
               std::uint32_t period, std::uint32_t phase, const Sample& sample) {
    for (std::uint32_t step = 0; step < std::uint32_t(steps); ++step) {
        if ((step + ray * 7u) % period != phase) continue;
        const double share = (step + double(randomFloat(seed, ray, step))) / steps;
        const double t = medium.distance(share, path.length);
        sample(path.origin + path.direction * t,
               transmittance(medium.attenuation, t) * (medium.metresPerShare(t, path.length) / steps));
    }
}

// Adds to `sums` (3 a pixel) what sample(point, direction) gives at the points of each pixel's rays: radiance a metre.
template <class Sample>
Result<void> addAlongRays(const Medium& medium, const EyeRays& eye, const light::View& view,
                          const ReferenceOptions& options, std::uint32_t period, std::uint32_t phase,
                          std::vector<double>& sums, const std::function<bool(double)>& tell, const Sample& sample) {
    const int side = std::max(1, options.subPixels);
    constexpr std::size_t kBatch = 16;  // rows of pixels between two words of progress
    for (std::size_t begin = 0; begin < std::size_t(view.height); begin += kBatch) {
        const std::size_t count = std::min(kBatch, std::size_t(view.height) - begin);
        parallelFor(count, 1, [&](std::size_t i) {
            const std::size_t row = begin + i;
            for (int column = 0; column < view.width; ++column) {
                const std::size_t pixel = row * std::size_t(view.width) + std::size_t(column);
                DVec3 sum;
                for (int sub = 0; sub < side * side; ++sub) {
                    const Path path = pathInWater(medium, eye, view.orthographic, column + (sub % side + 0.5) / side,
                                                  double(row) + (sub / side + 0.5) / side);
                    if (path.length <= 0) continue;
                    const std::uint32_t ray = std::uint32_t(pixel) * std::uint32_t(side * side) + std::uint32_t(sub);
                    alongPath(medium, path, options.steps, options.seed, ray, period, phase,
                              [&](DVec3 point, DVec3 weight) { sum = sum + sample(point, path.direction) * weight; });
                }
                const double share = 1.0 / (side * side);
                sums[3 * pixel] += sum.x * share, sums[3 * pixel + 1] += sum.y * share;
                sums[3 * pixel + 2] += sum.z * share;
            }
        });
        if (!tell(double(begin + count) / view.height)) return Error{ErrorKind::cancelled, "reference: stopped"};
    }
    return {};
}

// Light of one mesh that a point sends on along -direction.
DVec3 scattered(const Medium& medium, const LightMesh& mesh, DVec3 point, DVec3 direction) {
    DVec3 sum;
    mesh.gather(point.x, point.z, std::max(0.0, medium.body.params.level - point.y),
                [&](const LightMesh::Branch& branch) {
                    const double phase = phaseFunction(medium.body.optics, float(-dot(branch.direction, direction)));
                    sum = sum + transmittance(medium.attenuation, branch.length) * (branch.irradiance * phase);
                });
    return sum * widened(mesh.color()) * widened(medium.scattering);
}

// Light of a lamp in the water.
DVec3 scattered(const Medium& medium, const light::PunctualLight& lamp, DVec3 point, DVec3 direction) {
    const DVec3 toLamp = widened(lamp.position) - point;
    const double distance = length(toLamp), off = leave(point);
    if (distance <= 0 || medium.triangles.blocked(point, toLamp * (1 / distance), off, distance - off)) return {};
    const double phase = phaseFunction(medium.body.optics, float(dot(toLamp, direction) / distance));
    return widened(irradianceAt(lamp, narrowed(point))) * transmittance(medium.attenuation, distance) *
           widened(medium.scattering) * phase;
}

}  // namespace

Result<Image> referenceInscatter(const ReferenceScene& scene, const Body& body, const BodyLights& lights,
                                 const light::View& view, const ReferenceOptions& options) {
    Image image(view.width, view.height, 3);
    image.channelNames = {"R", "G", "B"};
    SHOAL_TRY_ASSIGN(const Triangles triangles, Triangles::create(scene.triangles));
    const EyeRays eye(view);
    const Medium medium(body, triangles);
    if (std::max({medium.scattering.x, medium.scattering.y, medium.scattering.z}) <= 0 || options.steps <= 0)
        return image;
    const std::vector<SeenBox> boxes = boxesOf(medium, eye, view);
    const std::vector<LightSource> above = lightsAbove(body, lights);
    std::vector<const light::PunctualLight*> inWater;
    for (const light::PunctualLight& lamp : lights.punctual)
        if (std::none_of(above.begin(), above.end(), [&](const LightSource& s) { return s.lamp == &lamp; }))
            inWater.push_back(&lamp);

    std::vector<double> sums(image.pixels.size());
    double whole = double(inWater.size()), done = 0;
    for (const LightSource& source : above) whole += source.discHalfAngle > 0 ? kDiscDirections : 1;
    const std::function<bool(double)> tell = [&](double share) {
        return !options.progress || options.progress(std::uint64_t((done + share) * 1000), std::uint64_t(whole * 1000));
    };
    for (const LightSource& source : above) {
        const std::uint32_t directions = source.discHalfAngle > 0 ? kDiscDirections : 1;
        const std::vector<EmissionCell> cells = emissionCells(body, source, boxes, options.rays / directions);
        for (std::uint32_t i = 0; i < directions; ++i, done += 1) {
            LightSource point = source;
            if (directions > 1)
                point.travel = sampleDisc(source.travel, source.discHalfAngle, i & 3u, i >> 2, options.seed).travel;
            const LightMesh mesh(body, point, triangles, cells, options.seed);
            SHOAL_TRY(addAlongRays(medium, eye, view, options, directions, i, sums, tell,
                                   [&](DVec3 at, DVec3 direction) { return scattered(medium, mesh, at, direction); }));
        }
    }
    for (const light::PunctualLight* lamp : inWater) {
        SHOAL_TRY(addAlongRays(medium, eye, view, options, 1, 0, sums, tell,
                               [&](DVec3 at, DVec3 direction) { return scattered(medium, *lamp, at, direction); }));
        done += 1;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) image.pixels[i] = float(sums[i]);
    return image;
}

}  // namespace shoal::water
