#include "golden/models.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include <shoal/core/image.h>
#include <shoal/core/math.h>
#include <shoal/core/result.h>
#include <shoal/io/file.h>
#include <shoal/io/image.h>

#include "unit/io/gltf_builder.h"

namespace shoal::test {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

void must(const Result<void>& done) {
    if (!done) throw std::runtime_error(done.error().message);
}

// ---- pictures ----

// `at`(u, v) gives display-encoded r, g, b, a in 0..1; v = 0 is the top row.
ByteImage paint(int size, const std::function<Vec4(float, float)>& at) {
    Image image(size, size, 4);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const Vec4 c = at((float(x) + 0.5f) / float(size), (float(y) + 0.5f) / float(size));
            float* to = image.at(x, y);
            to[0] = c.x, to[1] = c.y, to[2] = c.z, to[3] = c.w;
        }
    return io::quantize(image);
}

// A checker whose colours tell u and v, with an F that tells which way round it is.
void writeUvPicture(const std::filesystem::path& folder) {
    must(io::writePng(folder / "uv.png", paint(64, [](float u, float v) -> Vec4 {
                          const bool stem = u > 0.25f && u < 0.4f && v > 0.15f && v < 0.85f;
                          const bool bars = u > 0.25f && ((u < 0.75f && v > 0.15f && v < 0.3f) ||
                                                          (u < 0.6f && v > 0.45f && v < 0.6f));
                          if (stem || bars) return {0.95f, 0.95f, 0.9f, 1};
                          const bool odd = (int(u * 8) + int(v * 8)) % 2;
                          return {0.2f + 0.6f * u, 0.2f + 0.6f * v, odd ? 0.25f : 0.6f, 1};
                      })));
}

// A leaf: green with holes; alpha goes from 1 to 0 over a tenth of the picture.
void writeLeafPicture(const std::filesystem::path& folder) {
    const ByteImage leaf = paint(64, [](float u, float v) -> Vec4 {
        const float x = 2 * u - 1, y = 2 * v - 1;
        const float angle = std::atan2(y, x), radius = std::sqrt(x * x + y * y);
        const float rim = 0.7f + 0.2f * std::cos(5 * angle);
        const float hole = std::hypot(x - 0.15f, y + 0.1f) - 0.18f;
        const float inside = std::min(rim - radius, hole);
        return {0.35f + 0.3f * u, 0.75f - 0.2f * v, 0.2f, std::clamp(inside / 0.1f + 0.5f, 0.0f, 1.0f)};
    });
    must(io::writePng(folder / "leaf.png", leaf, true));
}

// 3 x 3 round bumps as a tangent-space normal map; green points up the picture, as glTF says.
void writeBumpPicture(const std::filesystem::path& folder) {
    must(io::writePng(folder / "bumps.png", paint(96, [](float u, float v) -> Vec4 {
                          const float x = 2 * (3 * u - std::floor(3 * u)) - 1, y = 1 - 2 * (3 * v - std::floor(3 * v));
                          const float r2 = (x * x + y * y) / 0.64f;
                          Vec3 n{0, 0, 1};
                          if (r2 < 1) n = normalize(Vec3{x, y, 0.8f * std::sqrt(1 - r2) + 0.5f});
                          return {0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * n.z, 1};
                      })));
}

// Three lamps of different colours and sizes in front (-z), right (+x) and above of a dim room.
void writeRoomEnvironment(const std::filesystem::path& file) {
    Image map(128, 64, 3);
    const struct {
        Vec3 toLamp, radiance;
        float halfAngle;
    } lamps[] = {
        {{0, 0.2f, -1}, {6, 3, 1}, 0.35f}, {{1, 0.3f, 0}, {1, 2, 8}, 0.25f}, {{-0.2f, 1, 0.3f}, {3, 4, 3}, 0.5f}};
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const float azimuth = (float(x) + 0.5f) / float(map.width) * 2 * kPi - kPi;
            const float polar = (float(y) + 0.5f) / float(map.height) * kPi;
            const Vec3 d{std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
            Vec3 radiance = d.y < 0 ? Vec3{0.10f, 0.08f, 0.06f} : Vec3{0.25f, 0.28f, 0.32f};
            for (const auto& lamp : lamps) {
                const float angle = std::acos(std::clamp(dot(d, normalize(lamp.toLamp)), -1.0f, 1.0f));
                radiance += lamp.radiance * std::clamp((lamp.halfAngle - angle) / 0.08f, 0.0f, 1.0f);
            }
            float* to = map.at(x, y);
            to[0] = radiance.x, to[1] = radiance.y, to[2] = radiance.z;
        }
    must(io::writeExr(file, map));
}

// ---- meshes ----

struct Surface {
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint16_t> indices;
    std::size_t vertexCount() const { return positions.size() / 3; }
    void vertex(Vec3 p, Vec3 n, Vec2 uv) {
        for (float f : {p.x, p.y, p.z}) positions.push_back(f);
        for (float f : {n.x, n.y, n.z}) normals.push_back(f);
        uvs.push_back(uv.x), uvs.push_back(uv.y);
    }
};

// A grid of (columns + 1) x (rows + 1) vertices; `at`(column, row) adds one.
Surface gridSurface(int columns, int rows, const std::function<void(Surface&, int, int)>& at) {
    Surface s;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) at(s, x, y);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto a = std::uint16_t(y * (columns + 1) + x), b = std::uint16_t(a + columns + 1);
            for (int i : {int(a), a + 1, b + 1, int(a), b + 1, int(b)}) s.indices.push_back(std::uint16_t(i));
        }
    return s;
}

// 2 m x 2 m, upright on the ground, facing +z, the picture the right way up.
Surface quad() {
    return gridSurface(1, 1, [](Surface& s, int x, int y) {
        s.vertex({2.0f * float(x) - 1, 2.0f * float(y), 0}, {0, 0, 1}, {float(x), 1 - float(y)});
    });
}

// A tube of radius 0.3 m and 2 m height.
Surface tube() {
    return gridSurface(20, 24, [](Surface& s, int x, int y) {
        const float a = float(x) / 20 * 2 * kPi, h = float(y) / 24;
        const Vec3 n{std::sin(a), 0, std::cos(a)};
        s.vertex({0.3f * n.x, 2 * h, 0.3f * n.z}, n, {float(x) / 20, 1 - h});
    });
}

// A ball of radius 0.8 m about (0, 1, 0).
Surface ball() {
    return gridSurface(32, 16, [](Surface& s, int x, int y) {
        const float a = float(x) / 32 * 2 * kPi, e = (float(y) / 16 - 0.5f) * kPi;
        const Vec3 n{std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
        s.vertex(n * 0.8f + Vec3{0, 1, 0}, n, {float(x) / 32, 1 - float(y) / 16});
    });
}

// Adds the surface's accessors; gives the attributes and indices of a primitive without its braces' end.
std::string addSurface(GltfBuilder& b, const Surface& s, const std::string& moreAttributes = "") {
    const std::size_t n = s.vertexCount();
    const int positions = b.floats(s.positions, "VEC3", n), normals = b.floats(s.normals, "VEC3", n);
    const int uvs = b.floats(s.uvs, "VEC2", n);
    const int indices = b.accessor(s.indices, 5123, "SCALAR", s.indices.size());
    return fmt::format(R"("attributes":{{"POSITION":{},"NORMAL":{},"TEXCOORD_0":{}{}}},"indices":{},"material":0)",
                       positions, normals, uvs, moreAttributes, indices);
}

// ---- files ----

// A quad with one material. `picture`: "" or the file of texture 0.
GltfBuilder quadModel(const std::string& material, const std::string& picture, const std::string& extension = "") {
    GltfBuilder b;
    b.meshes = {fmt::format(R"({{"primitives":[{{{}}}]}})", addSurface(b, quad()))};
    b.nodes = {R"({"name":"quad","mesh":0})"};
    b.materials = {material};
    if (!picture.empty()) {
        b.images = {fmt::format(R"({{"uri":"{}"}})", picture)};
        b.textures = {R"({"source":0})"};
    }
    if (!extension.empty()) b.more = fmt::format(R"(,"extensionsUsed":["{}"])", extension);
    return b;
}

GltfBuilder leafModel(const std::string& alpha) {
    return quadModel(
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0,"roughnessFactor":0.8},)"
        R"("doubleSided":true)" +
            alpha + "}",
        "leaf.png");
}

GltfBuilder transformedModel(const std::string& transform) {
    return quadModel(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0)" + transform +
                         R"(},"metallicFactor":0,"roughnessFactor":0.9}})",
                     "uv.png", transform.empty() ? "" : "KHR_texture_transform");
}

GltfBuilder bumpModel(double scale) {
    return quadModel(fmt::format(R"({{"pbrMetallicRoughness":{{"baseColorFactor":[0.7,0.6,0.5,1],"metallicFactor":0,)"
                                 R"("roughnessFactor":0.5}},"normalTexture":{{"index":0,"scale":{}}}}})",
                                 scale),
                     "bumps.png");
}

GltfBuilder unlitModel(bool unlit) {
    return quadModel(
        fmt::format(R"({{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}},"metallicFactor":0}}{}}})",
                    unlit ? R"(,"extensions":{"KHR_materials_unlit":{}})" : ""),
        "uv.png", unlit ? "KHR_materials_unlit" : "");
}

GltfBuilder emissiveModel(double strength) {
    return quadModel(
        fmt::format(R"({{"pbrMetallicRoughness":{{"baseColorFactor":[0.1,0.1,0.1,1]}},"emissiveFactor":[1,1,1],)"
                    R"("emissiveTexture":{{"index":0}},"extensions":{{"KHR_materials_emissive_strength":)"
                    R"({{"emissiveStrength":{}}}}}}})",
                    strength),
        "uv.png", "KHR_materials_emissive_strength");
}

// Colours at the corners, seen from the front alone where it is not double-sided.
GltfBuilder cornerModel(bool doubleSided, bool colors) {
    GltfBuilder b;
    std::string more;
    if (colors)
        more = fmt::format(R"(,"COLOR_0":{})",
                           b.floats({1, 0.1f, 0.1f, 0.1f, 1, 0.1f, 0.1f, 0.1f, 1, 1, 1, 0.1f}, "VEC3", 4));
    b.meshes = {fmt::format(R"({{"primitives":[{{{}}}]}})", addSurface(b, quad(), more))};
    b.nodes = {R"({"name":"quad","mesh":0})"};
    b.materials = {fmt::format(
        R"({{"pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":0.9}},"doubleSided":{}}})", doubleSided)};
    return b;
}

// A tube on three joints that bends by `degrees` at each of the upper two within a second.
GltfBuilder skinnedModel(float degrees) {
    GltfBuilder b;
    const Surface s = tube();
    std::vector<std::uint8_t> joints;
    std::vector<float> weights;
    for (std::size_t i = 0; i < s.vertexCount(); ++i) {
        const float at = std::clamp((s.positions[3 * i + 1] - 0.5f) / 0.6f, 0.0f, 2.0f);  // 0 .. 2 along the joints
        const int lower = std::min(int(at), 1);
        for (int j : {lower, lower + 1, 0, 0}) joints.push_back(std::uint8_t(j));
        for (float w : {1 - (at - float(lower)), at - float(lower), 0.0f, 0.0f}) weights.push_back(w);
    }
    const std::size_t n = s.vertexCount();
    const std::string more = fmt::format(R"(,"JOINTS_0":{},"WEIGHTS_0":{})", b.accessor(joints, 5121, "VEC4", n),
                                         b.floats(weights, "VEC4", n));
    b.meshes = {fmt::format(R"({{"primitives":[{{{}}}]}})", addSurface(b, s, more))};
    std::vector<float> bind;
    for (float height : {0.0f, 0.8f, 1.4f})
        for (float f : {1.0f, 0.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, -height, 0.f, 1.f})
            bind.push_back(f);
    const int inverseBind = b.floats(bind, "MAT4", 3);
    const float half = degrees / 2 * kPi / 180;
    const int times = b.floats({0, 1}, "SCALAR", 2);
    const int turns = b.floats({0, 0, 0, 1, 0, 0, std::sin(half), std::cos(half)}, "VEC4", 2);
    b.images = {R"({"uri":"uv.png"})"};
    b.textures = {R"({"source":0})"};
    b.materials = {
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0,"roughnessFactor":0.6},)"
        R"("doubleSided":true})"};
    b.nodes = {R"({"name":"body","mesh":0,"skin":0})", R"({"name":"foot","children":[2]})",
               R"({"name":"knee","translation":[0,0.8,0],"children":[3]})",
               R"({"name":"head","translation":[0,0.6,0]})"};
    b.skins = {fmt::format(R"({{"joints":[1,2,3],"inverseBindMatrices":{}}})", inverseBind)};
    b.animations = {
        fmt::format(R"({{"name":"bend","channels":[{{"sampler":0,"target":{{"node":2,"path":"rotation"}}}},)"
                    R"({{"sampler":0,"target":{{"node":3,"path":"rotation"}}}}],)"
                    R"("samplers":[{{"input":{},"output":{}}}]}})",
                    times, turns)};
    b.scenes = R"([{"nodes":[0,1]}])";
    return b;
}

// A ball that is pressed flat and grows a nose; weights run from 0 to (first, second) within a second.
GltfBuilder morphingModel(float first, float second) {
    GltfBuilder b;
    const Surface s = ball();
    const std::size_t n = s.vertexCount();
    std::vector<float> flat, flatNormals, nose;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 p{s.positions[3 * i], s.positions[3 * i + 1] - 1, s.positions[3 * i + 2]};
        const Vec3 normal{s.normals[3 * i], s.normals[3 * i + 1], s.normals[3 * i + 2]};
        const Vec3 turned = normalize(Vec3{normal.x / 1.3f, normal.y / 0.4f, normal.z / 1.3f}) - normal;
        for (float f : {0.3f * p.x, -0.6f * p.y, 0.3f * p.z}) flat.push_back(f);
        for (float f : {turned.x, turned.y, turned.z}) flatNormals.push_back(f);
        const float tip = std::exp(-((p.x - 0.3f) * (p.x - 0.3f) + p.y * p.y) / 0.03f) * (p.z > 0 ? 0.8f : 0.0f);
        for (float f : {0.0f, 0.0f, tip}) nose.push_back(f);
    }
    const int flatAt = b.floats(flat, "VEC3", n), flatNormalsAt = b.floats(flatNormals, "VEC3", n);
    const int noseAt = b.floats(nose, "VEC3", n);
    const int times = b.floats({0, 1}, "SCALAR", 2), weights = b.floats({0, 0, first, second}, "SCALAR", 4);
    b.meshes = {fmt::format(R"({{"primitives":[{{{},"targets":[{{"POSITION":{},"NORMAL":{}}},{{"POSITION":{}}}]}}],)"
                            R"("weights":[0,0]}})",
                            addSurface(b, s), flatAt, flatNormalsAt, noseAt)};
    b.nodes = {R"({"name":"ball","mesh":0})"};
    b.materials = {
        R"({"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.35,0.2,1],"metallicFactor":0,"roughnessFactor":0.4}})"};
    b.animations = {
        fmt::format(R"({{"name":"press","channels":[{{"sampler":0,"target":{{"node":0,"path":"weights"}}}}],)"
                    R"("samplers":[{{"input":{},"output":{}}}]}})",
                    times, weights)};
    return b;
}

// A quad with a camera and a lamp of its own.
GltfBuilder cameraModel(double yfov) {
    GltfBuilder b = transformedModel("");
    b.cameras = {fmt::format(R"({{"type":"perspective","perspective":{{"yfov":{},"znear":0.1}}}})", yfov)};
    b.nodes = {R"({"name":"quad","mesh":0})",
               R"({"name":"eye","camera":0,"translation":[1.5,1.2,4],"rotation":[0,0.1736482,0,0.9848078]})",
               R"({"name":"lamp","translation":[0.5,1.4,1],"extensions":{"KHR_lights_punctual":{"light":0}}})"};
    b.scenes = R"([{"nodes":[0,1,2]}])";
    b.more = R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)"
             R"({"type":"point","color":[1,0.8,0.5],"intensity":2500}]}})";
    return b;
}

constexpr const char* kTransform =
    R"(,"extensions":{"KHR_texture_transform":{"offset":[0.2,0.1],"rotation":0.5,"scale":[2,1.5]}})";
constexpr const char* kTurnedBack =
    R"(,"extensions":{"KHR_texture_transform":{"offset":[0.2,0.1],"rotation":-0.5,"scale":[2,1.5]}})";

const std::map<std::string, std::function<GltfBuilder()>>& makers() {
    static const std::map<std::string, std::function<GltfBuilder()>> kMakers = {
        {"mask.glb", [] { return leafModel(R"(,"alphaMode":"MASK","alphaCutoff":0.5)"); }},
        {"mask_low.glb", [] { return leafModel(R"(,"alphaMode":"MASK","alphaCutoff":0.1)"); }},
        {"blend.glb", [] { return leafModel(R"(,"alphaMode":"BLEND")"); }},
        {"opaque.glb", [] { return leafModel(""); }},
        {"unlit.glb", [] { return unlitModel(true); }},
        {"lit.glb", [] { return unlitModel(false); }},
        {"emissive.glb", [] { return emissiveModel(6); }},
        {"emissive_half.glb", [] { return emissiveModel(3); }},
        {"transform.glb", [] { return transformedModel(kTransform); }},
        {"transform_flipped.glb", [] { return transformedModel(kTurnedBack); }},
        {"transform_none.glb", [] { return transformedModel(""); }},
        {"bumps.glb", [] { return bumpModel(1); }},
        {"bumps_half.glb", [] { return bumpModel(0.5); }},
        {"bumps_flat.glb", [] { return bumpModel(0); }},
        {"bumps_inverted.glb", [] { return bumpModel(-1); }},
        {"corners.glb", [] { return cornerModel(true, true); }},
        {"corners_front.glb", [] { return cornerModel(false, true); }},
        {"corners_white.glb", [] { return cornerModel(true, false); }},
        {"skinned.glb", [] { return skinnedModel(70); }},
        {"skinned_back.glb", [] { return skinnedModel(-70); }},
        {"skinned_half.glb", [] { return skinnedModel(35); }},
        {"morphing.glb", [] { return morphingModel(1, 1); }},
        {"morphing_half.glb", [] { return morphingModel(0.5f, 0.5f); }},
        {"morphing_first.glb", [] { return morphingModel(1, 0); }},
        {"camera.glb", [] { return cameraModel(0.7); }},
        {"camera_wide.glb", [] { return cameraModel(0.9); }},
    };
    return kMakers;
}

}  // namespace

std::vector<std::string> modelNames() {
    std::vector<std::string> names = {"room.exr"};
    for (const auto& maker : makers()) names.push_back(maker.first);
    return names;
}

void writeModel(const std::filesystem::path& folder, const std::string& name) {
    if (name == "room.exr") return writeRoomEnvironment(folder / name);
    const auto maker = makers().find(name);
    if (maker == makers().end()) throw std::runtime_error("no model " + name);
    const GltfBuilder model = maker->second();
    const std::string json = model.json();
    if (json.find("uv.png") != std::string::npos) writeUvPicture(folder);
    if (json.find("leaf.png") != std::string::npos) writeLeafPicture(folder);
    if (json.find("bumps.png") != std::string::npos) writeBumpPicture(folder);
    const std::vector<std::byte> bytes = model.glb();
    must(io::writeFileAtomically(folder / name, bytes));
}

}  // namespace shoal::test
