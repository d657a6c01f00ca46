// Records that drawing models reads: one a draw (an instance's primitive), one a material.
#ifndef SHOAL_FRAME_GEOMETRY_SHARED_H
#define SHOAL_FRAME_GEOMETRY_SHARED_H

#include "frame/bindings.shared.h"

// Vertex attribute locations.
#define SHOAL_ATTRIBUTE_POSITION 0
#define SHOAL_ATTRIBUTE_NORMAL 1   // octahedral, snorm16 x 2
#define SHOAL_ATTRIBUTE_TANGENT 2  // snorm10 x 3, w (2 bits) handedness
#define SHOAL_ATTRIBUTE_UV 3
#define SHOAL_ATTRIBUTE_COLOR 4  // square root of the linear colour, unorm8 x 4 (alpha plain)
#define SHOAL_ATTRIBUTE_UV1 5
#define SHOAL_ATTRIBUTE_PREVIOUS 6  // position in the frame before
#define SHOAL_ATTRIBUTE_DRAW 7      // index of the draw record, one an instance

// Bits of DrawRecord::flags.
#define SHOAL_DRAW_MIRRORED 1u

// Which texture a pair of MaterialRecord::uv rows belongs to.
#define SHOAL_TEXTURE_BASE_COLOR 0
#define SHOAL_TEXTURE_METAL_ROUGH 1
#define SHOAL_TEXTURE_NORMAL 2
#define SHOAL_TEXTURE_OCCLUSION 3
#define SHOAL_TEXTURE_EMISSION 4
#define SHOAL_TEXTURE_COUNT 5

#ifdef __cplusplus
#include <cstdint>

#include <shoal/core/math.h>
namespace shoal::frame {
using vec4 = Vec4;
using uint = std::uint32_t;
#endif

struct DrawRecord {
    vec4 worldFromModel[3];     // rows
    vec4 previousFromModel[3];  // rows, of the frame before
    vec4 tint;
    uint material;
    uint objectId;
    uint flags;
    uint unused;
};

// 256 bytes, so that one record can be bound as a uniform block too.
struct MaterialRecord {
    vec4 baseColor;
    vec4 surface;   // roughness, metallic, F0 / 0.16, G-buffer flags / 255
    vec4 emission;  // rgb radiance, w alpha cutoff
    vec4 detail;    // normal scale, occlusion strength, transmission, ior
    vec4 uv[10];    // two rows a texture: (m00, m01, offset x, uv set), (m10, m11, offset y, unused)
    vec4 unused[2];
};

#ifdef __cplusplus
static_assert(sizeof(DrawRecord) == 128 && sizeof(MaterialRecord) == 256);
}  // namespace shoal::frame
#endif

#endif
