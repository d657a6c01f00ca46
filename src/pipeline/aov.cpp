#include "pipeline/aov.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <shoal/core/parallel.h>

#include "pipeline/water_pass.h"

namespace shoal::pipeline {

namespace {

constexpr AovInfo kAovs[] = {
    {"radiance", "RGB", "W/(m2 sr)", "the picture before exposure and tone curve, antialiased"},
    {"albedo", "RGB", "", "linear base colour of the first opaque surface"},
    {"normal", "XYZ", "", "world-space unit normal of the first opaque surface"},
    {"depth", "Z", "m",
     "view-space distance along the camera's axis to the first opaque surface, 0 where there is none"},
    {"motion", "XY", "px", "how far the surface moved since the frame before, x right, y down"},
    {"objectId", "X", "", "number of the instance, from 1; 0 where there is none"},
    {"direct", "RGB", "W/(m2 sr)", "radiance by the sun and lamps alone"},
    {"shadow", "V", "", "visible fraction of the sun, 1 lit"},
    {"occlusion", "V", "", "ambient occlusion, 1 open"},
    {"caustics", "RGB", "W/m2",
     "irradiance that light bent by the water surface puts on the first opaque surface; above the water what the "
     "surface reflects there"},
    {"inscatter", "RGB", "W/(m2 sr)", "radiance that water scatters into the pixel's path"},
    {"transmittance", "RGB", "", "fraction of the first opaque surface's radiance that water lets through"},
    {"waterDepth", "Z", "m", "water above the first opaque surface, 0 where there is none"},
};

// [Cigolle et al. 2014] octahedral map back to a unit vector; e in [0, 1]^2.
Vec3 octahedralDecode(float ex, float ey) {
    const float x = 2 * ex - 1, y = 2 * ey - 1;
    Vec3 n{x, y, 1 - std::abs(x) - std::abs(y)};
    const float t = std::max(-n.z, 0.0f);
    n.x += n.x >= 0 ? -t : t;
    n.y += n.y >= 0 ? -t : t;
    return normalize(n);
}

// Rewrites each pixel; `change` gets the source pixel, the target pixel and the view depth (0: nothing there).
template <class Change>
Image rewritten(const Image& from, const Image& viewDepth, int channelCount, const Change& change) {
    Image to(from.width, from.height, channelCount);
    parallelFor(std::size_t(from.height), 16, [&](std::size_t y) {
        for (int x = 0; x < from.width; ++x) change(from.at(x, int(y)), to.at(x, int(y)), *viewDepth.at(x, int(y)));
    });
    return to;
}

std::vector<std::string> channelNames(const AovInfo& info) {
    std::vector<std::string> names;
    for (const char* c = info.channels; *c; ++c) names.push_back(std::string(1, *c));
    return names;
}

// Water's own buffers; without water there is no light by it and nothing is dimmed.
Result<Image> readWaterSource(const AovSources& s, const std::string& name) {
    const int channels = name == "waterDepth" ? 1 : 3;
    if (s.water) {
        const gl::TextureView from = name == "caustics"        ? s.water->caustics()
                                     : name == "inscatter"     ? s.water->inscatter()
                                     : name == "transmittance" ? s.water->transmittance()
                                                               : s.water->waterDepth();
        if (from) return frame::readImage(s.device, from, channels);
    }
    Image image(s.targets.gbuffer().width, s.targets.gbuffer().height, channels);
    std::fill(image.pixels.begin(), image.pixels.end(), name == "transmittance" ? 1.0f : 0.0f);
    return image;
}

Result<Image> readSource(const AovSources& s, const std::string& name) {
    const frame::GBuffer& g = s.targets.gbuffer();
    const auto read = [&](const gl::TextureView& texture, int channels) {
        return frame::readImage(s.device, texture, channels);
    };
    if (name == "radiance") return read(s.post.radiance(), 3);
    if (name == "depth") return read(g.viewDepth, 1);
    if (name == "objectId") return read(g.objectId, 1);
    if (name == "direct") return read(s.lighting.direct(), 3);
    if (name == "shadow") return read(s.lighting.shadow(), 1);
    if (name == "occlusion") return read(s.lighting.occlusion(), 1);
    if (name == "caustics" || name == "inscatter" || name == "transmittance" || name == "waterDepth")
        return readWaterSource(s, name);
    SHOAL_TRY_ASSIGN(const Image depth, read(g.viewDepth, 1));
    if (name == "albedo") {
        SHOAL_TRY_ASSIGN(const Image coded, read(g.albedo, 4));
        return rewritten(coded, depth, 3, [](const float* from, float* to, float z) {
            for (int c = 0; c < 3; ++c) to[c] = z > 0 ? from[c] * from[c] : 0;
        });
    }
    if (name == "normal") {
        SHOAL_TRY_ASSIGN(const Image coded, read(g.normal, 2));
        return rewritten(coded, depth, 3, [](const float* from, float* to, float z) {
            const Vec3 n = z > 0 ? octahedralDecode(from[0], from[1]) : Vec3{};
            to[0] = n.x, to[1] = n.y, to[2] = n.z;
        });
    }
    SHOAL_ASSERT_EQ(name, std::string("motion"));
    SHOAL_TRY_ASSIGN(const Image up, read(g.motion, 2));
    return rewritten(up, depth, 2, [](const float* from, float* to, float) { to[0] = from[0], to[1] = -from[1]; });
}

}  // namespace

std::span<const AovInfo> aovs() { return kAovs; }

Result<std::vector<std::string>> parseAovList(std::string_view words) {
    std::vector<std::string> known, wanted;
    for (const AovInfo& info : kAovs) known.push_back(info.name);
    std::size_t at = 0;
    while (at <= words.size()) {
        const std::size_t end = std::min(words.find(',', at), words.size());
        const std::string name(words.substr(at, end - at));
        at = end + 1;
        if (name.empty()) continue;
        if (name == "all") return known;
        if (std::find(known.begin(), known.end(), name) == known.end())
            return usageError("--aov: " + unknownWord("AOV", name, known));
        if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) wanted.push_back(name);
    }
    return wanted;
}

Result<Layer> readAov(const AovSources& sources, const std::string& name) {
    SHOAL_TRY_ASSIGN(Image image, readSource(sources, name));
    for (const AovInfo& info : kAovs)
        if (name == info.name) image.channelNames = channelNames(info);
    return Layer{name, std::move(image)};
}

}  // namespace shoal::pipeline
