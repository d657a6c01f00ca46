// Builds small glTF files in memory: JSON text plus a binary chunk that grows as views are added.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace shoal::test {

// A .glb of the two chunks.
inline std::vector<std::byte> makeGlb(std::string json, std::vector<std::byte> binary) {
    while (json.size() % 4) json += ' ';
    while (binary.size() % 4) binary.push_back(std::byte(0));
    std::vector<std::byte> out;
    const auto word = [&](std::uint32_t v) {
        for (int i = 0; i < 4; ++i) out.push_back(std::byte(v >> (8 * i)));
    };
    const std::size_t total = 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
    word(0x46546C67), word(2), word(std::uint32_t(total));
    word(std::uint32_t(json.size())), word(0x4E4F534A);
    for (const char c : json) out.push_back(std::byte(c));
    if (!binary.empty()) {
        word(std::uint32_t(binary.size())), word(0x004E4942);
        out.insert(out.end(), binary.begin(), binary.end());
    }
    return out;
}

// Parts are JSON texts joined into the top-level arrays.
struct GltfBuilder {
    std::vector<std::byte> binary;
    std::vector<std::string> views, accessors, meshes, nodes, skins, animations, materials, textures, images, cameras,
        samplers;
    std::string scenes = R"([{"nodes":[0]}])", more;  // more: further top-level members, each with a leading comma

    template <class T>
    int view(const std::vector<T>& values) {
        while (binary.size() % 4) binary.push_back(std::byte(0));
        const std::size_t offset = binary.size(), size = values.size() * sizeof(T);
        binary.resize(offset + size);
        std::memcpy(binary.data() + offset, values.data(), size);
        views.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})", offset, size));
        return int(views.size()) - 1;
    }
    // An accessor over a view of its own; `more` such as R"(,"normalized":true)".
    template <class T>
    int accessor(const std::vector<T>& values, int componentType, std::string_view type, std::size_t count,
                 std::string_view moreFields = "") {
        const int index = view(values);
        accessors.push_back(fmt::format(R"({{"bufferView":{},"componentType":{},"type":"{}","count":{}{}}})", index,
                                        componentType, type, count, moreFields));
        return int(accessors.size()) - 1;
    }
    int floats(const std::vector<float>& values, std::string_view type, std::size_t count) {
        return accessor(values, 5126, type, count);
    }

    std::string json() const {
        std::string out = R"({"asset":{"version":"2.0"})";
        const auto list = [&](std::string_view key, const std::vector<std::string>& items) {
            if (!items.empty()) out += fmt::format(R"(,"{}":[{}])", key, fmt::join(items, ","));
        };
        if (!binary.empty()) out += fmt::format(R"(,"buffers":[{{"byteLength":{}}}])", binary.size());
        list("bufferViews", views), list("accessors", accessors), list("meshes", meshes), list("nodes", nodes);
        list("skins", skins), list("animations", animations), list("materials", materials);
        list("textures", textures), list("images", images), list("cameras", cameras), list("samplers", samplers);
        if (!nodes.empty() && !scenes.empty()) out += R"(,"scenes":)" + scenes;
        return out + more + "}";
    }
    std::vector<std::byte> glb() const { return makeGlb(json(), binary); }
};

// Quoted, with the place of `from` replaced: for one wrong thing in an otherwise right file.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return text;
}

// A skinned, textured, animated quad with two joints, a morph target, a normal map, a camera: one of everything.
// Nodes: 0 the mesh, 1 and 2 the joints (2 below 1), 3 the camera.
inline GltfBuilder skinnedQuad(const std::vector<std::uint8_t>& png) {
    GltfBuilder b;
    const int positions = b.floats({-1, 0, 0, 1, 0, 0, 1, 2, 0, -1, 2, 0}, "VEC3", 4);
    const int normals = b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 4);
    const int uv = b.floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 4);
    const int joints = b.accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5121, "VEC4", 4);
    const int weights = b.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    const int indices = b.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 6);
    const int morph = b.floats({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1}, "VEC3", 4);
    const int bind = b.floats(
        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1}, "MAT4", 2);
    const int times = b.floats({0, 1}, "SCALAR", 2);
    const int turns = b.floats({0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f}, "VEC4", 2);
    const int morphs = b.floats({0, 1}, "SCALAR", 2);
    const int picture = b.view(png);
    b.images = {fmt::format(R"({{"bufferView":{},"mimeType":"image/png"}})", picture)};
    b.samplers = {R"({"wrapS":33071,"wrapT":33648,"magFilter":9728})"};
    b.textures = {R"({"source":0,"sampler":0})"};
    b.materials = {
        R"({"name":"cloth","pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0},)"
        R"("normalTexture":{"index":0,"scale":0.5},"alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true})"};
    b.meshes = {fmt::format(
        R"({{"name":"quad","primitives":[{{"attributes":{{"POSITION":{},"NORMAL":{},"TEXCOORD_0":{},"JOINTS_0":{},)"
        R"("WEIGHTS_0":{}}},"indices":{},"material":0,"targets":[{{"POSITION":{}}}]}}],"weights":[0.5]}})",
        positions, normals, uv, joints, weights, indices, morph)};
    b.nodes = {R"({"name":"body","mesh":0,"skin":0})", R"({"name":"hip","children":[2]})",
               R"({"name":"spine","translation":[0,1,0]})", R"({"name":"eye","camera":0,"translation":[0,1,5]})"};
    b.skins = {fmt::format(R"({{"joints":[1,2],"inverseBindMatrices":{}}})", bind)};
    b.animations = {
        fmt::format(R"({{"name":"bend","channels":[{{"sampler":0,"target":{{"node":2,"path":"rotation"}}}},)"
                    R"({{"sampler":1,"target":{{"node":0,"path":"weights"}}}}],)"
                    R"("samplers":[{{"input":{},"output":{}}},{{"input":{},"output":{},"interpolation":"STEP"}}]}})",
                    times, turns, times, morphs)};
    b.cameras = {R"({"type":"perspective","perspective":{"yfov":0.7,"znear":0.05}})"};
    b.scenes = R"([{"nodes":[0,1,3]}])";
    return b;
}

// A 2x2 PNG: red, green / blue, white (8-bit RGB).
inline const std::vector<std::uint8_t>& smallPng() {
    static const std::vector<std::uint8_t> kPng = {
        0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44,
        0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00, 0x00, 0xFD,
        0xD4, 0x9A, 0x73, 0x00, 0x00, 0x00, 0x12, 0x49, 0x44, 0x41, 0x54, 0x78, 0xDA, 0x63, 0xF8,
        0xCF, 0xC0, 0xC0, 0x00, 0xC2, 0x0C, 0xFF, 0x81, 0x00, 0x00, 0x1F, 0xEE, 0x05, 0xFB, 0xF1,
        0xAB, 0xBA, 0x77, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
    return kPng;
}

}  // namespace shoal::test
