// Uses the public API the way an embedding program does: a header of core, a call into the library, a result checked.
#include <cmath>
#include <cstdio>

#include <shoal/core/math.h>
#include <shoal/core/result.h>

namespace {

shoal::Result<shoal::Mat4> worldFromEye(shoal::Vec3 eye, shoal::Vec3 target) {
    const auto worldFromView = shoal::inverse(shoal::lookAt(eye, target, {0, 1, 0}));
    if (!worldFromView) return shoal::badInput("camera: found a singular view, expected eye and target apart");
    return *worldFromView;
}

}  // namespace

int main() {
    const shoal::Vec3 eye{3, 2, 1};
    const auto worldFromView = worldFromEye(eye, {0, 0, 0});
    if (!worldFromView) {
        std::fprintf(stderr, "%s\n", worldFromView.error().message.c_str());
        return 1;
    }
    // The view's origin is the eye.
    const shoal::Vec3 origin = shoal::transformPoint(*worldFromView, {0, 0, 0});
    const float distance = shoal::length(origin - eye);
    std::printf("eye found %g m from where it was put\n", static_cast<double>(distance));
    return std::isfinite(distance) && distance < 1e-5f ? 0 : 1;
}
