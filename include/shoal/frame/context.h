// What every pass of a frame is given, and the buffers a frame is made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <shoal/core/math.h>
#include <shoal/gl/objects.h>
#include <shoal/gl/timer.h>
#include <shoal/light/view.h>

namespace shoal::frame {

// One drawing of one frame from one eye. Several Contexts share frameIndex when a picture is supersampled.
struct Context {
    gl::Device* device = nullptr;
    gl::FrameTimer* timer = nullptr;  // may be null
    light::View view;                 // without jitter
    light::View previousView;         // of the frame before; equal to view in the first frame
    Vec2 jitterPx;                    // this sample's offset from the pixel centre, x right, y up, [-0.5, 0.5]
    float time = 0;                   // seconds of scene time
    float timeStep = 0;               // seconds since the frame before, 0 in the first
    bool draft = false;               // may leave out what is smaller than a pixel or two
    // World: only what has dot(clipPlane, (p, 1)) >= 0 is drawn into the G-buffer. (0, 0, 0, 1): all.
    Vec4 clipPlane{0, 0, 0, 1};
    std::uint32_t frameIndex = 0;   // counts frames; feeds every pseudo-random choice
    std::uint32_t sampleIndex = 0;  // which sample of a supersampled frame
};

// What opaque surfaces leave behind. All textures have the view's size; rows bottom first as GL draws them.
struct GBuffer {
    gl::TextureView albedo;    // RGBA8: sqrt of the linear base colour, a = material occlusion
    gl::TextureView normal;    // RG16: octahedral world normal, mapped to [0, 1]
    gl::TextureView material;  // RGBA8: perceptual roughness, metallic, dielectric F0 / 0.16, flags (kFlag... / 255)
    gl::TextureView emission;  // R11F_G11F_B10F: emitted radiance; the whole radiance of prelit and unlit surfaces
    gl::TextureView
        motion;  // RG16F: where the surface came from, pixels (now minus the frame before), x right, y up, no jitter
    gl::TextureView objectId;       // R32UI: instance id, 0 = nothing
    gl::TextureView depth;          // DEPTH_COMPONENT32F, reversed: 1 near, 0 at infinity (cleared)
    gl::TextureView viewDepth;      // R32F: distance along the view axis in metres, 0 where nothing was drawn; written
                                    // after the opaque surfaces
    std::uint32_t framebuffer = 0;  // all of the above but viewDepth attached, in the order albedo, normal, material,
                                    // emission, motion, objectId
    int width = 0, height = 0;
};

// Bits of GBuffer::material.a * 255.
inline constexpr std::uint32_t kFlagPrelit =
    1;  // arrives lit: gets no sun, ambient or occlusion; emission is its radiance
inline constexpr std::uint32_t kFlagUnlit = 2;  // KHR_materials_unlit: the same treatment

// A view of the scene that a technique or a light needs before the frame is shaded. Whoever draws the scene draws all
// of it that casts (host or pipeline) into `depth`, cleared to 0, reversed z.
struct NeededView {
    enum class Purpose { sunShadow, spotShadow, photonDepth, reflection } purpose = Purpose::sunShadow;
    light::View view;               // matrices and size
    gl::TextureView depth;          // D32F, a layer of it
    int layer = -1;                 // -1: a plain 2D texture
    std::uint32_t framebuffer = 0;  // depth attached, ready to draw
    bool unchanged = false;         // nothing in it changed since it was drawn last: may be skipped
    // Depth peeling: where `peel` is given, only what lies more than peelGap (of depth, [0, 1]) behind it is drawn. May
    // be another layer of the array that `depth` is a layer of.
    gl::TextureView peel;
    int peelLayer = 0;
    float peelGap = 0;
};

// What a technique costs.
struct Stats {
    std::vector<gl::PassTime> passes;
    std::int64_t bytes = 0;
    std::vector<std::pair<std::string, std::int64_t>> counts;
};

}  // namespace shoal::frame
