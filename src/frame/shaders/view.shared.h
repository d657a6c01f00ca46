// The view block (std140), filled in one place: src/frame/view_block.cpp.
#ifndef SHOAL_FRAME_VIEW_SHARED_H
#define SHOAL_FRAME_VIEW_SHARED_H

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::frame {
using mat4 = Mat4;
using vec4 = Vec4;
#define SHOAL_VIEW_BLOCK_BEGIN struct ViewBlock
#define SHOAL_VIEW_BLOCK_END ;
#else
#include "frame/bindings.shared.h"
#define SHOAL_VIEW_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_VIEW) uniform ViewBlock
#define SHOAL_VIEW_BLOCK_END ;
#endif

SHOAL_VIEW_BLOCK_BEGIN {
    mat4 clipFromWorld;  // jittered
    mat4 clipFromView;   // jittered
    mat4 viewFromClip;   // jittered
    mat4 viewFromWorld;
    mat4 worldFromView;
    mat4 steadyClipFromWorld;    // without jitter
    mat4 previousClipFromWorld;  // without jitter, the frame before
    vec4 eye;                    // xyz world, w: 1 orthographic, 0 perspective
    vec4 size;                   // width, height, 1 / width, 1 / height (pixels)
    vec4 timing;                 // time s, time step s, frame index, sample index
    vec4 depthRange;             // near m, jitter x px, jitter y px, unused
    vec4 clipPlane;              // Context::clipPlane
}
SHOAL_VIEW_BLOCK_END

#ifdef __cplusplus
}  // namespace shoal::frame
#endif
#undef SHOAL_VIEW_BLOCK_BEGIN
#undef SHOAL_VIEW_BLOCK_END

#endif
