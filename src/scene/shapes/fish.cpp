// A shoal of fish that swims round a loop: one skinned mesh, one clip of one lap.
#include <cmath>

#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/fish_body.h"
#include "scene/shapes/noise.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr int kLapKeys = 96, kBeatKeys = 8;
// How far a joint swings to a side (radians) and how much later than the one before it; the head swings against.
constexpr float kSwing[4] = {-0.05f, 0.09f, 0.17f, 0.30f}, kLag = 0.85f;

// A curve that closes on itself, so that a clip of one lap repeats without a jump: a circle with two wobbles.
struct Lap {
    float radius, wander, phase[3];

    Vec3 middle(float t) const {
        const float a = 2 * kPi * t;
        const float r =
            radius * (1 + wander * (0.22f * std::sin(2 * a + phase[0]) + 0.10f * std::sin(3 * a + phase[1])));
        return {r * std::sin(a), 0.10f * radius * wander * std::sin(2 * a + phase[2]), r * std::cos(a)};
    }
    Vec3 outwards(float t) const { return {std::sin(2 * kPi * t), 0, std::cos(2 * kPi * t)}; }
};

// A fish's place in the shoal: beside, above and behind its middle; it drifts by whole waves a lap.
struct Member {
    Vec3 place;
    float size, beatPhase, drift[6];
    int beats;

    Vec3 at(const Lap& lap, float t, const FishShape& shape) const {
        const float a = 2 * kPi * t;
        const Vec3 sway{std::sin(2 * a + drift[0]) + 0.6f * std::sin(5 * a + drift[1]),
                        std::sin(3 * a + drift[2]) + 0.6f * std::sin(4 * a + drift[3]),
                        std::sin(2 * a + drift[4]) + 0.6f * std::sin(3 * a + drift[5])};
        const Vec3 from = place + sway * (0.35f * shape.length) * Vec3{1, 0.6f, 1.4f};
        const float behind = t - from.z / (2 * kPi * shape.radius);
        return lap.middle(behind) + lap.outwards(behind) * from.x + Vec3{0, from.y, 0};
    }
};

// Well apart inside an ellipsoid: of several places tried, the one farthest from those taken.
std::vector<Member> gather(const FishShape& shape, float lapSeconds, Dice& dice) {
    std::vector<Member> members;
    // A tail beats about 0.75 times a body length swum [Bainbridge 1958].
    const float beats = std::max(1.0f, lapSeconds * std::max(0.8f, shape.speed / (0.75f * shape.length)));
    for (int i = 0; i < shape.count; ++i) {
        Member m{};
        float farthest = -1;
        for (int attempt = 0; attempt < 10; ++attempt) {
            Vec3 p{dice.range(-1, 1), dice.range(-1, 1), dice.range(-1, 1)};
            if (dot(p, p) > 1) p = normalize(p) * dice.unit();
            const Vec3 place = Vec3{shape.spread.x, shape.spread.y, shape.spread.z} * p * 0.5f;
            float nearest = 1e9f;
            for (const Member& other : members) nearest = std::min(nearest, length(other.place - place));
            if (nearest > farthest) farthest = nearest, m.place = place;
        }
        m.size = shape.length * (1 + shape.variation * dice.range(-1, 1));
        m.beatPhase = dice.range(0, 2 * kPi);
        m.beats = std::max(1, int(std::round(beats * dice.range(0.85f, 1.15f))));
        for (float& d : m.drift) d = dice.range(0, 2 * kPi);
        members.push_back(m);
    }
    return members;
}

void append(std::vector<float>& values, Quat q) { values.insert(values.end(), {q.x, q.y, q.z, q.w}); }

// Heading along the way with the back up, leaning into the turn.
Quat headingAt(const Lap& lap, const Member& member, float t, const FishShape& shape) {
    const float e = 0.004f;
    const Vec3 before = member.at(lap, t - e, shape), now = member.at(lap, t, shape),
               after = member.at(lap, t + e, shape);
    const Vec3 ahead = normalize(after - before), turn = cross(normalize(now - before), normalize(after - now));
    const float yaw = std::atan2(ahead.x, ahead.z), pitch = -std::asin(std::clamp(ahead.y, -0.7f, 0.7f));
    const float lean = std::clamp(-turn.y * 2.5f, -0.4f, 0.4f);
    return axisAngle({0, 1, 0}, yaw) * axisAngle({1, 0, 0}, pitch) * axisAngle({0, 0, 1}, lean);
}

// Channels of the fish whose first joint is node `root`.
void addSwimming(Clip& clip, const FishShape& shape, const Lap& lap, const Member& member, int root) {
    Channel way{root, ChannelTarget::translation, Interpolation::linear, {}, {}};
    Channel heading{root, ChannelTarget::rotation, Interpolation::linear, {}, {}};
    for (int k = 0; k <= kLapKeys; ++k) {
        const float t = float(k % kLapKeys) / kLapKeys, time = clip.duration * float(k) / kLapKeys;
        const Vec3 p = member.at(lap, t, shape);
        way.times.push_back(time), heading.times.push_back(time);
        way.values.insert(way.values.end(), {p.x, p.y, p.z});
        append(heading.values, headingAt(lap, member, t, shape));
    }
    clip.channels.push_back(std::move(way));
    clip.channels.push_back(std::move(heading));
    const int keys = member.beats * kBeatKeys;
    for (int joint = 0; joint < 4; ++joint) {
        Channel bend{root + 1 + joint, ChannelTarget::rotation, Interpolation::linear, {}, {}};
        for (int k = 0; k <= keys; ++k) {
            const float phase = 2 * kPi * float(k % kBeatKeys) / kBeatKeys + member.beatPhase - kLag * float(joint);
            bend.times.push_back(clip.duration * float(k) / float(keys));
            append(bend.values, axisAngle({0, 1, 0}, kSwing[joint] * std::sin(phase)));
        }
        clip.channels.push_back(std::move(bend));
    }
}

// The root that swims, and the spine behind it. In the bind pose every fish lies at the origin.
void addJoints(Model& model, const Member& member, int number) {
    Skin& skin = model.skins[0];
    const int root = int(model.nodes.size());
    Node node;
    node.name = "fish " + std::to_string(number + 1);
    node.translation = member.place;
    node.scale = {member.size, member.size, member.size};
    model.nodes.push_back(node);
    for (int joint = 0; joint < 4; ++joint) {
        Node bone;
        bone.name = "spine";
        bone.parent = root + joint;
        bone.translation = {0, 0,
                            kFishJoints[std::size_t(joint)] - (joint > 0 ? kFishJoints[std::size_t(joint) - 1] : 0)};
        model.nodes.push_back(bone);
        skin.joints.push_back(root + 1 + joint);
        skin.jointFromMesh.push_back(scaling({1 / member.size, 1 / member.size, 1 / member.size}));
        skin.jointFromMesh.back() = translation({0, 0, -kFishJoints[std::size_t(joint)]}) * skin.jointFromMesh.back();
    }
}

// A copy of the mesh for every fish, each moved by its own joints.
Primitive multiply(const Primitive& one, const std::vector<Member>& members, Dice& dice) {
    Primitive all;
    all.material = one.material;
    for (std::size_t fish = 0; fish < members.size(); ++fish) {
        const auto first = std::uint32_t(all.positions.size());
        const float shade = dice.range(0.85f, 1.1f);
        for (std::size_t i = 0; i < one.positions.size(); ++i) {
            const Vec4 c = one.colors[i];
            all.positions.push_back(one.positions[i] * members[fish].size);
            all.bounds.add(all.positions.back());
            all.colors.push_back({c.x * shade, c.y * shade, c.z * shade, 1});
            const auto joint = std::uint16_t(4 * fish);
            all.joints.push_back({joint, std::uint16_t(joint + 1), std::uint16_t(joint + 2), std::uint16_t(joint + 3)});
            all.weights.push_back(fishWeights(one.positions[i].z));
        }
        all.normals.insert(all.normals.end(), one.normals.begin(), one.normals.end());
        all.tangents.insert(all.tangents.end(), one.tangents.begin(), one.tangents.end());
        all.uv0.insert(all.uv0.end(), one.uv0.begin(), one.uv0.end());
        for (const std::uint32_t i : one.indices) all.indices.push_back(first + i);
    }
    return all;
}

}  // namespace

Result<Model> makeFish(const FishShape& shape) {
    SHOAL_TRY(validate(shape));
    if (shape.spread.x > 1.6f * shape.radius)
        return badInput("spread: found " + std::to_string(shape.spread.x) +
                        " m across, expected at most 1.6 times the radius of the way");
    Dice dice(shape.seed * 53 + 11);
    ModelBuilder builder("fish");
    const int skin = builder.addMaterial("scales", {1, 1, 1}, makeFishSkin(shape.species, shape.seed));
    const int fin = builder.addMaterial("fins", {1, 1, 1}, 0.5f), eye = builder.addMaterial("eyes", {1, 1, 1}, 0.15f);
    builder.material(fin).doubleSided = true;
    Part &body = builder.part(skin), &fins = builder.part(fin), &eyes = builder.part(eye);  // in this order
    addFish(body, fins, eyes, shape.species);
    Model model = builder.finish();

    const Lap lap{shape.radius, shape.wander, {dice.range(0, 6), dice.range(0, 6), dice.range(0, 6)}};
    Clip clip;
    clip.name = "swim";
    clip.duration = 2 * kPi * shape.radius / shape.speed;
    const std::vector<Member> members = gather(shape, clip.duration, dice);
    for (Primitive& primitive : model.meshes[0].primitives) {
        Dice shades(shape.seed * 59 + 1);  // the same for body and fins
        primitive = multiply(primitive, members, shades);
    }
    model.skins.emplace_back();
    model.skins[0].name = "shoal";
    model.nodes[0].skin = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
        const int root = int(model.nodes.size());
        addJoints(model, members[i], int(i));
        addSwimming(clip, shape, lap, members[i], root);
    }
    model.clips.push_back(std::move(clip));
    return model;
}

}  // namespace shoal::scene
