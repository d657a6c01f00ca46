// Tangents follow MikkTSpace (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited") in weighting each triangle's
// tangent by the corner angle after projecting it into the vertex's plane, and in keeping the two handednesses apart.
// Departure: vertices are grouped as the file indexes them, not welded again by position.
#include "io/mesh_finish.h"

#include <array>
#include <cmath>

namespace shoal::io {

namespace {

template <class T>
void gather(const std::vector<T>& from, std::span<const std::uint32_t> source, std::vector<T>& to) {
    if (from.empty()) return;
    to.resize(source.size());
    for (std::size_t i = 0; i < source.size(); ++i) to[i] = from[source[i]];
}

bool finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// In double precision: the squares of very small or large floats leave the float range.
Vec3 unit(Vec3 v) {
    const double x = v.x, y = v.y, z = v.z, l = std::sqrt(x * x + y * y + z * z);
    if (!(l > 0) || !std::isfinite(l)) return {};
    return {float(x / l), float(y / l), float(z / l)};
}

// Twice the triangle's area along its normal, scaled so that no product overflows.
Vec3 faceNormal(Vec3 a, Vec3 b, Vec3 c) {
    const double ux = double(b.x) - a.x, uy = double(b.y) - a.y, uz = double(b.z) - a.z;
    const double vx = double(c.x) - a.x, vy = double(c.y) - a.y, vz = double(c.z) - a.z;
    const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    const double l = std::sqrt(x * x + y * y + z * z);
    if (!(l > 0)) return {};
    const double area = std::min(l, 1e30) / l;
    return {float(x * area), float(y * area), float(z * area)};
}

Vec3 anyPerpendicular(Vec3 n) { return unit(std::abs(n.x) < 0.7f ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0})); }

float cornerAngle(Vec3 at, Vec3 b, Vec3 c) {
    return std::acos(std::clamp(dot(unit(b - at), unit(c - at)), -1.0f, 1.0f));
}

// dP/du of a triangle and dP/dv, unit; nothing where the texture coordinates have no area.
struct TextureAxes {
    Vec3 u, v;
    bool valid = false;
};
TextureAxes textureAxes(std::array<Vec3, 3> p, std::array<Vec2, 3> uv) {
    const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
    const Vec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    const float det = d1.x * d2.y - d2.x * d1.y;
    if (!(std::abs(det) > 1e-20f)) return {};
    const float sign = det > 0 ? 1.0f : -1.0f;
    TextureAxes axes{unit((e1 * d2.y - e2 * d1.y) * sign), unit((e2 * d1.x - e1 * d2.x) * sign), true};
    axes.valid = finite(axes.u) && finite(axes.v) && axes.u != Vec3{} && axes.v != Vec3{};
    return axes;
}

}  // namespace

Primitive gatherVertices(const Primitive& p, std::span<const std::uint32_t> source) {
    Primitive out;
    out.material = p.material;
    gather(p.positions, source, out.positions);
    gather(p.normals, source, out.normals);
    gather(p.tangents, source, out.tangents);
    gather(p.uv0, source, out.uv0);
    gather(p.uv1, source, out.uv1);
    gather(p.colors, source, out.colors);
    gather(p.joints, source, out.joints);
    gather(p.weights, source, out.weights);
    out.morphTargets.resize(p.morphTargets.size());
    for (std::size_t t = 0; t < p.morphTargets.size(); ++t) {
        gather(p.morphTargets[t].positions, source, out.morphTargets[t].positions);
        gather(p.morphTargets[t].normals, source, out.morphTargets[t].normals);
        gather(p.morphTargets[t].tangents, source, out.morphTargets[t].tangents);
    }
    out.bounds = p.bounds;
    return out;
}

void makeFlatNormals(Primitive& p) {
    Primitive flat = gatherVertices(p, p.indices);
    flat.indices.resize(p.indices.size());
    flat.normals.resize(p.indices.size());
    flat.tangents.clear();
    for (auto& target : flat.morphTargets) target.normals.clear(), target.tangents.clear();
    for (std::uint32_t i = 0; i + 2 < flat.indices.size(); i += 3) {
        Vec3 n = unit(faceNormal(flat.positions[i], flat.positions[i + 1], flat.positions[i + 2]));
        if (n == Vec3{}) n = {0, 1, 0};
        for (std::uint32_t c = i; c < i + 3; ++c) flat.normals[c] = n, flat.indices[c] = c;
    }
    p = std::move(flat);
}

std::size_t repairNormals(Primitive& p) {
    std::vector<std::uint32_t> broken;
    for (std::size_t i = 0; i < p.normals.size(); ++i) {
        const Vec3 n = finite(p.normals[i]) ? unit(p.normals[i]) : Vec3{};
        if (n == Vec3{}) broken.push_back(std::uint32_t(i));
        p.normals[i] = n;
    }
    if (broken.empty()) return 0;
    std::vector<Vec3> sums(p.normals.size());
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        const Vec3 n =
            faceNormal(p.positions[p.indices[i]], p.positions[p.indices[i + 1]], p.positions[p.indices[i + 2]]);
        for (std::size_t c = i; c < i + 3; ++c) sums[p.indices[c]] += n;
    }
    for (const std::uint32_t i : broken) {
        p.normals[i] = unit(sums[i]);
        if (p.normals[i] == Vec3{}) p.normals[i] = {0, 1, 0};
    }
    return broken.size();
}

void repairTangents(Primitive& p) {
    for (std::size_t i = 0; i < p.tangents.size(); ++i) {
        const Vec3 n = p.normals[i], given{p.tangents[i].x, p.tangents[i].y, p.tangents[i].z};
        Vec3 t = finite(given) ? unit(given) : Vec3{};
        t = unit(t - n * dot(n, t));
        if (t == Vec3{}) t = anyPerpendicular(n);
        p.tangents[i] = {t.x, t.y, t.z, p.tangents[i].w < 0 ? -1.0f : 1.0f};
    }
}

void makeTangents(Primitive& p, bool fromUv1) {
    const std::vector<Vec2>& uv = fromUv1 ? p.uv1 : p.uv0;
    p.tangents.clear();
    std::vector<std::array<Vec3, 2>> sums(p.vertexCount());  // of handedness +1, -1
    std::vector<std::int8_t> handOfCorner(p.indices.size(), 0);
    std::vector<std::uint8_t> handsOfVertex(p.vertexCount(), 0);  // bit 0: +1, bit 1: -1
    for (std::size_t i = 0; !uv.empty() && i + 2 < p.indices.size(); i += 3) {
        const std::uint32_t v[3] = {p.indices[i], p.indices[i + 1], p.indices[i + 2]};
        const TextureAxes axes =
            textureAxes({p.positions[v[0]], p.positions[v[1]], p.positions[v[2]]}, {uv[v[0]], uv[v[1]], uv[v[2]]});
        if (!axes.valid) continue;
        for (int c = 0; c < 3; ++c) {
            const Vec3 at = p.positions[v[c]], n = p.normals[v[c]];
            const Vec3 t = unit(axes.u - n * dot(n, axes.u));
            // The bitangent of a normal map points up the picture; glTF's v counts down.
            const bool negative = dot(cross(n, t), axes.v) > 0;
            handOfCorner[i + std::size_t(c)] = negative ? -1 : 1;
            handsOfVertex[v[c]] |= negative ? 2 : 1;
            sums[v[c]][negative] += t * cornerAngle(at, p.positions[v[(c + 1) % 3]], p.positions[v[(c + 2) % 3]]);
        }
    }
    std::vector<std::uint32_t> source(p.vertexCount()), twin(p.vertexCount(), 0);
    for (std::uint32_t i = 0; i < p.vertexCount(); ++i) source[i] = i;
    for (std::uint32_t i = 0; i < p.vertexCount(); ++i)
        if (handsOfVertex[i] == 3) {
            twin[i] = std::uint32_t(source.size());
            source.push_back(i);
        }
    const std::size_t before = p.vertexCount();
    if (source.size() > before) {
        std::vector<std::uint32_t> indices = std::move(p.indices);
        for (std::size_t i = 0; i < indices.size(); ++i)
            if (handOfCorner[i] < 0 && twin[indices[i]]) indices[i] = twin[indices[i]];
        p = gatherVertices(p, source);
        p.indices = std::move(indices);
    }
    p.tangents.resize(source.size());
    for (std::size_t i = 0; i < source.size(); ++i) {
        const bool negative = i >= before || handsOfVertex[i] == 2;
        const Vec3 sum = sums[source[i]][negative];
        p.tangents[i] = {sum.x, sum.y, sum.z, negative ? -1.0f : 1.0f};
    }
    repairTangents(p);
}

std::size_t repairWeights(Primitive& p) {
    std::size_t broken = 0;
    for (std::size_t i = 0; i < p.weights.size(); ++i) {
        std::array<float, 4> w{p.weights[i].x, p.weights[i].y, p.weights[i].z, p.weights[i].w};
        double sum = 0;
        for (float& value : w) {
            if (!(value > 0) || !std::isfinite(value)) value = 0;
            sum += double(value);
        }
        if (!(sum > 0)) {
            w = {1, 0, 0, 0};
            sum = 1;
            ++broken;
        }
        for (float& value : w) value = float(double(value) / sum);
        p.weights[i] = {w[0], w[1], w[2], w[3]};
        U16Vec4& j = p.joints[i];
        if (w[0] == 0) j.x = 0;
        if (w[1] == 0) j.y = 0;
        if (w[2] == 0) j.z = 0;
        if (w[3] == 0) j.w = 0;
    }
    return broken;
}

void clearNonFinite(std::span<float> values) {
    for (float& value : values)
        if (!std::isfinite(value)) value = 0;
}

void computeBounds(Primitive& p) {
    p.bounds = {};
    for (const Vec3 v : p.positions) p.bounds.add(v);
}

}  // namespace shoal::io
