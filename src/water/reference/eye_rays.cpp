#include "water/reference/eye_rays.h"

namespace shoal::water {

EyeRays::EyeRays(const light::View& view)
    : nearZ_(view.nearZ), width_(view.width), height_(view.height), orthographic_(view.orthographic) {
    const Mat4& m = view.worldFromView;
    right_ = normalize(DVec3{m(0, 0), m(1, 0), m(2, 0)});
    up_ = normalize(DVec3{m(0, 1), m(1, 1), m(2, 1)});
    back_ = normalize(DVec3{m(0, 2), m(1, 2), m(2, 2)});
    eye_ = {m(0, 3), m(1, 3), m(2, 3)};
    // clip x = p00 x + p02 z + p03 w and clip w = -z (perspective) or 1 (orthographic), so ndc = scale x / depth +
    // offset.
    const Mat4& p = view.clipFromView;
    scaleX_ = p(0, 0), scaleY_ = p(1, 1);
    offsetX_ = orthographic_ ? p(0, 3) : -p(0, 2);
    offsetY_ = orthographic_ ? p(1, 3) : -p(1, 2);
}

EyeRays::Ray EyeRays::through(double x, double y) const {
    const double ndcX = 2 * x / width_ - 1, ndcY = 1 - 2 * y / height_;
    const double viewX = (ndcX - offsetX_) / scaleX_, viewY = (ndcY - offsetY_) / scaleY_;
    if (orthographic_) return {eye_ + right_ * viewX + up_ * viewY - back_ * nearZ_, -back_, 1, nearZ_};
    const DVec3 toDepthOne = right_ * viewX + up_ * viewY - back_;
    return {eye_ + toDepthOne * nearZ_, normalize(toDepthOne), 1 / length(toDepthOne), nearZ_};
}

double EyeRays::pixelArea(const Ray& ray, double distance, DVec3 normal) const {
    const double atDepthOne = 4 / (std::abs(scaleX_ * scaleY_) * width_ * height_);
    const double slant = std::max(std::abs(dot(ray.direction, normal)), 1e-9);
    if (orthographic_) return atDepthOne / slant;
    const double depth = ray.originDepth + distance * ray.axial;
    return atDepthOne * depth * depth * ray.axial / slant;
}

std::optional<EyeRays::Place> EyeRays::project(DVec3 point) const {
    const DVec3 fromEye = point - eye_;
    const double depth = -dot(fromEye, back_);
    if (depth <= nearZ_) return {};
    const double divisor = orthographic_ ? 1 : depth;
    const double ndcX = scaleX_ * dot(fromEye, right_) / divisor + offsetX_;
    const double ndcY = scaleY_ * dot(fromEye, up_) / divisor + offsetY_;
    Place place;
    place.x = (ndcX + 1) * 0.5 * width_;
    place.y = (1 - ndcY) * 0.5 * height_;
    if (!(place.x >= 0 && place.y >= 0 && place.x < width_ && place.y < height_)) return {};
    if (orthographic_) {
        place.toEye = back_;
        place.distance = depth - nearZ_;
    } else {
        place.toEye = -normalize(fromEye);
        place.distance = length(fromEye) * (1 - nearZ_ / depth);
    }
    return place;
}

}  // namespace shoal::water
