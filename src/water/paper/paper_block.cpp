#include "water/paper/paper_block.h"

#include <algorithm>
#include <cmath>

namespace shoal::water {
namespace {

constexpr float kWallM = 0.02f;  // a basin's walls stand where its water ends: they are lit too

Vec4 withW(Vec3 v, float w) { return {v.x, v.y, v.z, w}; }

// Metres that a pixel of a buffer so high covers, 1 m away (orthographic: anywhere).
float metresPerPixel(const light::View& eye, int height) { return 2 / (eye.clipFromView(1, 1) * float(height)); }

// The world place of a pixel is affine in the pixel, at view depth 0 (origin) and per metre of view depth (ray).
void setPixels(PaperBlock& block, const light::View& eye, const Mat4& viewFromClip) {
    struct Line {
        Vec3 origin, ray;
    };
    const auto lineOf = [&](float x, float y) {
        const Vec3 p = transformPoint(viewFromClip, {2 * x / float(eye.width) - 1, 2 * y / float(eye.height) - 1, 1});
        const Vec3 origin = eye.orthographic ? Vec3{p.x, p.y, 0} : Vec3{};
        const Vec3 ray = eye.orthographic ? Vec3{0, 0, -1} : p / -p.z;
        return Line{transformPoint(eye.worldFromView, origin), transformDirection(eye.worldFromView, ray)};
    };
    const float width = float(eye.width), height = float(eye.height);
    const Line corner = lineOf(0, 0), right = lineOf(width, 0), top = lineOf(0, height);
    block.origin[0] = withW(corner.origin, 0), block.pixelRay[0] = withW(corner.ray, 0);
    block.origin[1] = withW((right.origin - corner.origin) / width, 0);
    block.origin[2] = withW((top.origin - corner.origin) / height, 0);
    block.pixelRay[1] = withW((right.ray - corner.ray) / width, 0);
    block.pixelRay[2] = withW((top.ray - corner.ray) / height, 0);
}

void setLight(PaperBlock& block, const PaperLight& light) {
    const light::View& view = light.view;
    const Mat4& p = view.clipFromView;
    block.lightFromWorld = view.viewFromWorld;
    block.worldFromLight = view.worldFromView;
    block.lightClipFromWorld = view.clipFromWorld();
    block.ray = withW(light.ray, light.lamp ? 1 : 0);
    block.lightAxis = withW(light.axis, 0);
    if (light.lamp) {
        block.lightPlane = {p(0, 0), p(1, 1), 0, 0};
        block.lightDepth = {-p(2, 3), 0, light.cosCone, light.coneScale};  // depth = near / -z
    } else {
        block.lightPlane = {p(0, 0), p(1, 1), p(0, 3), p(1, 3)};
        block.lightDepth = {1 / p(2, 2), -p(2, 3) / p(2, 2), light.cosCone, light.coneScale};
    }
    block.maskArea = {light.maskMin.x, light.maskMin.y, light.maskMax.x, light.maskMax.y};
}

}  // namespace

PaperBufferSizes paperBufferSizes(const light::View& eye, const PaperParams& params) {
    const auto size = [&](float scale) {
        return IVec2{std::max(1, int(std::lround(scale * float(eye.width)))),
                     std::max(1, int(std::lround(scale * float(eye.height))))};
    };
    return {size(params.causticScale), size(params.godrayScale)};
}

void setPaperPixels(PaperBlock& block, const frame::Context& context) {
    const Mat4 clipFromView = light::jittered(context.view, context.jitterPx.x, context.jitterPx.y);
    setPixels(block, context.view, inverse(clipFromView).value_or(context.view.viewFromClip));
}

PaperBlock makePaperBlock(const frame::Context& context, const PaperParams& params, const Body& body,
                          const PaperLight& light) {
    const light::View& eye = context.view;
    const Mat4 clipFromView = light::jittered(eye, context.jitterPx.x, context.jitterPx.y);
    const PaperBufferSizes sizes = paperBufferSizes(eye, params);
    PaperBlock block{};
    block.clipFromWorld = clipFromView * eye.viewFromWorld;
    setLight(block, light);
    setPaperPixels(block, context);
    const BodyParams& b = body.params;
    block.area = {b.areaMin.x - kWallM, b.areaMin.y - kWallM, b.areaMax.x + kWallM, b.areaMax.y + kWallM};
    block.water = {body.params.level, body.optics.index, float(kPaperShadowResolution), params.waterMask ? 1.0f : 0.0f};
    block.eye = withW(eye.eye, eye.nearZ);
    const Mat4& w = eye.worldFromView;
    block.eyeAxis = {-w(0, 2), -w(1, 2), -w(2, 2), eye.orthographic ? 1.0f : 0.0f};

    const float pixelCaustics = metresPerPixel(eye, sizes.caustics.y),
                pixelGodrays = metresPerPixel(eye, sizes.godrays.y);
    const PointSizes points = pointSizes(params, eye.nearZ, light.farZ);
    const float linePx = std::min(params.lineWidthPx, 12.0f);
    block.points = {points.a, points.b, pixelCaustics, 0};
    block.lines = {linePx / float(sizes.godrays.x), linePx / float(sizes.godrays.y), float(sizes.godrays.x),
                   float(sizes.godrays.y)};
    block.grids = {0.5f / float(params.causticGrid), 0.5f / float(params.godrayGrid), 0, 0};

    // A photon's power over the area of the smallest point, or (scattered by gamma) over the width of a line, both
    // at the distance where gain 1 is right.
    const float reference = eye.orthographic ? 1 : kPaperGainDistance;
    const float pointM = params.smallestPointPx * pixelCaustics * reference, lineM = linePx * pixelGodrays * reference;
    const auto photons = [](int side) { return 4 * float(side) * float(side); };
    const Vec3 power = light.light * (params.gain * params.intensity / kPaperIntensity * light.screenArea);
    block.causticLight = withW(power * (1 / (photons(params.causticGrid) * pointM * pointM)), params.attenuation);
    block.godrayLight = withW(power * (params.attenuation / (photons(params.godrayGrid) * lineM)), params.anisotropy);
    return block;
}

}  // namespace shoal::water
