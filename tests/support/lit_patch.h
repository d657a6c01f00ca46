// A G-buffer of one surface that fills the picture, written without drawing anything: what lighting does to it has a
// known answer.
#pragma once

#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <cmath>
#include <memory>

#include <shoal/frame/lighting.h>
#include <shoal/frame/post.h>
#include <shoal/frame/shadows.h>
#include <shoal/frame/targets.h>

#include "frame/glsl_math.h"

namespace shoal::test {

struct Patch {
    Vec3 normal{0, 0, 1};  // world
    Vec3 baseColor{1, 1, 1};
    float roughness = 1, metallic = 0, f0 = 0;
    Vec3 emission{0, 0, 0};
    std::uint32_t flags = 0;
    float viewDepth = 0;  // metres; 0: nothing there
};

inline Vec3 storedBaseColor(Vec3 c) {  // as 8 bits keep it
    const auto one = [](float x) {
        const float s = std::round(std::sqrt(x) * 255) / 255;
        return s * s;
    };
    return {one(c.x), one(c.y), one(c.z)};
}

// An eye at the origin looking along -z.
inline light::View straightView(int width, int height, bool orthographic = false) {
    light::Camera camera = light::cameraLookingAt({0, 0, 0}, {0, 0, -1}, radians(40));
    if (orthographic) {
        camera.projection = light::Camera::Projection::orthographic;
        camera.heightM = 2, camera.farZ = 100;
    }
    return light::makeView(camera, width, height);
}

class LitPatch {
public:
    // The device's messages tell what went wrong.
    LitPatch(gl::Device& device, int width, int height, bool orthographic = true)
        : targets(*frame::Targets::create(device, width, height)), lighting(*frame::Lighting::create(device)),
          shadows(*frame::Shadows::create(device, {.sunResolution = 64, .spotResolution = 64})) {
        gl::setKnownState();
        context.device = &device;
        context.view = context.previousView = straightView(width, height, orthographic);
        params.ambientOcclusion = false;
        params.background = "color";
        params.backgroundColor = {0, 0, 0};
    }

    void put(const Patch& patch) {
        targets.beginSurfaces();
        const frame::GBuffer& g = targets.gbuffer();
        if (patch.viewDepth > 0) {
            const auto albedo = frame::glsl::encodeAlbedo({patch.baseColor.x, patch.baseColor.y, patch.baseColor.z});
            const auto normal = frame::glsl::encodeNormal({patch.normal.x, patch.normal.y, patch.normal.z});
            fill(g.albedo, Vec4{albedo.x, albedo.y, albedo.z, 1});
            fill(g.normal, Vec4{normal.x, normal.y, 0, 0});
            fill(g.material, Vec4{patch.roughness, patch.metallic, patch.f0 / 0.16f, float(patch.flags) / 255});
            fill(g.emission, Vec4{patch.emission.x, patch.emission.y, patch.emission.z, 0});
        }
        const Mat4& p = context.view.clipFromView;
        const float z = -patch.viewDepth,
                    depth = patch.viewDepth > 0 ? (p(2, 2) * z + p(2, 3)) / (p(3, 2) * z + p(3, 3)) : 0;
        glClearTexImage(g.depth.name, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
        targets.finishSurfaces(context);
    }

    // Radiance of the middle pixel under `lights`.
    Vec4 shaded(const frame::Lights& lights, const frame::LightOverrides& overrides = {}) {
        shadows.prepare(context, {}, lights.sun, lights.punctual, {});
        lighting.prepare(context, params, lights, targets);
        lighting.shade(context, params, shadows, overrides, targets);
        return at(context.view.width / 2, context.view.height / 2);
    }
    Vec4 at(int x, int y) {  // from the top
        const Image image = *frame::readImage(*context.device, targets.radiance(), 4);
        const float* p = image.at(x, y);
        return {p[0], p[1], p[2], p[3]};
    }

    void setConstantEnvironment(float radiance) {
        light::Environment environment;
        environment.radiance = Image(64, 32, 3);
        for (float& x : environment.radiance.pixels) x = radiance;
        ASSERT_TRUE(lighting.setEnvironment(environment));
    }

    frame::Targets targets;
    frame::Lighting lighting;
    frame::Shadows shadows;
    frame::Context context;
    frame::LightingParams params;

private:
    static void fill(const gl::TextureView& texture, Vec4 value) {
        glClearTexImage(texture.name, 0, GL_RGBA, GL_FLOAT, &value.x);
    }
};

}  // namespace shoal::test
