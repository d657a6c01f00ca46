// What of a scene is worth looking at, and the ground under a bare model.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <shoal/core/pose.h>
#include <shoal/scene/content.h>
#include <shoal/scene/shapes.h>

#include "scene/content_parts.h"

namespace shoal::scene {

namespace {

// One mesh of one instance as a box, and how much there is in it.
struct Box {
    Bounds bounds;
    std::size_t vertexCount = 0;
};

std::vector<Box> boxesOf(const Instance& instance, const Model& model) {
    Pose pose;
    poseModel(model, instance.clip, instance.startTime, instance.loop, pose);
    const Mat4 worldFromModel = transformAt(instance, 0);
    std::vector<Box> boxes;
    Box skinned{transformBounds(worldFromModel, posedBounds(model, pose)), 0};
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].mesh < 0) continue;
        for (const Primitive& primitive : model.meshes[std::size_t(model.nodes[i].mesh)].primitives) {
            // Skinned or morphing: the model's posed bounds stand for all of them.
            if (model.nodes[i].skin >= 0 || !primitive.morphTargets.empty())
                skinned.vertexCount += primitive.vertexCount();
            else
                boxes.push_back({transformBounds(worldFromModel * pose.modelFromNode[i], primitive.bounds),
                                 primitive.vertexCount()});
        }
    }
    if (skinned.vertexCount > 0) boxes.push_back(skinned);
    return boxes;
}

// The ground of a place: thin, low, and under most of what there is.
bool isGround(const Bounds& box, const Bounds& all) {
    constexpr float kCovered = 0.6f, kThinness = 0.1f, kLow = 0.25f;
    const Vec3 size = box.size(), whole = all.size();
    return box.lo.y - all.lo.y <= kLow * whole.y && size.x * size.z > kCovered * whole.x * whole.z &&
           size.y < kThinness * std::max(size.x, size.z);
}

// What is worth looking at among boxes that are sorted from large to small: without grounds, without the few
// far-reaching boxes (sea, sky dome) that together have less than 2 % of the vertices, and without what is little
// beside the rest (pebbles) as long as that is not most of it.
std::vector<Box> worthLookingAt(std::vector<Box> boxes, const Bounds& all) {
    std::vector<Box> things;
    std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(things),
                 [&](const Box& box) { return !isGround(box.bounds, all); });
    if (things.empty()) return boxes;
    std::size_t total = 0, first = 0, dropped = 0, little = 0;
    for (const Box& box : things) total += box.vertexCount;
    while (first + 1 < things.size() && 50 * (dropped + things[first].vertexCount) < total)
        dropped += things[first++].vertexCount;
    std::size_t end = things.size();
    constexpr float kLittle = 0.4f;
    while (end > first + 1 && things[end - 1].bounds.radius() < kLittle * things[first].bounds.radius() &&
           2 * (little + things[end - 1].vertexCount) < total)
        little += things[--end].vertexCount;
    return {things.begin() + std::ptrdiff_t(first), things.begin() + std::ptrdiff_t(end)};
}

std::vector<Box> allBoxes(const Content& content) {
    std::vector<Box> boxes;
    for (const Instance& instance : content.instances) {
        if (!instance.visible) continue;
        const std::vector<Box> more = boxesOf(instance, content.models[std::size_t(instance.model)]);
        boxes.insert(boxes.end(), more.begin(), more.end());
    }
    return boxes;
}

// Whether one of the boxes is the ground of a place.
bool holdGround(const std::vector<Box>& boxes, const Bounds& all) {
    constexpr float kPlaceWidth = 15;  // metres: a thin thing of less is a thing
    return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
        return isGround(box.bounds, all) && std::max(box.bounds.size().x, box.bounds.size().z) > kPlaceWidth;
    });
}

}  // namespace

void measure(Content& content) {
    std::vector<Box> boxes = allBoxes(content);
    for (const Box& box : boxes) content.bounds.add(box.bounds);
    content.hasGround = holdGround(boxes, content.bounds);
    std::stable_sort(boxes.begin(), boxes.end(),
                     [](const Box& a, const Box& b) { return a.bounds.radius() > b.bounds.radius(); });
    for (const Box& box : worthLookingAt(std::move(boxes), content.bounds)) {
        content.focus.add(box.bounds);
        content.focusBoxes.push_back(box.bounds);
    }
}

Result<void> addGround(const EnvironmentSpec& environment, Content& content) {
    const Bounds& bounds = content.bounds;
    if (bounds.empty() || content.hasGround) return {};
    FieldValue value;
    value.numbers = {std::clamp(double(60.0f * bounds.radius()), 1.0, 1000.0)};
    const ShapeSetting settings[] = {{"width", value}, {"depth", value}};
    SHOAL_TRY_ASSIGN(Model plane, makeShape("plane", settings));
    for (Material& material : plane.materials) {
        const Vec3 albedo = environment.groundAlbedo;
        material.baseColor = {albedo.x, albedo.y, albedo.z, 1};
        material.roughness = 1;
        material.metallic = 0;
        material.baseColorTexture = material.normalTexture = material.metallicRoughnessTexture = {};
    }
    Instance instance;
    instance.name = "ground";
    instance.model = int(content.models.size());
    instance.castsShadow = false;
    instance.worldFromModel =
        translation({bounds.center().x, bounds.lo.y - 0.002f * bounds.radius(), bounds.center().z});
    content.models.push_back(std::move(plane));
    content.instances.push_back(std::move(instance));
    return {};
}

}  // namespace shoal::scene
