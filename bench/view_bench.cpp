// The rows of the viewer: its window on a virtual screen, driven by its own scripts (docs/viewer.md).
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include <shoal/io/file.h>

#include "bench/harness.h"

namespace shoal::bench {

namespace {

constexpr const char* kTown = "scenes/town_street.glb";

// One window, `repetitions` times: an orbit of 60 turns by the mouse, then rest until the picture is complete, then one
// move of the mouse from rest.
std::string scriptOf(int repetitions) {
    std::string script = "realtime\nwait full\ndrag left 400 340 440 350 20\nwait full\n";
    for (int i = 0; i < repetitions; ++i) {
        script +=
            "times on\ndrag left " + std::string(i % 2 ? "600 360 300 340" : "300 340 600 360") + " 60\ntimes off\n";
        script += "mark rest\nwait full\nmark full\nwait 3\nlatency 30 5\nwait full\n";
    }
    return script + "quit\n";
}

struct Measured {
    std::vector<double> turnMs, settleS, latencyTurns, scales;  // turnMs: median of each orbit
};

Measured parse(const std::string& output) {
    Measured m;
    std::istringstream lines(output);
    std::vector<double> turns;
    double rest = 0;
    for (std::string line; std::getline(lines, line);) {
        double a = 0, b = 0;
        if (std::sscanf(line.c_str(), "turn %lf %lf", &a, &b) == 2) {
            turns.push_back(a);
            m.scales.push_back(b);
        } else if (std::sscanf(line.c_str(), "mark rest %lf", &a) == 1) {
            rest = a;
            if (!turns.empty()) m.turnMs.push_back(spreadOf(turns).median);
            turns.clear();
        } else if (std::sscanf(line.c_str(), "mark full %lf", &a) == 1) {
            m.settleS.push_back((a - rest) / 1000);
        } else if (std::sscanf(line.c_str(), "latency: frames=%lf", &a) == 1) {
            m.latencyTurns.push_back(a);
        }
    }
    return m;
}

Result<std::vector<Row>> measure(const Settings& settings, const char* id) {
    const std::string file = dataFile(settings, id, kTown);
    if (file.empty()) return std::vector<Row>{};
    if (!haveProgram("xvfb-run")) {
        note("  %s: skipped, xvfb-run is not installed (scripts/setup bench)", id);
        return std::vector<Row>{};
    }
    const std::string script = settings.scratchDir + "/view.txt";
    SHOAL_TRY(io::writeFileAtomically(script, std::string_view(scriptOf(settings.repetitions))));
    const Ran ran = runProgram({"xvfb-run", "-a", "-s", "-screen 0 1280x720x24", settings.tool, "view", file, "--size",
                                "1280x720", "--script", script},
                               {{"XDG_STATE_HOME", settings.scratchDir}});
    if (ran.exitCode != 0) return internalError("shoal view failed");
    const Measured m = parse(ran.output);
    if (m.turnMs.empty() || m.settleS.empty() || m.latencyTurns.empty())
        return internalError("shoal view printed no times");
    const std::string name = id;
    Row row{.id = id, .value = 0, .unit = {}, .peer = {}, .renderer = {}, .method = {}};
    if (name == "view.interact_fps") {
        std::vector<double> fps;
        for (const double ms : m.turnMs) fps.push_back(1000 / ms);
        const Spread spread = spreadOf(fps);
        char text[120];
        std::snprintf(text, sizeof text, "; orbit by the mouse, town_street, 1280x720 window, %.0f %% resolution",
                      100 * spreadOf(m.scales).median);
        row.value = spread.median, row.unit = "1/s", row.method = spread.describe("1/s") + text;
    } else if (name == "view.settle_s") {
        const Spread spread = spreadOf(m.settleS);
        row.value = spread.median, row.unit = "s";
        row.method = spread.describe("s") + "; the mouse let go to the complete picture, town_street, 1280x720 window";
    } else {
        const Spread spread = spreadOf(m.latencyTurns);
        row.value = spread.highest, row.unit = "";
        row.method = "largest of " + std::to_string(spread.count) +
                     "; frames drawn from the one that takes the mouse's move to the one whose picture shows it";
    }
    return std::vector<Row>{row};
}

}  // namespace

std::vector<Benchmark> viewBenchmarks() {
    return {
        {"view.interact_fps", "frames a second of the viewer while the mouse turns the view",
         [](const Settings& s) { return measure(s, "view.interact_fps"); }},
        {"view.settle_s", "from the mouse let go to the picture in full quality",
         [](const Settings& s) { return measure(s, "view.settle_s"); }},
        {"view.input_latency_frames", "frames until a move of the mouse is seen",
         [](const Settings& s) { return measure(s, "view.input_latency_frames"); }},
    };
}

}  // namespace shoal::bench
