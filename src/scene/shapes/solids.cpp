// The solids of builder.h.
#include <array>
#include <map>

#include "scene/shapes/builder.h"

namespace shoal::scene::shapes {
namespace {

// Planar texture coordinates for a face with a normal and a tangent: u along the tangent, v against cross(normal,
// tangent).
Vec2 planarUv(const Part& part, Vec3 p, Vec3 n, Vec3 t) {
    return {dot(p, t) * part.uvPerMetre + part.uvOffset.x, -dot(p, cross(n, t)) * part.uvPerMetre + part.uvOffset.y};
}

struct Face {
    int axis;
    float sign;
    Vec3 normal, tangent;                 // in the box's frame
    std::array<std::uint32_t, 4> corner;  // (-,-), (+,-), (-,+), (+,+) of the two other axes in order
};

Vec3 axisOf(int axis, float sign) { return {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0}; }
float component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct BoxMaker {
    Part& part;
    const Frame& frame;
    Vec3 half;
    float bevel;

    std::uint32_t corner(Vec3 local, Vec3 n, Vec3 t, Vec3 uvNormal, Vec3 uvTangent) const {
        return part.add(
            {frame.point(local), frame.direction(n), frame.direction(t), planarUv(part, local, uvNormal, uvTangent)});
    }

    Face face(int axis, float sign) const {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        Face f{axis, sign, axisOf(axis, sign), axisOf(component(half, b) >= component(half, c) ? b : c, 1), {}};
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3 p = f.normal * component(half, axis) +
                           axisOf(b, (i & 1 ? 1.0f : -1.0f) * (component(half, b) - bevel)) +
                           axisOf(c, (i & 2 ? 1.0f : -1.0f) * (component(half, c) - bevel));
            f.corner[i] = corner(p, f.normal, f.tangent, f.normal, f.tangent);
        }
        part.quad(f.corner[0], f.corner[1], f.corner[3], f.corner[2], frame.direction(f.normal));
        return f;
    }

    // The strip from face `a` over to face `b`; its far side gets vertices of its own that go on with a's texture.
    void edge(const Face& a, const Face& b) const {
        const int along = 3 - a.axis - b.axis;
        Vec3 tangent = a.tangent;
        if (std::abs(component(tangent, b.axis)) > 0.5f) tangent = a.normal * -b.sign;  // bent round the edge
        std::uint32_t near[2], far[2];
        for (int i = 0; i < 2; ++i) {
            const float s = i ? 1.0f : -1.0f;
            const int first = (a.axis + 1) % 3;
            const bool firstPlus = (first == along ? s : b.sign) > 0, secondPlus = (first == along ? b.sign : s) > 0;
            near[i] = a.corner[std::size_t(firstPlus) + 2 * std::size_t(secondPlus)];
            const Vec3 p = a.normal * (component(half, a.axis) - bevel) + b.normal * component(half, b.axis) +
                           axisOf(along, s * (component(half, along) - bevel));
            far[i] = corner(p, b.normal, tangent, a.normal, a.tangent);
        }
        part.quad(near[0], near[1], far[1], far[0], frame.direction(a.normal + b.normal));
    }
};

}  // namespace

void addBox(Part& part, const Frame& center, Vec3 half, float bevel) {
    if (std::min({half.x, half.y, half.z}) <= 0) return;
    bevel = std::clamp(bevel, 0.0f, 0.95f * std::min({half.x, half.y, half.z}));
    const BoxMaker maker{part, center, half, bevel};
    Face faces[3][2];
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) faces[axis][side] = maker.face(axis, side ? 1.0f : -1.0f);
    if (bevel <= 0) return;
    for (int axis = 0; axis < 3; ++axis)
        for (const Face& a : faces[axis])
            for (const Face& b : faces[(axis + 1) % 3]) maker.edge(a, b);
    for (std::size_t i = 0; i < 8; ++i) {  // corners
        const bool plus[3] = {(i & 1) != 0, (i & 2) != 0, (i & 4) != 0};
        std::uint32_t v[3];
        Vec3 out;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            v[axis] = faces[axis][plus[axis]]
                          .corner[std::size_t(plus[(axis + 1) % 3]) + 2 * std::size_t(plus[(axis + 2) % 3])];
            out += axisOf(int(axis), plus[axis] ? 1.0f : -1.0f);
        }
        part.triangle(v[0], v[1], v[2], center.direction(out));
    }
}

void addStandingBox(Part& part, const Frame& base, Vec3 size, float bevel) {
    addBox(part, base.at({0, size.y / 2, 0}), size * 0.5f, bevel);
}

void addBeam(Part& part, Vec3 from, Vec3 to, float width, float height, float bevel, Vec3 up) {
    const Vec3 along = normalize(to - from);
    Vec3 across = cross(along, up);
    if (length(across) < 1e-4f) across = cross(along, Vec3{0, 0, 1});
    if (length(across) < 1e-4f) across = Vec3{1, 0, 0};
    across = normalize(across);
    const Frame frame{(from + to) * 0.5f, along, cross(across, along), across};
    addBox(part, frame, {length(to - from) / 2, height / 2, width / 2}, bevel);
}

void addSlab(Part& part, const Frame& top, float halfX, float halfZ, float bevel) {
    const Vec3 t = halfX >= halfZ ? Vec3{1, 0, 0} : Vec3{0, 0, 1}, up{0, 1, 0};
    std::uint32_t inner[4], outer[4];
    const float signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; ++i) {
        const float sx = signs[i][0], sz = signs[i][1];
        const Vec3 p{sx * (halfX - bevel), 0, sz * (halfZ - bevel)}, q{sx * halfX, -bevel, sz * halfZ};
        inner[i] = part.add({top.point(p), top.y, top.direction(t), planarUv(part, p, up, t)});
        outer[i] = part.add(
            {top.point(q), top.direction(normalize(Vec3{sx, 0.8f, sz})), top.direction(t), planarUv(part, q, up, t)});
    }
    part.quad(inner[0], inner[1], inner[2], inner[3], top.y);
    for (int i = 0; i < 4; ++i) part.quad(inner[i], inner[(i + 1) % 4], outer[(i + 1) % 4], outer[i], top.y);
}

namespace {

struct ProfilePoint {
    Vec2 at;
    Vec2 normal;  // (radial, up)
    float arc;    // length along the profile
    bool flat;    // part of a level ring: planar texture
};

constexpr float kSharpCosine = 0.766f;  // of 40 degrees

// Segments of the profile as pairs of points, with normals shared where the profile is smooth.
std::vector<std::array<ProfilePoint, 2>> profileSegments(const std::vector<Vec2>& profile) {
    std::vector<Vec2> normals;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const Vec2 d = profile[i + 1] - profile[i];
        const float l = std::max(length(d), 1e-9f);
        normals.push_back({d.y / l, -d.x / l});
    }
    std::vector<std::array<ProfilePoint, 2>> segments;
    float arc = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const float l = length(profile[i + 1] - profile[i]);
        const bool flat = std::abs(normals[i].y) > 0.999f;
        const auto blend = [&](std::size_t other) {
            if (other >= normals.size() || dot(normals[i], normals[other]) < kSharpCosine) return normals[i];
            const Vec2 sum = normals[i] + normals[other];
            return sum * (1 / length(sum));
        };
        segments.push_back({ProfilePoint{profile[i], blend(i - 1), arc, flat},
                            ProfilePoint{profile[i + 1], blend(i + 1), arc + l, flat}});
        arc += l;
    }
    return segments;
}

}  // namespace

void addLathe(Part& part, const Frame& frame, const std::vector<Vec2>& profile, int segments, bool grainUp) {
    float widest = 0;
    for (const Vec2 p : profile) widest = std::max(widest, p.x);
    const float turns = std::max(1.0f, std::round(2 * kPi * widest * part.uvPerMetre));  // whole repetitions: no seam
    for (const std::array<ProfilePoint, 2>& ends : profileSegments(profile)) {
        std::vector<std::uint32_t> rings[2];
        for (int end = 0; end < 2; ++end)
            for (int i = 0; i <= segments; ++i) {
                const ProfilePoint& at = ends[std::size_t(end)];
                const float turn = float(i % segments) / float(segments), c = std::cos(2 * kPi * turn),
                            s = -std::sin(2 * kPi * turn);
                const Vec3 p{at.at.x * c, at.at.y, at.at.x * s}, n{at.normal.x * c, at.normal.y, at.normal.x * s};
                const Vec3 upwards{-at.normal.y * c, at.normal.x, -at.normal.y * s}, round{s, 0, -c};
                const Vec3 t = at.flat ? Vec3{1, 0, 0} : grainUp ? upwards : round;
                // Of a level ring the texture lies level too, though its normals may lean towards a rounded rim.
                const Vec3 level{0, at.normal.y < 0 ? -1.0f : 1.0f, 0};
                Vec2 uv = planarUv(part, p, at.flat ? level : n, t);
                const float turned = turns * float(i) / float(segments), climbed = at.arc * part.uvPerMetre;
                if (!at.flat) uv = part.uvOffset + (grainUp ? Vec2{climbed, turned} : Vec2{turned, -climbed});
                rings[end].push_back(part.add({frame.point(p), frame.direction(n), frame.direction(t), uv}));
            }
        for (std::size_t i = 0; i < std::size_t(segments); ++i) {
            const float turn = (float(i) + 0.5f) / float(segments), c = std::cos(2 * kPi * turn),
                        s = -std::sin(2 * kPi * turn);
            const Vec2 n = ends[0].normal + ends[1].normal;
            const Vec3 facing = frame.direction({n.x * c, n.y, n.x * s});
            if (ends[1].at.x > 0) part.triangle(rings[0][i], rings[1][i], rings[1][i + 1], facing);
            if (ends[0].at.x > 0) part.triangle(rings[0][i], rings[1][i + 1], rings[0][i + 1], facing);
        }
    }
}

void addCylinder(Part& part, const Frame& base, float radius, float height, float bevel, int segments) {
    bevel = std::clamp(bevel, 0.0f, 0.45f * std::min(radius, height));
    std::vector<Vec2> profile{{0, 0}, {radius - bevel, 0}};
    if (bevel > 0) {
        const float k = 0.2929f * bevel;  // 1 - cos 45 degrees: the rounding's middle
        profile.insert(profile.end(),
                       {{radius - k, k}, {radius, bevel}, {radius, height - bevel}, {radius - k, height - k}});
    } else {
        profile.push_back({radius, height});
    }
    if (bevel > 0) profile.push_back({radius - bevel, height});
    profile.push_back({0, height});
    addLathe(part, base, profile, segments);
}

void addSphere(Part& part, const Frame& center, float radius, int segments) {
    std::vector<Vec2> profile;
    const int rows = std::max(4, segments / 2);
    for (int i = 0; i <= rows; ++i) {
        const float a = kPi * float(i) / float(rows) - kPi / 2;
        profile.push_back({i == 0 || i == rows ? 0 : radius * std::cos(a), radius * std::sin(a)});
    }
    addLathe(part, center, profile, segments);
}

void addSheet(Part& part, const Frame& frame, float halfX, float halfZ) {
    const Vec3 t{1, 0, 0}, up{0, 1, 0};
    std::uint32_t v[4];
    for (int i = 0; i < 4; ++i) {
        const Vec3 p{i & 1 ? halfX : -halfX, 0, i & 2 ? halfZ : -halfZ};
        v[i] = part.add({frame.point(p), frame.y, frame.direction(t), planarUv(part, p, up, t)});
    }
    part.quad(v[0], v[1], v[3], v[2], frame.y);
}

Blob makeIcosphere(int level) {
    const float g = (1 + std::sqrt(5.0f)) / 2;
    Blob out;
    for (const Vec3 p : {Vec3{-1, g, 0},
                         {1, g, 0},
                         {-1, -g, 0},
                         {1, -g, 0},
                         {0, -1, g},
                         {0, 1, g},
                         {0, -1, -g},
                         {0, 1, -g},
                         {g, 0, -1},
                         {g, 0, 1},
                         {-g, 0, -1},
                         {-g, 0, 1}})
        out.positions.push_back(normalize(p));
    out.indices = {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
                   3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1};
    for (int i = 0; i < level; ++i) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [it, isNew] = middles.try_emplace(std::minmax(a, b), std::uint32_t(out.positions.size()));
            if (isNew) out.positions.push_back(normalize(out.positions[a] + out.positions[b]));
            return it->second;
        };
        std::vector<std::uint32_t> finer;
        for (std::size_t t = 0; t < out.indices.size(); t += 3) {
            const std::uint32_t a = out.indices[t], b = out.indices[t + 1], c = out.indices[t + 2];
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
        }
        out.indices = std::move(finer);
    }
    return out;
}

void addBlob(Part& part, const Frame& frame, const Blob& blob) {
    std::vector<Vec3> normals(blob.positions.size());
    for (std::size_t t = 0; t < blob.indices.size(); t += 3) {
        const std::uint32_t* v = &blob.indices[t];
        const Vec3 n = cross(blob.positions[v[1]] - blob.positions[v[0]], blob.positions[v[2]] - blob.positions[v[0]]);
        for (int k = 0; k < 3; ++k) normals[v[k]] += n;
    }
    // A vertex is added once for each axis that its triangles are projected along.
    std::vector<std::array<std::uint32_t, 3>> made(blob.positions.size(), {~0u, ~0u, ~0u});
    const Vec3 tint = part.color;
    const auto vertex = [&](std::uint32_t i, int axis, float sign) {
        std::uint32_t& index = made[i][std::size_t(axis)];
        if (index != ~0u) return index;
        const Vec3 n = normalize(normals[i]), p = blob.positions[i];
        const Vec3 flat = axisOf(axis, sign), t = axis == 0 ? Vec3{0, 0, -sign} : Vec3{1, 0, 0};
        if (!blob.colors.empty()) part.color = tint * blob.colors[i];
        return index = part.add({frame.point(p), frame.direction(n), frame.direction(t), planarUv(part, p, flat, t)});
    };
    for (std::size_t t = 0; t < blob.indices.size(); t += 3) {
        const std::uint32_t* v = &blob.indices[t];
        const Vec3 n = cross(blob.positions[v[1]] - blob.positions[v[0]], blob.positions[v[2]] - blob.positions[v[0]]);
        const Vec3 a{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
        const int axis = a.y >= a.x && a.y >= a.z ? 1 : a.x >= a.z ? 0 : 2;
        const float sign = component(n, axis) < 0 ? -1.0f : 1.0f;
        const std::uint32_t i0 = vertex(v[0], axis, sign), i1 = vertex(v[1], axis, sign), i2 = vertex(v[2], axis, sign);
        part.triangle(i0, i1, i2, frame.direction(n));
    }
    part.color = tint;
}

}  // namespace shoal::scene::shapes
