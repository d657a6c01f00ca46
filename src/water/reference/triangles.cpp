// The one file that sees Embree.
#include "water/reference/triangles.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <embree3/rtcore.h>

namespace shoal::water {

struct Triangles::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    ~State() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

Triangles::Triangles(std::unique_ptr<State> state) : state_(std::move(state)) {}
Triangles::Triangles(Triangles&&) noexcept = default;
Triangles::~Triangles() = default;

namespace {

bool isFinite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

template <class Ray>
void fillRay(Ray& ray, DVec3 from, DVec3 direction, double near, double far) {
    ray.org_x = float(from.x), ray.org_y = float(from.y), ray.org_z = float(from.z);
    ray.dir_x = float(direction.x), ray.dir_y = float(direction.y), ray.dir_z = float(direction.z);
    ray.tnear = float(near);
    ray.tfar = float(std::min(far, 1e30));
    ray.mask = ~0u;
    ray.time = 0;
    ray.flags = 0;
}

}  // namespace

Result<Triangles> Triangles::create(std::span<const Vec3> vertices) {
    auto state = std::make_unique<State>();
    state->device = rtcNewDevice(nullptr);
    if (!state->device) return internalError("reference: Embree gives no device");
    state->scene = rtcNewScene(state->device);
    rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST);
    std::vector<Vec3> kept;
    kept.reserve(vertices.size());
    for (std::size_t i = 0; i + 2 < vertices.size(); i += 3)
        if (isFinite(vertices[i]) && isFinite(vertices[i + 1]) && isFinite(vertices[i + 2]))
            kept.insert(kept.end(), vertices.begin() + std::ptrdiff_t(i), vertices.begin() + std::ptrdiff_t(i + 3));
    if (kept.size() > std::numeric_limits<unsigned>::max())
        return badInput("reference: " + std::to_string(kept.size() / 3) + " triangles, expected at most 1400 million");
    if (!kept.empty()) {
        const RTCGeometry geometry = rtcNewGeometry(state->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* to =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), kept.size());
        auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), kept.size() / 3));
        if (!to || !indices) {
            rtcReleaseGeometry(geometry);
            return internalError("reference: Embree has no memory for " + std::to_string(kept.size() / 3) +
                                 " triangles");
        }
        std::memcpy(to, kept.data(), kept.size() * sizeof(Vec3));
        for (std::size_t i = 0; i < kept.size(); ++i) indices[i] = unsigned(i);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(state->scene, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(state->scene);
    if (rtcGetDeviceError(state->device) != RTC_ERROR_NONE)
        return internalError("reference: Embree cannot build its tree of " + std::to_string(kept.size() / 3) +
                             " triangles");
    return Triangles(std::move(state));
}

std::optional<TriangleHit> Triangles::first(DVec3 from, DVec3 direction, double near, double far) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit hit;
    fillRay(hit.ray, from, direction, near, far);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->scene, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return TriangleHit{hit.ray.tfar, normalize(DVec3{hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z})};
}

bool Triangles::blocked(DVec3 from, DVec3 direction, double near, double far) const {
    if (far <= near) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray;
    fillRay(ray, from, direction, near, far);
    rtcOccluded1(state_->scene, &context, &ray);
    return ray.tfar < 0;
}

}  // namespace shoal::water
