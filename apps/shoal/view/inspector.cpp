#include "view/inspector.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <epoxy/gl.h>

namespace shoal::viewer {

namespace {

std::uint8_t toByte(float x) { return std::uint8_t(std::lround(255 * std::clamp(x, 0.0f, 1.0f))); }

float encoded(float x) {
    x = std::clamp(x, 0.0f, 1.0f);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

// Dark blue, teal, green, yellow: equal steps look equal. A cubic fit of viridis [Smith and van der Walt 2015].
Vec3 viridis(float t) {
    t = std::clamp(t, 0.0f, 1.0f);
    const Vec3 c0{0.2777f, 0.0054f, 0.3341f}, c1{0.1051f, 1.4046f, 1.3846f}, c2{-0.3309f, 0.2148f, 0.0951f},
        c3{-4.6342f, -5.7991f, -19.3324f}, c4{6.2283f, 14.1799f, 56.6906f}, c5{4.7764f, -13.7451f, -65.3530f},
        c6{-5.4355f, 4.6459f, 26.3124f};
    return c0 + (c1 + (c2 + (c3 + (c4 + (c5 + c6 * t) * t) * t) * t) * t) * t;
}

// A colour of its own for every number; neighbours differ.
Vec3 colorOfId(std::uint32_t id) {
    const float hue = std::fmod(float(id) * 0.61803399f, 1.0f) * 6, value = 0.55f + 0.4f * float(id % 3) / 2;
    const auto part = [&](float shift) {
        return value * (0.35f + 0.65f * std::clamp(std::abs(std::fmod(hue + shift, 6.0f) - 3) - 1, 0.0f, 1.0f));
    };
    return {part(0), part(4), part(2)};
}

// The values that `low` and `high` of all finite ones lie below; few outliers must not make the rest grey.
std::pair<float, float> spanOf(const Image& image, bool skipZero) {
    std::vector<float> values;
    const std::size_t step = std::max<std::size_t>(1, image.pixels.size() / 40000);
    for (std::size_t i = 0; i < image.pixels.size(); i += step) {
        const float v = image.pixels[i];
        if (std::isfinite(v) && !(skipZero && v == 0)) values.push_back(v);
    }
    if (values.empty()) return {0, 1};
    std::sort(values.begin(), values.end());
    return {values[values.size() / 200], values[values.size() - 1 - values.size() / 200]};
}

const pipeline::AovInfo* infoOf(const std::string& name) {
    for (const pipeline::AovInfo& info : pipeline::aovs())
        if (name == info.name) return &info;
    return nullptr;
}

}  // namespace

ByteImage colorsOf(const std::string& aov, const Image& image, std::string& range) {
    ByteImage colors(image.width, image.height);
    const pipeline::AovInfo* info = infoOf(aov);
    const std::string channels = info ? info->channels : "";
    const std::string unit = info ? info->unit : "";
    const int count = image.channelCount;
    const bool isColor = channels == "RGB", isId = aov == "objectId", isNormal = aov == "normal", isMotion = count == 2;
    const bool isFraction = count == 1 && !isId && unit.empty();
    const auto [low, high] = spanOf(image, count == 1 && !isFraction);
    const float most = std::max(std::abs(low), std::abs(high));
    const bool isLog = aov == "depth" && low > 0 && high > 8 * low;  // near things differ too
    const float exposure = isColor && !unit.empty() && high > 0 ? 1 / high : 1;
    char text[120];
    if (isColor)
        std::snprintf(text, sizeof text, "white is %.3g %s", double(1 / exposure), unit.c_str());
    else if (isId)
        std::snprintf(text, sizeof text, "a colour an object");
    else if (isNormal)
        std::snprintf(text, sizeof text, "red x, green y, blue z; grey 0");
    else if (isMotion)
        std::snprintf(text, sizeof text, "grey 0, full colour %.3g %s", double(most), unit.c_str());
    else
        std::snprintf(text, sizeof text, "%.4g .. %.4g %s%s", isFraction ? 0.0 : double(low),
                      isFraction ? 1.0 : double(high), unit.c_str(), isLog ? ", logarithmic" : "");
    range = text;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float* v = image.at(x, y);
            Vec3 c;
            if (isColor)
                c = {encoded(v[0] * exposure), encoded(v[1] * exposure), encoded(v[2] * exposure)};
            else if (isId)
                c = v[0] > 0 ? colorOfId(std::uint32_t(v[0])) : Vec3{};
            else if (isNormal)
                c = v[0] == 0 && v[1] == 0 && v[2] == 0 ? Vec3{}
                                                        : Vec3{v[0], v[1], v[2]} * 0.5f + Vec3{0.5f, 0.5f, 0.5f};
            else if (isMotion)
                c = {0.5f + 0.5f * v[0] / std::max(most, 1e-6f), 0.5f + 0.5f * v[1] / std::max(most, 1e-6f), 0.5f};
            else if (isFraction)
                c = {v[0], v[0], v[0]};
            else if (v[0] != 0)
                c = viridis(isLog ? std::log(v[0] / low) / std::log(high / low)
                                  : (v[0] - low) / std::max(high - low, 1e-12f));
            std::uint8_t* to = colors.pixels.data() + (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4;
            to[0] = toByte(c.x), to[1] = toByte(c.y), to[2] = toByte(c.z), to[3] = 255;
        }
    }
    return colors;
}

std::vector<std::string> Inspector::wantedAovs(bool moving) const {
    if (!active()) return {};
    if (moving) return {chosen_};
    std::vector<std::string> all;
    for (const pipeline::AovInfo& info : pipeline::aovs()) all.push_back(info.name);
    return all;
}

Result<void> Inspector::take(gl::Device& device, pipeline::Pipeline& pipeline, int revision) {
    if (!active() || revision == revision_) return {};
    revision_ = revision;
    SHOAL_TRY_ASSIGN(layers_, pipeline.readAovs());
    for (const Layer& layer : layers_) {
        if (layer.name != chosen_) continue;
        ByteImage colors = colorsOf(layer.name, layer.image, range_);
        const auto rowBytes = std::size_t(colors.width) * 4;  // GL's row 0 is the bottom one
        for (int y = 0; y < colors.height / 2; ++y)
            std::swap_ranges(colors.pixels.begin() + std::ptrdiff_t(rowBytes * std::size_t(y)),
                             colors.pixels.begin() + std::ptrdiff_t(rowBytes * std::size_t(y + 1)),
                             colors.pixels.begin() + std::ptrdiff_t(rowBytes * std::size_t(colors.height - 1 - y)));
        if (texture_.width() != colors.width || texture_.height() != colors.height || !texture_) {
            gl::TextureDesc desc;
            desc.format = GL_RGBA8;
            desc.width = colors.width, desc.height = colors.height;
            desc.label = "buffer on screen";
            texture_ = gl::Texture::create(device, desc);
        }
        texture_.upload(0, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors.pixels.data());
    }
    return {};
}

std::vector<Inspector::Reading> Inspector::at(float x, float y, const scene::Content& content) const {
    std::vector<Reading> readings;
    for (const Layer& layer : layers_) {
        const Image& image = layer.image;
        const int px = std::clamp(int(x * float(image.width)), 0, image.width - 1);
        const int py = std::clamp(int(y * float(image.height)), 0, image.height - 1);
        const float* values = image.at(px, py);
        Reading reading{layer.name, "", ""};
        if (const pipeline::AovInfo* info = infoOf(layer.name)) reading.unit = info->unit;
        for (int c = 0; c < image.channelCount; ++c) {
            char text[40];
            std::snprintf(text, sizeof text, layer.name == "objectId" ? "%s%.0f" : "%s%.4g", c ? "  " : "",
                          double(values[c]));
            reading.value += text;
        }
        const std::size_t id = layer.name == "objectId" ? std::size_t(values[0]) : 0;
        if (id > 0 && id <= content.instances.size()) reading.value += "  " + content.instances[id - 1].name;
        readings.push_back(std::move(reading));
    }
    return readings;
}

}  // namespace shoal::viewer
