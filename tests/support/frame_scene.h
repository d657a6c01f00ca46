// Small models and a frame's setup for tests of frame: what is drawn is known by construction.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include <shoal/core/model.h>
#include <shoal/frame/context.h>
#include <shoal/light/view.h>

namespace shoal::test {

// A parallelogram from `origin` along u and v; its normal is along cross(u, v), uvs are (0, 0) at the origin and (1, 1)
// opposite.
inline Primitive quad(Vec3 origin, Vec3 u, Vec3 v) {
    Primitive p;
    p.positions = {origin, origin + u, origin + u + v, origin + v};
    p.normals.assign(4, normalize(cross(u, v)));
    p.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    p.indices = {0, 1, 2, 0, 2, 3};
    for (const Vec3& x : p.positions) p.bounds.add(x);
    return p;
}

// A closed box with outward normals.
inline Primitive box(Vec3 lo, Vec3 hi) {
    const Vec3 d = hi - lo;
    const Vec3 x{d.x, 0, 0}, y{0, d.y, 0}, z{0, 0, d.z};
    const Primitive sides[] = {quad(lo, y, x),     quad(lo + z, x, y), quad(lo, x, z),
                               quad(lo + y, z, x), quad(lo, z, y),     quad(lo + x, y, z)};
    Primitive all;
    for (const Primitive& side : sides) {
        const std::uint32_t first = std::uint32_t(all.positions.size());
        all.positions.insert(all.positions.end(), side.positions.begin(), side.positions.end());
        all.normals.insert(all.normals.end(), side.normals.begin(), side.normals.end());
        all.uv0.insert(all.uv0.end(), side.uv0.begin(), side.uv0.end());
        for (const std::uint32_t i : side.indices) all.indices.push_back(first + i);
    }
    for (const Vec3& v : all.positions) all.bounds.add(v);
    return all;
}

// One node with one mesh of the given primitives; each gets the material of its index where there is one.
inline Model modelOf(std::vector<Primitive> primitives, std::vector<Material> materials = {}) {
    Model model;
    model.name = "test model";
    for (std::size_t i = 0; i < primitives.size(); ++i) primitives[i].material = i < materials.size() ? int(i) : -1;
    model.meshes.push_back({"mesh", std::move(primitives), {}});
    model.materials = std::move(materials);
    Node node;
    node.name = "node";
    node.mesh = 0;
    model.nodes.push_back(node);
    return model;
}

inline frame::Context contextOf(gl::Device& device, const light::View& view, std::uint32_t frameIndex = 0) {
    frame::Context context;
    context.device = &device;
    context.view = context.previousView = view;
    context.frameIndex = frameIndex;
    return context;
}

// All texels of a texture, `count` floats each, rows bottom first.
inline std::vector<float> readFloats(const gl::TextureView& texture, GLenum format, int count) {
    std::vector<float> values(std::size_t(texture.width) * std::size_t(texture.height) * std::size_t(count));
    glGetTextureImage(texture.name, 0, format, GL_FLOAT, GLsizei(values.size() * sizeof(float)), values.data());
    return values;
}

inline std::string dataFile(const std::string& name) { return std::string(SHOAL_DATA_DIR) + "/" + name; }

}  // namespace shoal::test
