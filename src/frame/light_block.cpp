#include "frame/light_block.h"

#include <algorithm>
#include <cmath>

namespace shoal::frame {
namespace {

Vec4 with(Vec3 v, float w) { return {v.x, v.y, v.z, w}; }

// The polynomial of light.shared.h: light::evaluateIrradiance over pi, times the intensity [Ramamoorthi & Hanrahan
// 2001].
void fillIrradiance(const light::Sh9& sh, float intensity, Vec4 (&to)[9]) {
    constexpr float kY0 = 0.28209479f, kY1 = 0.48860251f, kY2 = 1.09254843f, kY20 = 0.31539157f, kY22 = 0.54627422f;
    constexpr float kBand1 = 2.0f / 3.0f, kBand2 = 0.25f;  // of the clamped cosine, over pi
    const auto put = [&](int i, Vec3 c) { to[i] = with(c * intensity, 0); };
    put(0, sh.c[0] * kY0 - sh.c[6] * (kBand2 * kY20));
    put(1, sh.c[1] * (kBand1 * kY1));
    put(2, sh.c[2] * (kBand1 * kY1));
    put(3, sh.c[3] * (kBand1 * kY1));
    put(4, sh.c[4] * (kBand2 * kY2));
    put(5, sh.c[5] * (kBand2 * kY2));
    put(6, sh.c[6] * (3 * kBand2 * kY20));
    put(7, sh.c[7] * (kBand2 * kY2));
    put(8, sh.c[8] * (kBand2 * kY22));
}

struct Affine {  // f(p) = at0 + p.x dx + p.y dy
    Vec3 at0, dx, dy;
};

// What `f` (a function of normalised device x, y in [-1, 1]) is over pixels, given that it is affine.
template <class F>
Affine overPixels(const light::View& view, const F& f) {
    const Vec3 corner = f(-1.0f, -1.0f);
    return {corner, (f(1.0f, -1.0f) - corner) / float(view.width), (f(-1.0f, 1.0f) - corner) / float(view.height)};
}

void fillRays(const Context& context, LightBlock& block) {
    const light::View& view = context.view;
    const Mat4 clipFromView = light::jittered(view, context.jitterPx.x, context.jitterPx.y);
    const Mat4 viewFromClip = inverse(clipFromView).value_or(view.viewFromClip);
    // On the near plane, where reversed z is 1.
    const auto near = [&](float x, float y) { return transformPoint(viewFromClip, {x, y, 1}); };
    const auto world = [&](Vec3 direction) { return transformDirection(view.worldFromView, direction); };
    Affine origin{}, ray{};
    if (view.orthographic) {
        origin = overPixels(view, [&](float x, float y) {
            const Vec3 p = near(x, y);
            return world({p.x, p.y, 0});
        });
        ray.at0 = world({0, 0, -1});
    } else {
        ray = overPixels(view, [&](float x, float y) {
            const Vec3 p = near(x, y);
            return world(p * (-1.0f / p.z));
        });
    }
    origin.at0 += view.eye;
    Affine behind = ray;
    if (view.orthographic) {
        // Parallel rays would see one point of the environment: the background is seen as a lens of 50 degrees would.
        const float up = std::tan(radians(25)), right = up * float(view.width) / float(view.height);
        behind = overPixels(view, [&](float x, float y) { return world({x * right, y * up, -1}); });
    }
    block.origin = with(origin.at0, 0), block.originX = with(origin.dx, 0), block.originY = with(origin.dy, 0);
    block.ray = with(ray.at0, 0), block.rayX = with(ray.dx, 0), block.rayY = with(ray.dy, 0);
    block.backgroundRay = with(behind.at0, 0), block.backgroundRayX = with(behind.dx, 0),
    block.backgroundRayY = with(behind.dy, 0);
}

// Angle between neighbouring pixels in the middle of the picture, radians.
float pixelAngle(const LightBlock& block, const light::View& view) {
    const auto direction = [&](float x, float y) {
        const Vec4 d = block.backgroundRay + block.backgroundRayX * x + block.backgroundRayY * y;
        return normalize(Vec3{d.x, d.y, d.z});
    };
    const float x = 0.5f * float(view.width), y = 0.5f * float(view.height);
    return std::max(length(direction(x, y + 1) - direction(x, y)), 1e-7f);
}

void fillSun(const Lights& lights, const LightingParams& params, float angleOfPixel, LightBlock& block) {
    block.sunEdge = {2, 1.5f, 0, 0};  // beyond any cosine
    if (!lights.sun) return;
    const light::Sun& sun = *lights.sun;
    block.toSun = with(normalize(sun.toSun), 1);
    block.sunIrradiance = with(sun.irradiance, 0.5f * sun.discHalfAngle);
    block.sunDisc = {0, 0, 0, sun.castsShadow ? 1.0f : 0.0f};
    if (!params.sunDisc || sun.discHalfAngle <= 0) return;
    // Half floats end at 65504 and the real disc at some 1e5: brightness is bent to stay below 40000 and keep its
    // colour.
    constexpr float kBrightest = 40000;
    const float solidAngle = 2 * kPi * (1 - std::cos(std::max(sun.discHalfAngle, 1e-4f)));
    const Vec3 radiance = sun.irradiance / solidAngle;
    const float strongest = std::max({radiance.x, radiance.y, radiance.z, 0.0f});
    block.sunDisc = with(radiance * (1 / (1 + strongest / kBrightest)), block.sunDisc.w);
    const float inner = std::max(sun.discHalfAngle - 0.5f * angleOfPixel, 0.0f),
                outer = sun.discHalfAngle + 0.5f * angleOfPixel;
    block.sunEdge = {std::cos(inner), std::cos(outer), 0, 0};
}

}  // namespace

LightBlock makeLightBlock(const Context& context, const LightingParams& params, const Lights& lights,
                          const EnvironmentShape& environment) {
    LightBlock block;
    fillRays(context, block);
    const float angleOfPixel = pixelAngle(block, context.view);
    fillSun(lights, params, angleOfPixel, block);
    fillIrradiance(environment.sh, params.environmentIntensity, block.irradiance);
    block.environment = {params.environmentIntensity, float(environment.prefilteredLevels),
                         float(environment.prefilteredSize), environment.rotation / (2 * kPi)};
    const int background = params.background == "transparent" ? SHOAL_BACKGROUND_TRANSPARENT
                           : params.background == "color"     ? SHOAL_BACKGROUND_COLOR
                                                              : SHOAL_BACKGROUND_ENVIRONMENT;
    block.background = with(params.backgroundColor, float(background));
    const float texelAngle = 2 * kPi / float(environment.sharpWidth);
    block.backgroundLevel = {
        params.backgroundBlur > 0 ? params.backgroundBlur * float(environment.prefilteredLevels - 1) : -1.0f,
        std::clamp(std::log2(angleOfPixel / texelAngle), 0.0f, float(environment.sharpLevels - 1)),
        angleOfPixel / texelAngle, 0};
    block.occlusion = {params.ambientOcclusion ? 1.0f : 0.0f, params.occlusionStrength, 0, 0};
    block.lightCount = {float(lights.punctual.size()), 0, 0, 0};
    block.medium = with(lights.medium.beamAttenuation, lights.medium.level);
    return block;
}

void makeLocalLights(std::span<const light::PunctualLight> lights, std::vector<LocalLight>& to) {
    using Kind = light::PunctualLight::Kind;
    to.clear();
    int shadowIndex = 0;
    for (const light::PunctualLight& light : lights) {
        const bool spot = light.kind == Kind::spot, shadow = spot && light.castsShadow;
        const float cosOuter = std::cos(light.outerCone), cosInner = std::cos(light.innerCone);
        const float scale = 1 / std::max(0.001f, cosInner - cosOuter);
        LocalLight out;
        out.position = with(light.position, light.range);
        out.direction = with(normalize(light.direction), std::max(light.radius, 1e-4f));
        out.intensity = with(light.intensity, shadow ? float(shadowIndex++) : -1.0f);
        out.cone = spot ? Vec4{scale, -cosOuter * scale, 0, 0} : Vec4{0, 1, 0, 0};
        to.push_back(out);
    }
}

}  // namespace shoal::frame
