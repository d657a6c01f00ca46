// Puts a model together from solids. One Part a node and material; every vertex gets position, normal, tangent, texture
// coordinates (metres times Part::uvPerMetre) and colour.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include <shoal/core/model.h>

#include "scene/shapes/surfaces.h"

namespace shoal::scene::shapes {

// An orthonormal frame: where a solid stands and how it is turned.
struct Frame {
    Vec3 origin{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    Vec3 point(Vec3 p) const { return origin + direction(p); }
    Vec3 direction(Vec3 d) const { return x * d.x + y * d.y + z * d.z; }
    Frame at(Vec3 p) const { return {point(p), x, y, z}; }
    Frame turned(float yaw) const;               // radians about its y, counter-clockwise from above
    Frame tipped(Vec3 axis, float angle) const;  // about a unit axis in its own coordinates
};

struct Corner {
    Vec3 position, normal, tangent;  // world; tangent runs with increasing u, cross(normal, tangent) with decreasing v
    Vec2 uv;
};

class Part {
public:
    explicit Part(int material, float uvPerMetre) : uvPerMetre(uvPerMetre) { primitive_.material = material; }

    Vec3 color{1, 1, 1};  // linear, of the vertices that follow
    Vec2 uvOffset{0, 0};  // moved from block to block, so that no two look alike
    float uvPerMetre = 1;

    std::uint32_t add(const Corner& corner);
    // Counter-clockwise seen from where `facing` points.
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, Vec3 facing);
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, Vec3 facing);
    const std::vector<Vec3>& positions() const { return primitive_.positions; }
    bool empty() const { return primitive_.indices.empty(); }
    Primitive finish(bool withTangents);

private:
    Primitive primitive_;
};

class ModelBuilder {
public:
    explicit ModelBuilder(std::string name);

    // Geometry that follows belongs to a node of this name, placed as given.
    void beginNode(const std::string& name, Vec3 at = {0, 0, 0}, Quat turned = {}, float scale = 1);
    // The geometry of node `ofNode` (counted from 0) once more.
    void addInstance(const std::string& name, std::size_t ofNode, Vec3 at, Quat turned, float scale);
    // A material of one colour, or with a surface's textures; returns its index.
    int addMaterial(const std::string& name, Vec3 color, float roughness, float metallic = 0);
    int addMaterial(const std::string& name, Vec3 color, Surface surface);
    Material& material(int index) { return model_.materials[std::size_t(index)]; }
    // Where the current node's own geometry of a material goes; the reference stays good.
    Part& part(int material);

    Model finish();

private:
    struct Piece {
        std::size_t mesh;
        int material;
        Part part;
    };
    Model model_;
    std::vector<float> uvPerMetre_;  // of each material
    std::deque<Piece> pieces_;
};

// A box with rounded edges: bevel in metres, clamped to the smallest half extent; nothing where there is no room for
// one. Texture u runs along the longer side of each face.
void addBox(Part& part, const Frame& center, Vec3 half, float bevel);
// The same standing on frame.origin; size in full.
void addStandingBox(Part& part, const Frame& base, Vec3 size, float bevel);
// A box from one point to another, width x height across, `up` its upper side.
void addBeam(Part& part, Vec3 from, Vec3 to, float width, float height, float bevel, Vec3 up = {0, 1, 0});
// The upper side of a flat stone: rounded edge, nothing underneath. frame.origin in the middle of the top.
void addSlab(Part& part, const Frame& top, float halfX, float halfZ, float bevel);
// A body of revolution about frame.y: (radius, height) from below upwards along the outside; corners sharper than 40
// degrees stay sharp. Texture u runs round it, or along the profile (the grain of a trunk) where grainUp.
void addLathe(Part& part, const Frame& frame, const std::vector<Vec2>& profile, int segments, bool grainUp = false);
void addCylinder(Part& part, const Frame& base, float radius, float height, float bevel, int segments);
// A sphere about frame.origin.
void addSphere(Part& part, const Frame& center, float radius, int segments);
// A flat rectangle facing frame.y, cut into cells so that vertex colours can vary. Corners at +-halfX, +-halfZ.
void addSheet(Part& part, const Frame& frame, float halfX, float halfZ);

// A closed triangle mesh without texture coordinates (terrain-like or displaced): smooth normals, texture projected
// along the nearest axis. colors may be empty.
struct Blob {
    std::vector<Vec3> positions;
    std::vector<Vec3> colors;
    std::vector<std::uint32_t> indices;
};
Blob makeIcosphere(int level);  // 20 * 4^level triangles, radius 1
void addBlob(Part& part, const Frame& frame, const Blob& blob);

}  // namespace shoal::scene::shapes
