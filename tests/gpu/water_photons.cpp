// Photons among boxes: where the GPU says they end against rays through the same boxes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include <shoal/scene/content.h>
#include <shoal/scene/scene.h>

#include "support/gl_device.h"
#include "support/misplaced_photons.h"

namespace shoal::test {
namespace {

class WaterPhotonsTraced : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!HasFatalFailure()) gl::setKnownState();
    }
    double misplaced(float zenithDeg, bool drawn = true) {
        char toSun[80];
        std::snprintf(toSun, sizeof toSun, "[%.9g, %.9g, 0]", -std::sin(double(radians(zenithDeg))),
                      std::cos(double(radians(zenithDeg))));
        const scene::Override light{"sun.toSun", toSun};
        const auto scene =
            scene::loadScene(std::string(SHOAL_SOURCE_DIR) + "/tests/scenes/water_boxes.toml", std::span(&light, 1));
        if (!scene) throw std::runtime_error(scene.error().message);
        const auto content = scene::loadContent(*scene);
        if (!content) throw std::runtime_error(content.error().message);
        const auto share = misplacedPhotons(device(), *scene, *content, drawn);
        if (!share) throw std::runtime_error(share.error().message);
        return *share;
    }
};

TEST_F(WaterPhotonsTraced, FewEndInTheWrongPlace) {
    for (const float zenith : {0.0f, 20.0f, 40.0f}) {
        const double share = misplaced(zenith);
        RecordProperty("misplaced_" + std::to_string(int(zenith)), std::to_string(share));
        EXPECT_LT(share, 0.01) << zenith << " deg";
    }
}

// The control: light that is shown nothing of the scene ends in the wrong place.
TEST_F(WaterPhotonsTraced, LightThatSeesNothingEndsInTheWrongPlace) { EXPECT_GT(misplaced(20, false), 0.9); }

}  // namespace
}  // namespace shoal::test
