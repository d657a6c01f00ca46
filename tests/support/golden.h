// Pictures against stored references, drawn and judged by the tool itself: `shoal render`, then `shoal compare
// --max-rmse`. Every entry has negative controls: a named wrong change (effect off, sign flipped, half strength) must
// fail it.
//   SHOAL_UPDATE_GOLDENS=1   writes the references instead of comparing with them (the controls run all the same)
//   SHOAL_MEASURE_GOLDENS=1  prints how far the same picture spreads over the renderer's own variations
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace shoal::test {

// A control is compared at so many times the limit, and must fail even there.
inline constexpr double kControlMargin = 5;
// A limit is at least so many times the measured spread.
inline constexpr double kSpreadMargin = 4;

struct Control {
    std::string name;                 // what is wrong: "no shadow"
    std::vector<std::string> change;  // words added to the command: {"--set", "shadows.softness=0"}
};

struct Entry {
    std::string name;
    std::string scene;                    // in tests/golden/scenes, or with a slash: from the repository's root
    std::vector<std::string> words = {};  // further words of the command
    std::string layer = {};               // AOV that is compared; empty: the picture
    std::string extension = ".exr";       // ".png" compares display values
    int lastFrame = -1;                   // of a sequence (--frames): the frame that is compared
    // Root mean square difference of linear radiance (.exr), 0..1 display values (.png), or the layer's own unit.
    double limit = 0;
    double spread = 0;        // largest difference measured by scripts/golden_spread
    std::string reason = {};  // why the limit is what it is, where it is not the rule of entries.cpp
    std::vector<Control> controls = {};
};

// What an entry needs from outside, and where its files are.
struct GoldenSetup {
    std::string tool;               // the binary
    std::filesystem::path sources;  // tests/golden
    std::filesystem::path work;     // made anew for each entry: scenes, models, pictures
    std::filesystem::path report;   // a page of what failed: index.html
    // Makes a file that a scene names into a folder; false where it makes no such file.
    std::function<bool(const std::filesystem::path& folder, const std::string& file)> makeFile;
};

// Runs one entry with all its controls; empty when it passes, else what is wrong, one finding a line.
std::string runGolden(const Entry& entry, const GoldenSetup& setup);
// One line: entry, spread over llvmpipe's vector widths and threads and our own threads, limit, nearest control.
std::string measureGolden(const Entry& entry, const GoldenSetup& setup);

}  // namespace shoal::test
