// Tangents follow MikkTSpace (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited") in weighting each triangle's
// tangent by the corner angle after projecting it into the vertex's plane, and in summing the two handednesses apart.
// Departures: vertices are grouped as the file indexes them, not welded again by position; one shared by triangles of
// both handednesses is not doubled but takes the one with the larger angle, so a model keeps its file's vertex count.
#include "io/mesh_finish.h"

#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace shoal::io {

namespace {

// Where more corners meet, all their faces are averaged: comparing each with each would take too long.
constexpr std::size_t kCreaseCornerLimit = 256;

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

namespace {

// Vertices at the same place have the same number; returns how many there are.
std::size_t numberPositions(const std::vector<Vec3>& positions, std::vector<std::uint32_t>& number) {
    struct Hash {
        std::size_t operator()(const Vec3& v) const {
            std::uint64_t h = 0;
            for (const float f : {v.x, v.y, v.z})
                h = (h ^ std::bit_cast<std::uint32_t>(f == 0 ? 0.0f : f)) * 0x9E3779B97F4A7C15u;
            return std::size_t(h ^ h >> 32);
        }
    };
    std::unordered_map<Vec3, std::uint32_t, Hash> seen;
    seen.reserve(positions.size());
    number.reserve(positions.size());
    for (const Vec3 v : positions) number.push_back(seen.emplace(v, std::uint32_t(seen.size())).first->second);
    return seen.size();
}

// Corners (indices into p.indices) by position: those of place i are corners[first[i]] to corners[first[i + 1] - 1].
struct CornersByPlace {
    std::vector<std::uint32_t> first, corners;
};
CornersByPlace cornersByPlace(const Primitive& p) {
    std::vector<std::uint32_t> place;
    CornersByPlace out;
    out.first.assign(numberPositions(p.positions, place) + 1, 0);
    for (const std::uint32_t v : p.indices) ++out.first[place[v] + 1];
    for (std::size_t i = 1; i < out.first.size(); ++i) out.first[i] += out.first[i - 1];
    std::vector<std::uint32_t> next(out.first.begin(), out.first.end() - 1);
    out.corners.resize(p.indices.size());
    for (std::uint32_t c = 0; c < p.indices.size(); ++c) out.corners[next[place[p.indices[c]]]++] = c;
    return out;
}

// Weighted by the corner's angle, the faces within the crease angle of this corner's own.
std::vector<Vec3> creaseNormalOfCorners(const Primitive& p, float creaseCosine) {
    const std::size_t cornerCount = p.indices.size();
    std::vector<Vec3> face(cornerCount / 3), normal(cornerCount);
    std::vector<float> angle(cornerCount);
    for (std::size_t i = 0; i < cornerCount; i += 3) {
        const Vec3 v[3] = {p.positions[p.indices[i]], p.positions[p.indices[i + 1]], p.positions[p.indices[i + 2]]};
        face[i / 3] = unit(faceNormal(v[0], v[1], v[2]));
        for (std::size_t c = 0; c < 3; ++c) angle[i + c] = cornerAngle(v[c], v[(c + 1) % 3], v[(c + 2) % 3]);
    }
    const CornersByPlace places = cornersByPlace(p);
    for (std::size_t i = 0; i + 1 < places.first.size(); ++i) {
        const std::span<const std::uint32_t> around(places.corners.data() + places.first[i],
                                                    places.first[i + 1] - places.first[i]);
        const bool all = around.size() > kCreaseCornerLimit;
        Vec3 sum;
        for (std::size_t a = 0; a < around.size(); ++a) {
            const Vec3 own = face[around[a] / 3];
            if (!all || a == 0) {
                sum = {};
                for (const std::uint32_t b : around)
                    if (all || dot(own, face[b / 3]) >= creaseCosine) sum += face[b / 3] * angle[b];
            }
            Vec3 n = unit(sum);
            if (n == Vec3{}) n = own;
            normal[around[a]] = n == Vec3{} ? Vec3{0, 1, 0} : n;
        }
    }
    return normal;
}

}  // namespace

void makeCreaseNormals(Primitive& p, float creaseCosine) {
    const std::vector<Vec3> normalOfCorner = creaseNormalOfCorners(p, creaseCosine);
    constexpr std::uint32_t kNone = ~std::uint32_t(0);
    std::vector<std::uint32_t> head(p.vertexCount(), kNone), next, source, indices;  // new vertices of each old one
    std::vector<Vec3> normals;
    indices.reserve(p.indices.size());
    for (std::size_t c = 0; c < p.indices.size(); ++c) {
        const std::uint32_t old = p.indices[c];
        std::uint32_t found = head[old];
        while (found != kNone && !(normals[found] == normalOfCorner[c])) found = next[found];
        if (found == kNone) {
            found = std::uint32_t(source.size());
            source.push_back(old);
            normals.push_back(normalOfCorner[c]);
            next.push_back(head[old]);
            head[old] = found;
        }
        indices.push_back(found);
    }
    p.normals.clear();
    p = gatherVertices(p, source);
    p.normals = std::move(normals);
    p.indices = std::move(indices);
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
    struct Sum {
        Vec3 tangent;
        float angle = 0;
    };
    std::vector<std::array<Sum, 2>> sums(p.vertexCount());  // of handedness +1, -1
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
            const float angle = cornerAngle(at, p.positions[v[(c + 1) % 3]], p.positions[v[(c + 2) % 3]]);
            sums[v[c]][negative].tangent += t * angle;
            sums[v[c]][negative].angle += angle;
        }
    }
    p.tangents.resize(p.vertexCount());
    for (std::size_t i = 0; i < p.vertexCount(); ++i) {
        const bool negative = sums[i][1].angle > sums[i][0].angle;
        const Vec3 sum = sums[i][negative].tangent;
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
