// shoal bench: picks rows, runs them, prints and saves them.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <shoal/core/params.h>
#include <shoal/gl/device.h>
#include <shoal/io/file.h>
#include <shoal/water/paper.h>
#include <shoal_build_info.h>

#include "bench/harness.h"
#include "verbs.h"

namespace shoal::bench {

const std::vector<Benchmark>& benchmarks() {
    static const std::vector<Benchmark> all = [] {
        std::vector<Benchmark> every;
        for (const auto& some :
             {frameBenchmarks(), waterTruthBenchmarks(), waterShaftBenchmarks(), waterSceneBenchmarks(),
              waterSpeedBenchmarks(), waterFrameBenchmarks(), viewBenchmarks()})
            every.insert(every.end(), some.begin(), some.end());
        return every;
    }();
    return all;
}

namespace {

// A name picks rows whose id it is, or begins with before a dot: "frame", "frame.startup_ms".
Result<std::vector<Benchmark>> picked(const std::vector<std::string>& names) {
    if (names.empty()) return benchmarks();
    std::vector<Benchmark> chosen;
    for (const std::string& name : names) {
        std::vector<std::string> known;
        bool found = false;
        for (const Benchmark& benchmark : benchmarks()) {
            const std::string id = benchmark.id;
            known.push_back(id);
            known.push_back(id.substr(0, id.find('.')));
            if (id != name && id.rfind(name + ".", 0) != 0) continue;
            chosen.push_back(benchmark);
            found = true;
        }
        if (!found) return usageError(unknownWord("benchmark", name, known));
    }
    return chosen;
}

// --config keeps one row of those picked: that of a configuration of the paper, "paper-a" is water.paper_a.
Result<std::vector<Benchmark>> withConfig(std::vector<Benchmark> chosen, const std::string& config) {
    if (config.empty()) return chosen;
    std::vector<std::string> known;
    for (const water::PaperConfig& paper : water::paperConfigs()) known.push_back(paper.name);
    if (!water::findPaperConfig(config)) return usageError("--config: " + unknownWord("configuration", config, known));
    std::string id = "water." + config;
    std::replace(id.begin(), id.end(), '-', '_');
    std::erase_if(chosen, [&](const Benchmark& benchmark) { return benchmark.id != id; });
    if (chosen.empty()) return usageError("--config " + config + " goes with the rows of water");
    return chosen;
}

std::string quoted(const std::string& text) {
    std::string json = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            json += '\\', json += c;
        else if (static_cast<unsigned char>(c) < 0x20)
            json += ' ';
        else
            json += c;
    }
    return json + "\"";
}

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string jsonOf(const std::vector<Row>& rows) {
    std::string json = "[\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& r = rows[i];
        json += "  {\"id\": " + quoted(r.id) + ", \"value\": " + number(r.value) + ", \"unit\": " + quoted(r.unit) +
                ", \"baseline\": " + (r.baseline > 0 ? number(r.baseline) : "null") +
                ", \"ratio\": " + (r.ratio > 0 ? number(r.ratio) : "null") + ", \"peer\": " + quoted(r.peer) +
                ", \"renderer\": " + quoted(r.renderer) + ", \"method\": " + quoted(r.method) +
                ", \"commit\": " + quoted(SHOAL_COMMIT) + "}" + (i + 1 < rows.size() ? "," : "") + "\n";
    }
    return json + "]\n";
}

void print(const Row& row) {
    std::printf("%-28s %10s %-5s", row.id.c_str(), number(row.value).c_str(), row.unit.c_str());
    if (row.ratio > 0)
        std::printf("  %.2fx faster than %s (%s %s)", row.ratio, row.peer.c_str(), number(row.baseline).c_str(),
                    row.unit.c_str());
    std::printf("  [%s]\n", row.method.c_str());
    std::fflush(stdout);
}

Result<Settings> settingsOf(const app::BenchOptions& o) {
    Settings s;
    s.peers = o.peers;
    s.repetitions = o.repetitions;
    s.device = o.device;
    const char* fromEnvironment = std::getenv("SHOAL_DATA");
    s.dataDir = !o.dataDir.empty() ? o.dataDir : fromEnvironment ? fromEnvironment : "../shared/data";
    if (!std::filesystem::is_directory(s.dataDir)) {
        if (!o.dataDir.empty()) return usageError("--data: " + o.dataDir + " is not a folder");
        s.dataDir.clear();
    }
    s.tool = std::filesystem::read_symlink("/proc/self/exe").string();
    gl::DeviceOptions deviceOptions;
    deviceOptions.device = o.device;
    SHOAL_TRY_ASSIGN(const auto device, app::openDevice(deviceOptions));
    s.renderer = device->info().renderer;
    std::string pattern = (std::filesystem::temp_directory_path() / "shoal_bench_XXXXXX").string();
    if (!::mkdtemp(pattern.data())) return badInput(pattern + ": cannot make a scratch folder");
    s.scratchDir = pattern;
    return s;
}

Result<void> run(const app::BenchOptions& o) {
    SHOAL_TRY_ASSIGN(std::vector<Benchmark> wanted, picked(o.names));
    SHOAL_TRY_ASSIGN(const std::vector<Benchmark> chosen, withConfig(std::move(wanted), o.config));
    if (o.list) {
        for (const Benchmark& benchmark : chosen) std::printf("%-28s %s\n", benchmark.id, benchmark.sentence);
        return {};
    }
    SHOAL_TRY(measureStartupIfAsked(o.device));
    SHOAL_TRY_ASSIGN(const Settings settings, settingsOf(o));
    std::printf("renderer: %s\n", settings.renderer.c_str());
    if (settings.repetitions < 7)
        std::printf("%d repetitions: not to be quoted, a figure needs 7\n", settings.repetitions);
    std::vector<Row> rows;
    Result<void> done;
    for (const Benchmark& benchmark : chosen) {
        auto made = benchmark.run(settings);
        if (!made) {
            done = Error{made.error().kind, std::string(benchmark.id) + ": " + made.error().message};
            break;
        }
        for (Row& row : *made) {
            row.renderer = settings.renderer;
            print(row);
            rows.push_back(row);
        }
    }
    std::error_code ignored;
    std::filesystem::remove_all(settings.scratchDir, ignored);
    SHOAL_TRY(done);
    if (!o.jsonFile.empty()) SHOAL_TRY(io::writeFileAtomically(o.jsonFile, jsonOf(rows)));
    return {};
}

}  // namespace

}  // namespace shoal::bench

namespace shoal::app {

int bench(const BenchOptions& options) {
    const Result<void> done = shoal::bench::run(options);
    return done ? kDone : report(done.error());
}

}  // namespace shoal::app
