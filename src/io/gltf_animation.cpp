// Animations of glTF 2.0 (§3.11).
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "io/gltf_parts.h"

namespace shoal::io {

namespace {

struct Keys {
    std::vector<float> times;
    std::vector<std::uint32_t> kept;  // which of the file's keys the times are
    std::size_t fileCount = 0;
};

class AnimationReader {
public:
    AnimationReader(GltfDocument& document, Model& model, std::span<const int> placeOfNode)
        : document_(document), model_(model), placeOfNode_(placeOfNode) {}

    void readClip(const JsonValue& json);

private:
    const Keys& keys(const JsonValue& where);
    bool readTarget(const JsonValue& json, Channel& channel, std::size_t& width);
    void readValues(const JsonValue& sampler, std::size_t width, Channel& channel);

    GltfDocument& document_;
    Model& model_;
    std::span<const int> placeOfNode_;
    std::map<std::size_t, Keys> keys_;  // by accessor: the channels of a clip mostly share one
};

// Key times; of keys at the same time the first stays.
const Keys& AnimationReader::keys(const JsonValue& where) {
    const GltfAccessor accessor = document_.accessor(where, "SCALAR");
    const auto index = std::size_t(where.asReal());
    if (const auto found = keys_.find(index); found != keys_.end()) return found->second;
    const std::vector<float> times = document_.floats(accessor);
    Keys keys;
    keys.fileCount = times.size();
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i])) where.fail(fmt::format("key {} is at {} s, expected a finite time", i, times[i]));
        if (i && times[i] < times[i - 1])
            where.fail(fmt::format("key {} is at {:g} s, before the one at {:g} s", i, times[i], times[i - 1]));
        if (i && times[i] == times[i - 1]) continue;
        keys.times.push_back(times[i]);
        keys.kept.push_back(std::uint32_t(i));
    }
    if (keys.times.size() < times.size())
        document_.log(LogLevel::warning, fmt::format("{}: {} keys at the time of another were dropped", where.path(),
                                                     times.size() - keys.times.size()));
    return keys_.emplace(index, std::move(keys)).first->second;
}

// False for a channel that moves nothing here.
bool AnimationReader::readTarget(const JsonValue& json, Channel& channel, std::size_t& width) {
    json.require("target");
    const JsonValue target = json.object("target");
    const int node = target.index("node", placeOfNode_.size());
    if (node < 0) return false;
    channel.node = placeOfNode_[std::size_t(node)];
    const std::string& path = target.text("path");
    if (path == "translation" || path == "scale") {
        channel.target = path == "scale" ? ChannelTarget::scale : ChannelTarget::translation;
        width = 3;
    } else if (path == "rotation") {
        channel.target = ChannelTarget::rotation;
        width = 4;
    } else if (path == "weights") {
        channel.target = ChannelTarget::morphWeights;
        const int mesh = model_.nodes[std::size_t(channel.node)].mesh;
        width = mesh < 0 ? 0 : model_.meshes[std::size_t(mesh)].morphWeights.size();
        return width > 0;
    } else {
        document_.log(LogLevel::warning, fmt::format("{}: path \"{}\" is ignored", target.path(), path.substr(0, 40)));
        return false;
    }
    return true;
}

void AnimationReader::readValues(const JsonValue& sampler, std::size_t width, Channel& channel) {
    const Keys& times = keys(sampler.require("input"));
    const JsonValue output = sampler.require("output");
    const GltfAccessor accessor = document_.accessor(output, "SCALAR|VEC3|VEC4");
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;
    const std::size_t perKey = width * (cubic ? 3 : 1);
    const std::size_t there = accessor.count * std::size_t(accessor.componentCount);
    const bool rightType = channel.target == ChannelTarget::morphWeights
                               ? accessor.componentCount == 1
                               : std::size_t(accessor.componentCount) == width;
    if (!rightType) output.fail(fmt::format("{} numbers an element, expected {}", accessor.componentCount, width));
    if (there < times.fileCount * perKey || there % perKey)
        output.fail(fmt::format("{} numbers, but {} keys need {}", there, times.fileCount, times.fileCount * perKey));
    const std::vector<float> values = document_.floats(accessor);
    document_.charge(output, times.times.size() * (perKey + 1) * sizeof(float));
    channel.times = times.times;
    channel.values.reserve(times.kept.size() * perKey);
    for (const std::uint32_t key : times.kept)
        channel.values.insert(channel.values.end(), values.begin() + std::ptrdiff_t(key * perKey),
                              values.begin() + std::ptrdiff_t((key + 1) * perKey));
    for (std::size_t i = 0; i < channel.values.size(); ++i)
        if (!(std::abs(channel.values[i]) <= 1e18f))
            output.fail(fmt::format("key {} is not finite", times.kept[i / perKey]));
    if (channel.target != ChannelTarget::rotation) return;
    for (std::size_t key = 0; key < channel.times.size(); ++key) {
        float* q = channel.values.data() + key * perKey + (cubic ? width : 0);
        const double l =
            std::sqrt(double(q[0]) * q[0] + double(q[1]) * q[1] + double(q[2]) * q[2] + double(q[3]) * q[3]);
        if (!(l > 1e-12)) output.fail(fmt::format("key {} is a quaternion of length 0", times.kept[key]));
        for (int c = 0; c < 4; ++c) q[c] = float(double(q[c]) / l);
    }
}

void AnimationReader::readClip(const JsonValue& json) {
    Clip clip;
    clip.name = json.text("name");
    const JsonValue channels = json.array("channels"), samplers = json.array("samplers");
    for (std::size_t i = 0; i < channels.size(); ++i) {
        Channel channel;
        std::size_t width = 0;
        const int index = channels[i].requireIndex("sampler", samplers.size());
        if (!readTarget(channels[i], channel, width)) continue;
        const JsonValue sampler = samplers[std::size_t(index)];
        const std::string& interpolation = sampler.text("interpolation");
        if (interpolation == "STEP")
            channel.interpolation = Interpolation::step;
        else if (interpolation == "CUBICSPLINE")
            channel.interpolation = Interpolation::cubicSpline;
        else if (!interpolation.empty() && interpolation != "LINEAR")
            sampler.fail("interpolation, expected LINEAR, STEP or CUBICSPLINE");
        readValues(sampler, width, channel);
        clip.duration = std::max(clip.duration, channel.times.back());
        clip.channels.push_back(std::move(channel));
    }
    model_.clips.push_back(std::move(clip));
}

}  // namespace

void readGltfAnimations(GltfDocument& document, Model& model, std::span<const int> placeOfNode) {
    AnimationReader reader(document, model, placeOfNode);
    const JsonValue animations = document.list("animations");
    for (std::size_t i = 0; i < animations.size(); ++i) reader.readClip(animations[i]);
}

}  // namespace shoal::io
