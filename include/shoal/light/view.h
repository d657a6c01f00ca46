// An eye: where a picture is seen from.
#pragma once

#include <optional>
#include <string>

#include <shoal/core/math.h>
#include <shoal/core/result.h>

namespace shoal::light {

// Pinhole intrinsics in pixels of an image of widthPx x heightPx; the principal point counts from the top left corner,
// y down.
struct Intrinsics {
    float fx = 0, fy = 0, cx = 0, cy = 0;
    float widthPx = 0, heightPx = 0;
};

// What a camera is, apart from the picture's size.
struct Camera {
    enum class Projection { perspective, orthographic } projection = Projection::perspective;
    Mat4 worldFromView;                    // rigid; the camera looks along its -z, y is up in the picture
    float verticalFov = radians(50);       // radians, 0 < fov < pi (perspective without intrinsics)
    float heightM = 10;                    // metres seen from top to bottom (orthographic)
    float nearZ = 0.05f;                   // metres
    float farZ = 10000;                    // metres; orthographic only (perspective reaches to infinity)
    std::optional<Intrinsics> intrinsics;  // overrides verticalFov
    Vec3 position() const { return {worldFromView(0, 3), worldFromView(1, 3), worldFromView(2, 3)}; }
};

// A camera at `eye` looking at `target`, y up.
Camera cameraLookingAt(Vec3 eye, Vec3 target, float verticalFov, Vec3 up = {0, 1, 0});

// A camera for a picture of a certain size: what a frame is drawn from.
struct View {
    int width = 0, height = 0;
    Mat4 viewFromWorld, worldFromView;  // rigid
    Mat4 clipFromView, viewFromClip;    // reversed z, clip z in [0, 1], y up; no jitter in it
    Vec3 eye;                           // world
    float nearZ = 0.05f;
    bool orthographic = false;
    Mat4 clipFromWorld() const { return clipFromView * viewFromWorld; }
};
View makeView(const Camera& camera, int width, int height);

// clipFromView moved by (x, y) pixels, for antialiasing: x to the right, y up, in [-0.5, 0.5].
Mat4 jittered(const View& view, float xPx, float yPx);

}  // namespace shoal::light
