#include <shoal/light/view.h>

#include <shoal/core/assert.h>

namespace shoal::light {
namespace {

// Inverse of a rotation and translation: transposed rotation, exact where a general inverse rounds.
Mat4 rigidInverse(const Mat4& a) {
    Mat4 out;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) out(row, column) = a(column, row);
        out(row, 3) = -(a(0, row) * a(0, 3) + a(1, row) * a(1, 3) + a(2, row) * a(2, 3));
    }
    return out;
}

Mat4 clipFromViewOf(const Camera& camera, int width, int height) {
    const float aspect = float(width) / float(height);
    if (camera.projection == Camera::Projection::orthographic) {
        const float up = 0.5f * camera.heightM, right = up * aspect;
        return orthographicReversed(-right, right, -up, up, camera.nearZ, camera.farZ);
    }
    if (camera.intrinsics) {
        const Intrinsics& k = *camera.intrinsics;
        // An image size of zero: the intrinsics are meant for the picture itself.
        const float imageWidth = k.widthPx > 0 ? k.widthPx : float(width);
        const float imageHeight = k.heightPx > 0 ? k.heightPx : float(height);
        return intrinsicsReversed(k.fx, k.fy, k.cx, k.cy, imageWidth, imageHeight, camera.nearZ);
    }
    return perspectiveReversed(camera.verticalFov, aspect, camera.nearZ);
}

}  // namespace

Camera cameraLookingAt(Vec3 eye, Vec3 target, float verticalFov, Vec3 up) {
    Camera camera;
    camera.worldFromView = rigidInverse(lookAt(eye, target, up));
    // The translation is the eye itself; the round trip through the inverse would lose its last bits far from the
    // origin.
    camera.worldFromView(0, 3) = eye.x;
    camera.worldFromView(1, 3) = eye.y;
    camera.worldFromView(2, 3) = eye.z;
    camera.verticalFov = verticalFov;
    return camera;
}

View makeView(const Camera& camera, int width, int height) {
    SHOAL_ASSERT_GT(width, 0);
    SHOAL_ASSERT_GT(height, 0);
    View view;
    view.width = width;
    view.height = height;
    view.worldFromView = camera.worldFromView;
    view.viewFromWorld = rigidInverse(camera.worldFromView);
    view.clipFromView = clipFromViewOf(camera, width, height);
    const std::optional<Mat4> viewFromClip = inverse(view.clipFromView);
    SHOAL_ASSERT_MSG(viewFromClip.has_value(), "the camera's field of view, height or near plane is zero");
    view.viewFromClip = *viewFromClip;
    view.eye = camera.position();
    view.nearZ = camera.nearZ;
    view.orthographic = camera.projection == Camera::Projection::orthographic;
    return view;
}

Mat4 jittered(const View& view, float xPx, float yPx) {
    // Moving clip x by d * clip w moves the picture by d in normalised coordinates, perspective or not; a pixel is 2 /
    // width.
    Mat4 out = view.clipFromView;
    for (int column = 0; column < 4; ++column) {
        out(0, column) += 2 * xPx / float(view.width) * view.clipFromView(3, column);
        out(1, column) += 2 * yPx / float(view.height) * view.clipFromView(3, column);
    }
    return out;
}

}  // namespace shoal::light
