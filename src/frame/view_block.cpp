#include "frame/view_block.h"

namespace shoal::frame {
namespace {

ViewBlock makeBlock(const light::View& view, const Mat4& clipFromView, const light::View& previous) {
    ViewBlock block;
    block.clipFromWorld = clipFromView * view.viewFromWorld;
    block.clipFromView = clipFromView;
    block.viewFromClip = inverse(clipFromView).value_or(view.viewFromClip);
    block.viewFromWorld = view.viewFromWorld;
    block.worldFromView = view.worldFromView;
    block.steadyClipFromWorld = view.clipFromWorld();
    block.previousClipFromWorld = previous.clipFromWorld();
    block.eye = {view.eye.x, view.eye.y, view.eye.z, view.orthographic ? 1.0f : 0.0f};
    const float width = float(view.width), height = float(view.height);
    block.size = {width, height, 1 / width, 1 / height};
    block.depthRange = {view.nearZ, 0, 0, 0};
    block.clipPlane = {0, 0, 0, 1};
    return block;
}

}  // namespace

ViewBlock makeViewBlock(const Context& context) {
    const Mat4 clipFromView = light::jittered(context.view, context.jitterPx.x, context.jitterPx.y);
    ViewBlock block = makeBlock(context.view, clipFromView, context.previousView);
    block.timing = {context.time, context.timeStep, float(context.frameIndex), float(context.sampleIndex)};
    block.depthRange.y = context.jitterPx.x;
    block.depthRange.z = context.jitterPx.y;
    block.clipPlane = context.clipPlane;
    return block;
}

ViewBlock makeViewBlock(const light::View& view) { return makeBlock(view, view.clipFromView, view); }

}  // namespace shoal::frame
