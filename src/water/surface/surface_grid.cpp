// Nested grid levels after [Losasso & Hoppe 2004] Geometry Clipmaps, with the transition of [Strugar 2009] CDLOD.
#include "water/surface/surface_grid.h"

#include <cmath>

namespace shoal::water {
namespace {

constexpr int kBlocks = 8;        // blocks a side of a level
constexpr float kSnapCells = 32;  // levels move by so many cells: a block's width in the next level
constexpr float kLeastCell = 1.0f / 64, kLargestCell = 1024;  // of the finest level, metres
constexpr float kCellsPerHeight = 24;                         // finest cells in the eye's height above the water
constexpr float kCellsPerWave = 8;                            // cells in the shortest wave need not be smaller
constexpr float kCellsPerView = 96;                           // cells across an orthographic view's height
constexpr float kFarthest = 6e4f;  // metres that the levels reach from the eye before the rim goes to the horizon
constexpr int kMostLevels = 28;

float powerOfTwoBelow(float x) { return std::exp2(std::floor(std::log2(x))); }

struct Square {
    Vec2 lo, hi;
};

bool overlaps(const Square& s, const BodyParams& body) {
    return s.lo.x < body.areaMax.x && s.hi.x > body.areaMin.x && s.lo.y < body.areaMax.y && s.hi.y > body.areaMin.y;
}

// Whether a box may be seen: not all corners lie outside the same side of the view.
bool seen(const Mat4& clipFromWorld, const Square& s, float low, float high) {
    int outside[5] = {};
    for (int i = 0; i < 8; ++i) {
        const Vec4 c = clipFromWorld * Vec4{i & 1 ? s.hi.x : s.lo.x, i & 2 ? high : low, i & 4 ? s.hi.y : s.lo.y, 1};
        const float w = 1.02f * c.w;  // the picture moves by part of a pixel
        outside[0] += c.x<-w, outside[1] += c.x> w, outside[2] += c.y<-w, outside[3] += c.y> w;
        outside[4] += c.z > c.w;
    }
    for (const int count : outside)
        if (count == 8) return false;
    return true;
}

// The middle, and the finest level's cell.
void chooseScale(const light::View& view, const Body& body, SurfaceGrid& grid) {
    const WaveBounds bounds = body.waves ? body.waves->bounds() : WaveBounds{};
    grid.middle = {view.eye.x, view.eye.z};
    float cell = (std::abs(view.eye.y - body.params.level) - float(bounds.height)) / kCellsPerHeight;
    if (view.orthographic) {
        cell = 2 / view.clipFromView(1, 1) / kCellsPerView;
        const Vec3 forward{-view.worldFromView(0, 2), -view.worldFromView(1, 2), -view.worldFromView(2, 2)};
        if (std::abs(forward.y) > 1e-3f) {
            const float t = (body.params.level - view.eye.y) / forward.y;
            grid.middle = {view.eye.x + t * forward.x, view.eye.z + t * forward.z};
        }
    }
    const float shortest = bounds.wavelength > 0 ? float(bounds.wavelength) / kCellsPerWave : kLargestCell;
    grid.cell = powerOfTwoBelow(std::clamp(std::max(cell, 0.5f * shortest), kLeastCell, kLargestCell));
}

// How far from the middle there is water.
float farthestWater(const BodyParams& body, Vec2 middle) {
    const float x = std::max(std::abs(body.areaMin.x - middle.x), std::abs(body.areaMax.x - middle.x));
    const float z = std::max(std::abs(body.areaMin.y - middle.y), std::abs(body.areaMax.y - middle.y));
    return std::max(x, z);
}

}  // namespace

void layOutGrid(const light::View& view, const Body& body, SurfaceGrid& grid) {
    grid.blocks.clear();
    chooseScale(view, body, grid);
    const Mat4 clipFromWorld = view.clipFromWorld();
    const float height = body.waves ? float(body.waves->bounds().height) : 0.0f;
    const float low = body.params.level - height - 1e-3f, high = body.params.level + height + 1e-3f;
    const float reach = std::min(farthestWater(body.params, grid.middle),
                                 std::max(kFarthest, 400 * std::abs(view.eye.y - body.params.level)));
    Square inner{};  // what the finer levels cover
    float cell = grid.cell;
    for (int level = 0; level < kMostLevels; ++level, cell *= 2) {
        const float snap = kSnapCells * cell, block = SHOAL_GRID_CELLS * cell;
        const Vec2 corner{std::round(grid.middle.x / snap) * snap - 0.5f * kBlocks * block,
                          std::round(grid.middle.y / snap) * snap - 0.5f * kBlocks * block};
        const bool last = level == kMostLevels - 1 || SHOAL_GRID_FADE_TO * cell >= reach;
        for (int j = 0; j < kBlocks; ++j)
            for (int i = 0; i < kBlocks; ++i) {
                const Vec2 lo{corner.x + float(i) * block, corner.y + float(j) * block};
                const Square own{lo, {lo.x + block, lo.y + block}};
                const bool covered = level > 0 && own.lo.x >= inner.lo.x && own.hi.x <= inner.hi.x &&
                                     own.lo.y >= inner.lo.y && own.hi.y <= inner.hi.y;
                const int rim =
                    last ? (i == 0 ? 1 : 0) + (i == kBlocks - 1 ? 2 : 0) + (j == 0 ? 4 : 0) + (j == kBlocks - 1 ? 8 : 0)
                         : 0;
                if (covered || (rim == 0 && (!overlaps(own, body.params) || !seen(clipFromWorld, own, low, high))))
                    continue;
                grid.blocks.push_back({{lo.x / cell, lo.y / cell, cell, float(rim)}});
            }
        inner = {corner, {corner.x + kBlocks * block, corner.y + kBlocks * block}};
        if (last) break;
    }
}

}  // namespace shoal::water
