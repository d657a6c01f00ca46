#include <map>

#include <gtest/gtest.h>
#include <shoal/core/hash.h>
#include <shoal/core/parallel.h>
#include <shoal/core/pose.h>
#include <shoal/scene/shape_kinds.h>
#include <shoal/scene/shapes.h>

#include "scene/shapes/builder.h"

namespace shoal::scene {
namespace {

FieldValue valueOf(const char* words) { return parseFieldValue(words).value(); }

Model make(const char* kind, const std::vector<std::pair<const char*, const char*>>& settings = {}) {
    std::vector<ShapeSetting> list;
    for (const auto& [key, words] : settings) list.push_back({key, valueOf(words)});
    Result<Model> model = makeShape(kind, list);
    EXPECT_TRUE(model.has_value()) << kind << ": " << (model ? "" : model.error().message);
    return model ? std::move(*model) : Model{};
}

std::string errorOf(const char* kind, const char* key, const char* words) {
    const ShapeSetting setting{key, valueOf(words)};
    const Result<Model> model = makeShape(kind, std::span(&setting, 1));
    return model ? "made it" : model.error().message;
}

Bounds boundsOf(const Model& model) {
    Bounds all;
    for (const Node& node : model.nodes)
        if (node.mesh >= 0)
            for (const Primitive& p : model.meshes[std::size_t(node.mesh)].primitives)
                all.add(transformBounds(compose(node.translation, node.rotation, node.scale), p.bounds));
    return all;
}

bool finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// What core/model.h promises of a primitive. Counts instead of one assertion a vertex keep the report readable.
void checkPrimitive(const Model& model, const Primitive& p, const std::string& what) {
    ASSERT_GE(p.material, 0) << what;
    ASSERT_LT(std::size_t(p.material), model.materials.size()) << what;
    const Material& material = model.materials[std::size_t(p.material)];
    const std::size_t count = p.vertexCount();
    ASSERT_EQ(p.normals.size(), count) << what;
    ASSERT_EQ(p.uv0.size(), count) << what;
    ASSERT_EQ(p.colors.size(), count) << what;
    ASSERT_EQ(p.tangents.size(), material.normalTexture.image >= 0 ? count : 0) << what;
    ASSERT_EQ(p.indices.size() % 3, 0u) << what;
    std::size_t badVertices = 0, badTangents = 0, badIndices = 0, flatTriangles = 0, inverted = 0;
    Bounds bounds;
    for (std::size_t i = 0; i < count; ++i) {
        bounds.add(p.positions[i]);
        badVertices += !finite(p.positions[i]) || std::abs(length(p.normals[i]) - 1) > 1e-3f ||
                       !std::isfinite(p.uv0[i].x + p.uv0[i].y);
        badVertices += !(p.colors[i].x >= 0 && p.colors[i].x < 3 && p.colors[i].y >= 0 && p.colors[i].z >= 0);
        if (p.tangents.empty()) continue;
        const Vec3 t{p.tangents[i].x, p.tangents[i].y, p.tangents[i].z};
        badTangents +=
            std::abs(length(t) - 1) > 1e-3f || std::abs(dot(t, p.normals[i])) > 1e-3f || std::abs(p.tangents[i].w) != 1;
    }
    for (const std::uint32_t i : p.indices) badIndices += i >= count;
    ASSERT_EQ(badIndices, 0u) << what;
    for (std::size_t i = 0; i < p.indices.size(); i += 3) {
        const std::uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
        const Vec3 n = cross(p.positions[b] - p.positions[a], p.positions[c] - p.positions[a]);
        flatTriangles += length(n) == 0;
        inverted += dot(n, p.normals[a] + p.normals[b] + p.normals[c]) < 0;
    }
    EXPECT_EQ(badVertices, 0u) << what;
    EXPECT_EQ(badTangents, 0u) << what;
    EXPECT_EQ(flatTriangles, 0u) << what;
    // Folded details of displaced rocks may turn a few.
    EXPECT_LE(inverted, p.triangleCount() / 500) << what << " of " << p.triangleCount();
    EXPECT_EQ(bounds.lo, p.bounds.lo) << what;
    EXPECT_EQ(bounds.hi, p.bounds.hi) << what;
}

void checkModel(const Model& model, const std::string& what) {
    ASSERT_FALSE(model.meshes.empty()) << what;
    for (const ModelMesh& mesh : model.meshes) {
        EXPECT_FALSE(mesh.primitives.empty()) << what;
        for (const Primitive& p : mesh.primitives) checkPrimitive(model, p, what + "/" + mesh.name);
    }
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        EXPECT_LT(model.nodes[i].mesh, int(model.meshes.size())) << what;
        EXPECT_LT(model.nodes[i].parent, int(i)) << what;  // parents come first
        EXPECT_LT(model.nodes[i].skin, int(model.skins.size())) << what;
    }
    for (const Material& m : model.materials)
        for (const TextureUse* use : {&m.baseColorTexture, &m.normalTexture, &m.metallicRoughnessTexture})
            EXPECT_LT(use->image, int(model.images.size())) << what;
    for (const ByteImage& image : model.images)
        EXPECT_EQ(image.pixels.size(), std::size_t(image.width) * std::size_t(image.height) * 4) << what;
}

template <class T>
std::uint64_t hashOf(const std::vector<T>& values, std::uint64_t start) {
    return fnv1a(std::as_bytes(std::span(values)), start);
}
std::uint64_t hashOf(const Model& model) {
    std::uint64_t h = kFnvStart;
    for (const ModelMesh& mesh : model.meshes)
        for (const Primitive& p : mesh.primitives) {
            h = hashOf(p.positions, h), h = hashOf(p.normals, h), h = hashOf(p.tangents, h), h = hashOf(p.uv0, h);
            h = hashOf(p.colors, h), h = hashOf(p.indices, h);
        }
    for (const ByteImage& image : model.images) h = hashOf(image.pixels, h);
    for (const Node& node : model.nodes) h = hashOf(std::vector<Vec3>{node.translation, node.scale}, h);
    return h;
}

// Edges that are not shared by exactly two triangles running opposite ways, after welding equal positions.
std::size_t openEdges(const Primitive& p) {
    std::map<std::array<float, 3>, std::uint32_t> welded;
    std::vector<std::uint32_t> index;
    for (const Vec3 v : p.positions)
        index.push_back(welded.try_emplace({v.x, v.y, v.z}, std::uint32_t(welded.size())).first->second);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (std::size_t i = 0; i < p.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) ++uses[{index[p.indices[i + k]], index[p.indices[i + (k + 1) % 3]]}];
    std::size_t open = 0;
    for (const auto& [edge, count] : uses) {
        const auto back = uses.find({edge.second, edge.first});
        open += count != 1 || back == uses.end() || back->second != 1;
    }
    return open;
}

double volumeOf(const Primitive& p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.indices.size(); i += 3)
        sum += double(dot(p.positions[p.indices[i]],
                          cross(p.positions[p.indices[i + 1]], p.positions[p.indices[i + 2]]))) /
               6;
    return sum;
}

TEST(Shapes, EveryKindKeepsTheModelsPromises) {
    ASSERT_GE(shapeNames().size(), 11u);
    for (const std::string& kind : shapeNames()) {
        const Model model = make(kind.c_str());
        checkModel(model, kind);
        EXPECT_FALSE(describeShape(kind).empty()) << kind;
    }
}

TEST(Shapes, ExtremeParametersWork) {
    checkModel(make("terrain", {{"cells", "8"}, {"height", "0"}, {"rocks", "0"}, {"bushes", "0"}}), "flat terrain");
    checkModel(make("terrain", {{"island", "false"}, {"size", "2000"}, {"cells", "64"}, {"roughness", "1"}}), "hills");
    checkModel(make("tank", {{"width", "0.1"}, {"depth", "0.1"}, {"height", "0.05"}}), "tiny tank");
    checkModel(make("tank", {{"walls", "glass"}, {"width", "50"}}), "glass tank");
    checkModel(make("pier", {{"length", "1"}, {"width", "0.5"}, {"waterDepth", "0"}, {"deckHeight", "0.2"}}),
               "short pier");
    checkModel(make("quay", {{"length", "2"}, {"width", "1"}, {"waterDepth", "0"}, {"height", "0.4"}}), "short quay");
    checkModel(make("hall", {{"length", "4"}, {"width", "4"}, {"height", "3"}, {"bays", "1"}}), "shed");
    checkModel(make("hall", {{"roof", "false"}, {"frontWall", "false"}, {"shelves", "false"}}), "open hall");
    checkModel(make("plaza", {{"size", "8"}, {"center", "statue"}, {"pattern", "checker"}}), "small plaza");
    checkModel(
        make("plaza", {{"benches", "0"}, {"trees", "0"}, {"lamps", "0"}, {"walls", "false"}, {"center", "none"}}),
        "bare plaza");
    checkModel(make("rocks", {{"count", "1"}, {"area", "[0, 0]"}}), "one rock");
    checkModel(make("reef", {{"rocks", "1"}, {"corals", "0"}, {"height", "0"}, {"area", "[0.5, 0.5]"}}), "bare reef");
    checkModel(make("ruin", {{"length", "3"}, {"width", "2"}, {"columnHeight", "0.5"}, {"decay", "1"}}), "gone ruin");
    checkModel(make("ruin", {{"decay", "0"}, {"overgrowth", "0"}, {"columns", "2"}, {"arch", "false"}}), "temple");
    checkModel(make("seabed", {{"cells", "8"}, {"stones", "0"}, {"grass", "0"}, {"relief", "0"}, {"slope", "2"}}),
               "bare seabed");
    checkModel(make("fish", {{"count", "1"}, {"spread", "[0, 0, 0]"}, {"wander", "0"}, {"variation", "0"}}),
               "one fish");
    for (const char* species : {"sardine", "fusilier", "butterfly", "sergeant", "grouper"})
        checkModel(make("fish", {{"species", species}, {"count", "2"}}), species);
    for (const char* surface : {"wood", "stone", "concrete", "sand", "grit", "tiles"})
        checkModel(make("box", {{"surface", surface}}), surface);
}

TEST(Shapes, SameParametersSameBitsOnAnyThreadCount) {
    for (const std::string& kind : shapeNames()) {
        const std::uint64_t free = hashOf(make(kind.c_str()));
        const ThreadLimit one(1);
        EXPECT_EQ(free, hashOf(make(kind.c_str()))) << kind;
    }
}

TEST(Shapes, AnotherSeedIsAnotherShape) {
    for (const char* kind :
         {"terrain", "rocks", "tank", "pier", "quay", "hall", "plaza", "fish", "reef", "ruin", "seabed"})
        EXPECT_NE(hashOf(make(kind)), hashOf(make(kind, {{"seed", "2"}}))) << kind;
}

TEST(Shapes, SimpleSolidsAreClosedAndAsBigAsAsked) {
    const Model box = make("box", {{"size", "[2, 3, 4]"}, {"bevel", "0"}}),
                rounded = make("box", {{"size", "[2, 3, 4]"}, {"bevel", "0.1"}});
    for (const Model* model : {&box, &rounded}) {
        EXPECT_EQ(openEdges(model->meshes[0].primitives[0]), 0u);
        EXPECT_EQ(boundsOf(*model).lo, (Vec3{-1, 0, -2}));
        EXPECT_EQ(boundsOf(*model).hi, (Vec3{1, 3, 2}));
    }
    EXPECT_NEAR(volumeOf(box.meshes[0].primitives[0]), 24, 1e-4);
    EXPECT_LT(volumeOf(rounded.meshes[0].primitives[0]), 23.9);

    const Model sphere = make("sphere", {{"radius", "2"}, {"segments", "128"}});
    EXPECT_EQ(openEdges(sphere.meshes[0].primitives[0]), 0u);
    EXPECT_NEAR(volumeOf(sphere.meshes[0].primitives[0]), 32 * kPiD / 3, 0.05);
    EXPECT_NEAR(boundsOf(sphere).lo.y, 0, 1e-5);
    const Primitive& p = sphere.meshes[0].primitives[0];
    for (std::size_t i = 0; i < p.vertexCount(); ++i)
        EXPECT_GT(dot(p.normals[i], normalize(p.positions[i] - Vec3{0, 2, 0})), 0.999f);

    for (const char* bevel : {"0", "0.05"}) {
        const Model cylinder =
            make("cylinder", {{"radius", "1"}, {"height", "2"}, {"segments", "256"}, {"bevel", bevel}});
        EXPECT_EQ(openEdges(cylinder.meshes[0].primitives[0]), 0u) << bevel;
        EXPECT_NEAR(volumeOf(cylinder.meshes[0].primitives[0]), 2 * kPiD, 0.03);
    }
    EXPECT_EQ(boundsOf(make("plane", {{"width", "6"}, {"depth", "2"}})).size(), (Vec3{6, 0, 2}));
}

TEST(Shapes, TextureRunsAlongTheTangentAndUpThePicture) {
    // For every triangle: the position's derivative by u lies along the tangent, by v against cross(normal, tangent) *
    // w.
    for (const char* kind : {"box", "plane", "cylinder"}) {
        const Model model = make(kind, {{"surface", "stone"}});
        const Primitive& p = model.meshes[0].primitives[0];
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < p.indices.size(); i += 3) {
            const std::uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
            const Vec2 d1 = p.uv0[b] - p.uv0[a], d2 = p.uv0[c] - p.uv0[a];
            const float det = d1.x * d2.y - d2.x * d1.y;
            if (std::abs(det) < 1e-7f) continue;
            const Vec3 e1 = p.positions[b] - p.positions[a], e2 = p.positions[c] - p.positions[a];
            const Vec3 byU = (e1 * d2.y - e2 * d1.y) / det, byV = (e2 * d1.x - e1 * d2.x) / det;
            bool wrongHere = false;
            for (const std::uint32_t k : {a, b, c}) {
                const Vec3 t{p.tangents[k].x, p.tangents[k].y, p.tangents[k].z};
                const Vec3 bitangent = cross(p.normals[k], t) * p.tangents[k].w;
                wrongHere |= dot(byU, t) < -1e-4f || dot(byV, bitangent) > 1e-4f;
            }
            wrong += wrongHere;
        }
        // The eight corner triangles of a rounded box join three textures and fit none.
        EXPECT_LE(wrong, kind == std::string("box") ? 8u : 0u) << kind;
    }
}

TEST(Shapes, ACylindersCapsAreTexturedInMetres) {
    for (const char* height : {"0.5", "1.5", "6"}) {
        const Model model =
            make("cylinder", {{"surface", "stone"}, {"radius", "0.34"}, {"height", height}, {"bevel", "0.03"}});
        const Primitive& p = model.meshes[0].primitives[0];
        std::size_t cap = 0;
        for (std::size_t i = 0; i < p.indices.size(); i += 3) {
            const std::uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
            const Vec3 n = cross(p.positions[b] - p.positions[a], p.positions[c] - p.positions[a]);
            if (std::abs(n.y) < 0.999f * length(n)) continue;
            const Vec2 d1 = p.uv0[b] - p.uv0[a], d2 = p.uv0[c] - p.uv0[a];
            // A repetition covers 1.6 m: the triangle in texture space is as large as on the cap.
            EXPECT_NEAR(std::abs(d1.x * d2.y - d2.x * d1.y) * 1.6f * 1.6f / length(n), 1, 1e-3) << height;
            ++cap;
        }
        EXPECT_EQ(cap, 128u);
    }
}

TEST(Shapes, ScenesHaveTheirMeasures) {
    const Bounds tank = boundsOf(make("tank", {{"width", "4"}, {"depth", "3"}, {"height", "2"}, {"thickness", "0.1"}}));
    EXPECT_NEAR(tank.size().x, 4.2, 0.2);
    EXPECT_GT(tank.hi.y, 2);
    EXPECT_LT(tank.hi.y, 2.15f);
    const Bounds pier =
        boundsOf(make("pier", {{"length", "12"}, {"waterDepth", "3"}, {"deckHeight", "1"}, {"props", "0"}}));
    EXPECT_NEAR(pier.lo.z, -12, 0.3);
    EXPECT_NEAR(pier.lo.y, -3, 0.1);
    const Bounds quay =
        boundsOf(make("quay", {{"length", "20"}, {"height", "1.5"}, {"props", "0"}, {"bollards", "0"}}));
    EXPECT_NEAR(quay.size().x, 20, 0.1);
    EXPECT_NEAR(quay.hi.y, 1.5, 0.02);
    const Bounds hall = boundsOf(make("hall", {{"length", "30"}, {"width", "16"}, {"height", "6"}}));
    EXPECT_NEAR(hall.size().z, 30, 1);
    EXPECT_GT(hall.hi.y, 6.8f);
    const Bounds island = boundsOf(make("terrain", {{"rocks", "0"}, {"bushes", "0"}}));
    EXPECT_NEAR(island.size().x, 120, 1e-3);
    EXPECT_LE(island.hi.y, 14);
    EXPECT_GT(island.hi.y, 7);
    EXPECT_LT(island.lo.y, -4);
}

TEST(Shapes, AnIslandHasSeaAllRound) {
    const Model model = make("terrain", {{"rocks", "0"}, {"bushes", "0"}, {"size", "100"}});
    const Primitive& p = model.meshes[0].primitives[0];
    std::size_t beach = 0;
    for (const Vec3 v : p.positions) {
        if (std::max(std::abs(v.x), std::abs(v.z)) > 49.9f) {
            EXPECT_LT(v.y, -1);
        }
        beach += std::abs(v.y) < 0.3f;
    }
    EXPECT_GT(beach, p.vertexCount() / 100);
}

TEST(Shapes, SeaThingsHaveTheirMeasures) {
    const Bounds reef = boundsOf(make("reef", {{"area", "[8, 6]"}, {"height", "2"}, {"corals", "40"}}));
    EXPECT_GT(reef.size().x, 6);
    EXPECT_LT(reef.size().x, 12);
    EXPECT_GT(reef.hi.y, 1);
    EXPECT_LT(reef.hi.y, 5);
    const Bounds whole = boundsOf(make("ruin", {{"decay", "0"}, {"columnHeight", "4"}, {"arch", "false"}}));
    EXPECT_GT(whole.hi.y, 0.78f + 4);  // three steps, a column, its beam
    EXPECT_LT(whole.hi.y, 6);
    const Bounds fallen = boundsOf(make("ruin", {{"decay", "1"}, {"columnHeight", "4"}, {"arch", "false"}}));
    EXPECT_LT(fallen.hi.y, whole.hi.y - 0.5f);
    EXPECT_GT(fallen.size().z, whole.size().z + 1);  // its columns lie beside it
    const Model floor =
        make("seabed", {{"size", "100"}, {"slope", "0.1"}, {"flat", "4"}, {"stones", "0"}, {"grass", "0"}});
    const Primitive& sand = floor.meshes[0].primitives[0];
    EXPECT_NEAR(sand.bounds.size().x, 100, 1e-3);
    EXPECT_NEAR(sand.bounds.lo.y, -0.1 * 48, 1.5);
    std::size_t fine = 0;  // half of the rows lie within a tenth of the width
    for (const Vec3 p : sand.positions) {
        fine += std::abs(p.x) < 10;
        if (length(Vec3{p.x, 0, p.z}) < 2) {
            EXPECT_LT(std::abs(p.y), 0.15f);
        }
    }
    EXPECT_GT(fine, sand.vertexCount() / 2);
}

// A fish at a time: where the middle of its body is, and where it looks.
struct Swimmer {
    Vec3 at, ahead;
};
Swimmer swimmerAt(const Model& model, std::size_t fish, float time) {
    Pose pose;
    poseModel(model, 0, time, true, pose);
    const Mat4& root = pose.modelFromNode[1 + 5 * fish];
    return {transformPoint(root, {0, 0, 0}), normalize(transformDirection(root, {0, 0, 1}))};
}

TEST(Shapes, FishSwimForwardsRoundALoopThatCloses) {
    const Model model = make("fish", {{"count", "5"}, {"radius", "4"}, {"speed", "0.8"}, {"length", "0.3"}});
    ASSERT_EQ(model.clips.size(), 1u);
    const float lap = model.clips[0].duration;
    EXPECT_NEAR(lap, 2 * kPi * 4 / 0.8f, 1e-3);
    for (std::size_t fish = 0; fish < 5; ++fish) {
        float way = 0, turned = 0;
        for (int i = 0; i < 400; ++i) {
            const float time = lap * float(i) / 400;
            const Swimmer now = swimmerAt(model, fish, time), next = swimmerAt(model, fish, time + lap / 400);
            const Vec3 step = next.at - now.at;
            EXPECT_GT(dot(normalize(step), now.ahead), 0.97f) << fish << " at " << time;
            EXPECT_LT(length(step), 0.03f * 4) << fish << " at " << time;  // no jump where the clip starts again
            way += length(step);
            turned +=
                std::atan2(now.at.z * next.at.x - now.at.x * next.at.z, now.at.x * next.at.x + now.at.z * next.at.z);
        }
        EXPECT_NEAR(way, 2 * kPi * 4, 6) << fish;
        EXPECT_NEAR(turned, 2 * kPi, 1e-2) << fish;  // once round, counter-clockwise from above
    }
}

TEST(Shapes, FishBendTheirTailsAndKeepTheirHeads) {
    const Model model = make("fish", {{"count", "1"}, {"spread", "[0, 0, 0]"}, {"wander", "0"}, {"variation", "0"}});
    const Skin& skin = model.skins.at(0);
    ASSERT_EQ(skin.joints.size(), 4u);
    float mostTail = 0, mostHead = 0;
    for (int i = 0; i < 200; ++i) {
        Pose pose;
        poseModel(model, 0, float(i) * 0.013f, true, pose);
        const Mat4 fishFromModel = inverse(pose.modelFromNode[1]).value();
        const auto bent = [&](std::size_t joint, Vec3 p) {  // sideways, in lengths of the fish
            return std::abs(transformPoint(fishFromModel, transformPoint(pose.modelFromBind[0][joint], p * 0.22f)).x);
        };
        mostTail = std::max(mostTail, bent(3, {0, 0, -0.5f}));
        mostHead = std::max(mostHead, bent(0, {0, 0, 0.5f}));
    }
    EXPECT_GT(mostTail, 0.07f);  // a tenth of the length is what swimming fish do [Bainbridge 1958]
    EXPECT_LT(mostTail, 0.2f);
    EXPECT_LT(mostHead, 0.05f);
    // Every vertex hangs on at most two joints next to each other, and wholly.
    for (const Primitive& p : model.meshes.at(0).primitives) {
        ASSERT_EQ(p.joints.size(), p.vertexCount());
        for (const Vec4& w : p.weights) EXPECT_NEAR(w.x + w.y + w.z + w.w, 1, 1e-5);
    }
    EXPECT_EQ(openEdges(model.meshes[0].primitives[0]), 0u);  // the body is closed
}

TEST(Shapes, ErrorsNameTheField) {
    const Result<Model> unknown = makeShape("teank", {});
    ASSERT_FALSE(unknown.has_value());
    EXPECT_NE(unknown.error().message.find("tank"), std::string::npos) << unknown.error().message;
    EXPECT_EQ(unknown.error().kind, ErrorKind::badInput);
    EXPECT_NE(errorOf("tank", "widht", "3").find("width"), std::string::npos);
    EXPECT_NE(errorOf("tank", "width", "-1").find("width"), std::string::npos);
    EXPECT_NE(errorOf("tank", "walls", "paper").find("walls"), std::string::npos);
    EXPECT_NE(errorOf("tank", "width", "wide").find("width"), std::string::npos);
    EXPECT_NE(errorOf("sphere", "segments", "100000").find("segments"), std::string::npos);
    EXPECT_NE(errorOf("box", "surface", "gold").find("surface"), std::string::npos);
    EXPECT_EQ(errorOf("rocks", "largest", "0.01").find("largest"), 0u);
    EXPECT_EQ(errorOf("plaza", "size", "300").find("slabSize"), 0u);
    EXPECT_EQ(errorOf("fish", "radius", "0.5").find("spread"), 0u);
    EXPECT_NE(errorOf("fish", "species", "herring").find("sardine"), std::string::npos);
    EXPECT_NE(errorOf("fish", "count", "0").find("count"), std::string::npos);
    EXPECT_NE(errorOf("reef", "rocks", "0").find("rocks"), std::string::npos);
    EXPECT_NE(errorOf("ruin", "decay", "2").find("decay"), std::string::npos);
    EXPECT_NE(errorOf("seabed", "cells", "3").find("cells"), std::string::npos);
    EXPECT_TRUE(describeShape("nothing").empty());
}

TEST(Solids, IcosphereIsClosedAndRound) {
    const shapes::Blob blob = shapes::makeIcosphere(3);
    Primitive p;
    p.positions = blob.positions;
    p.indices = blob.indices;
    EXPECT_EQ(p.triangleCount(), 1280u);
    EXPECT_EQ(openEdges(p), 0u);
    EXPECT_NEAR(volumeOf(p), 4 * kPiD / 3, 0.05);
}

}  // namespace
}  // namespace shoal::scene
