// Where shadow maps look: cascades of the sun, and spots. No GL.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <shoal/core/math.h>
#include <shoal/light/lights.h>
#include <shoal/light/view.h>

namespace shoal::frame {

inline constexpr int kMaxCascades = 4;

// Up to the next step of a quarter octave: sizes that follow the scene or the view change seldom, and then little. At
// least a millimetre.
double roundedUp(double size);

struct CascadeFitSetup {
    int resolution = 2048;     // texels a side
    int cascadeCount = 4;      // 1..kMaxCascades
    float sunDistance = 150;   // metres from the eye
    float splitBlend = 0.75f;  // 0 even, 1 logarithmic
};

struct Cascade {
    light::View view;      // orthographic, looks along the sun's rays
    Vec2 center;           // in the sun's lateral axes, metres
    float halfExtent = 0;  // metres from the centre to each side of the map
    float metresPerTexel = 0;
    float endDepth = 0;   // view depth up to which it is used
    float fadeDepth = 0;  // view depth where it begins to turn into the next one
};

struct CascadeFit {
    Mat4 sunFromWorld;      // lateral x, y in metres, z in [0, 1] with 1 nearest to the sun
    float depthRangeM = 1;  // metres between z = 0 and z = 1
    int count = 0;
    std::array<Cascade, kMaxCascades> cascades;
};

// Cascades for what `view` sees of a scene inside `bounds` (not empty). Each one holds the bounding sphere of its slice
// of the view, so that its size does not change when the eye turns; it moves in steps of a sixteenth of its width,
// which are whole texels, so that a static scene's shadows do not crawl and a cascade often need not be drawn again.
// Where one map of the whole scene does nearly as well as a cascade, it takes the place of that cascade and all after
// it.
CascadeFit fitCascades(const light::View& view, Vec3 toSun, const Bounds& bounds, const CascadeFitSetup& setup);

// What a spot sees: reversed z, as wide as its cone.
light::View spotView(const light::PunctualLight& light, int resolution);

}  // namespace shoal::frame
