// The configurations of [Papadopoulos & Papaioannou 2010] section 4.2.
#include <shoal/water/paper.h>

namespace shoal::water {
namespace {

PaperParams grids(int caustics, int godrays) {
    PaperParams params;
    params.causticGrid = caustics;
    params.godrayGrid = godrays;
    return params;
}

PaperParams largeGodrayBuffer() {
    PaperParams params = grids(400, 200);
    params.godrayScale = 460.0f / 1440.0f;
    params.lineWidthPx = 12;
    params.smallestPointPx = 2;
    params.largestPointPx = 10;
    return params;
}

}  // namespace

std::span<const PaperConfig> paperConfigs() {
    static const PaperConfig configs[] = {
        {"paper-a", 800, 800, grids(200, 100), "exceeds 110", "caustic buffer 512x512, god ray buffer 128x128"},
        {"paper-b", 1440, 850, grids(200, 100), "exceeds 60", "buffers at the same part of the window"},
        {"paper-c", 1440, 850, grids(500, 300), "20 to 30", "the paper prints no window; 1440x850 taken"},
        {"paper-d", 1440, 850, largeGodrayBuffer(), "20", "god ray buffer 460x272, lines 12 px, points 2 to 10 px"},
    };
    return configs;
}

const PaperConfig* findPaperConfig(std::string_view name) {
    for (const PaperConfig& config : paperConfigs())
        if (name == config.name) return &config;
    return nullptr;
}

PointSizes pointSizes(const PaperParams& params, float nearZ, float farZ) {
    const float spread = params.largestPointPx - params.smallestPointPx;
    return {params.largestPointPx - farZ * spread / (farZ - nearZ), nearZ * farZ * spread / (farZ - nearZ)};
}

}  // namespace shoal::water
