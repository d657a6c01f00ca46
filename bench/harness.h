// What every benchmark needs: rows, medians, child processes, interleaved repetitions.
// Rows are medians of at least 7 repetitions after a warm-up, in turns with the peer on the same input.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <shoal/core/result.h>

namespace shoal::bench {

// One printed number. ratio: baseline's time over ours, higher is better; 0 where there is no baseline.
struct Row {
    std::string id;  // stable: "frame.startup_ms"
    double value = 0;
    std::string unit;
    double baseline = 0, ratio = 0;
    std::string peer;      // what the baseline is
    std::string renderer;  // GL_RENDERER
    std::string method;    // how it was measured, with the spread
};

// A row without a baseline.
inline Row rowOf(const char* id, double value, const char* unit, std::string method) {
    return Row{.id = id, .value = value, .unit = unit, .peer = {}, .renderer = {}, .method = std::move(method)};
}

struct Settings {
    bool peers = false;
    int repetitions = 7;
    std::string device = "auto";
    std::string dataDir;     // "" where there is none
    std::string tool;        // this very binary
    std::string scratchDir;  // an empty folder, removed afterwards
    std::string renderer;
};

struct Benchmark {
    const char* id;
    const char* sentence;                                          // what it measures
    std::function<Result<std::vector<Row>>(const Settings&)> run;  // an empty list: skipped, with a line printed by it
};
const std::vector<Benchmark>& benchmarks();
std::vector<Benchmark> frameBenchmarks();
std::vector<Benchmark> waterSpeedBenchmarks();
std::vector<Benchmark> waterErrorBenchmarks(), waterPaperBenchmarks();  // in waterSpeedBenchmarks
std::vector<Benchmark> waterTruthBenchmarks();
std::vector<Benchmark> waterShaftBenchmarks();
std::vector<Benchmark> waterSceneBenchmarks();
std::vector<Benchmark> waterFrameBenchmarks();
std::vector<Benchmark> viewBenchmarks();

// In the processes that frame.startup_ms starts: times the start, prints it and ends the process; elsewhere does
// nothing. Comes before anything else opens a device.
Result<void> measureStartupIfAsked(const std::string& device);

struct Spread {
    double median = 0, lowest = 0, highest = 0;
    std::string describe(const char* unit) const;  // "median of 7, 101.2 .. 109.8 ms"
    int count = 0;
};
Spread spreadOf(std::vector<double> values);

struct Ran {
    int exitCode = -1;   // of the child; -1 when it could not be started
    double seconds = 0;  // wall clock from start to end
    double peakMib = 0;  // largest resident set
    std::string output;  // its stdout
};
// Runs a program with arguments; `environment` is added to ours. Its stderr goes to ours unless `quiet`.
Ran runProgram(const std::vector<std::string>& words, const std::map<std::string, std::string>& environment = {},
               bool quiet = true);
// Whether a program of this name is in PATH.
bool haveProgram(const std::string& name);

// The model file below the data folder, or "" with a printed line when it is not there.
std::string dataFile(const Settings& settings, const char* row, const std::string& relative);

void note(const char* format, ...) __attribute__((format(printf, 1, 2)));

// Seconds of wall clock that `work` takes.
double timed(const std::function<void()>& work);

}  // namespace shoal::bench
