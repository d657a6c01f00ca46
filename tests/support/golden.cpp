#include "support/golden.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <stdexcept>

#include <fmt/format.h>

#include "support/golden_report.h"
#include "support/run_program.h"

namespace shoal::test {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestReference = 200 * 1024;

struct Compared {
    bool passed = false;
    std::optional<double> rmse;  // nothing: the tool could not compare
    std::string said;
};

// One entry in its own folder.
class Golden {
public:
    Golden(const Entry& entry, const GoldenSetup& setup)
        : entry_(entry), setup_(setup), folder_(setup.work / entry.name) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        if (entry.scene.find('/') != std::string::npos) return;  // a shipped scene stays where it is
        const fs::path scene = setup.sources / "scenes" / entry.scene;
        fs::copy_file(scene, folder_ / entry.scene);
        std::string texts = readText(scene);
        for (const Control& control : entry.controls)
            for (const std::string& word : control.change) texts += "\n\"" + word.substr(word.find('=') + 1) + "\"";
        for (const std::string& word : entry.words) texts += "\n\"" + word.substr(word.find('=') + 1) + "\"";
        const std::regex fileName("\"([\\w.-]+\\.(glb|exr|csv))\"");
        for (std::sregex_iterator at(texts.begin(), texts.end(), fileName), end; at != end; ++at)
            if (!setup.makeFile(folder_, (*at)[1]))
                throw std::runtime_error(entry.name + ": nothing makes " + at->str());
    }

    fs::path reference() const { return setup_.sources / "reference" / (entry_.name + entry_.extension); }
    const fs::path& folder() const { return folder_; }

    // Draws into the folder; throws with what the tool said when it fails.
    fs::path render(const std::string& name, const std::vector<std::string>& change,
                    const std::vector<std::pair<std::string, std::string>>& environment = {}) {
        const bool shipped = entry_.scene.find('/') != std::string::npos;
        const fs::path scene =
            shipped ? setup_.sources.parent_path().parent_path() / entry_.scene : folder_ / entry_.scene;
        fs::path picture = folder_ / (name + entry_.extension);
        std::vector<std::string> words = {setup_.tool, "render", scene.string(), "-o", picture.string(), "--quiet"};
        words.insert(words.end(), entry_.words.begin(), entry_.words.end());
        if (!entry_.layer.empty()) words.insert(words.end(), {"--aov", entry_.layer});
        words.insert(words.end(), change.begin(), change.end());
        const ProgramRun run = runProgram(words, {.folder = {}, .environment = environment, .limitS = 100});
        commands += "$ " + run.command + "\n";
        if (run.exitCode != 0) throw std::runtime_error(run.describe());
        if (entry_.lastFrame >= 0)
            picture = folder_ / fmt::format("{}_{:04}{}", name, entry_.lastFrame, entry_.extension);
        return picture;
    }

    Compared compare(const fs::path& a, const fs::path& b, double limit, const fs::path& difference = {}) {
        std::vector<std::string> words = {setup_.tool, "compare",    a.string(),
                                          b.string(),  "--max-rmse", fmt::format("{:.9g}", limit)};
        if (!entry_.layer.empty()) words.insert(words.end(), {"--layer", entry_.layer});
        if (!difference.empty()) words.insert(words.end(), {"-o", difference.string(), "--gain", "8"});
        const ProgramRun run = runProgram(words);
        Compared compared{run.exitCode == 0, {}, run.describe()};
        if (run.exitCode <= 1 && run.out.rfind("rmse ", 0) == 0)
            compared.rmse = std::strtod(run.out.c_str() + 5, nullptr);
        if (!difference.empty()) commands += "$ " + run.command + "\n";
        return compared;
    }

    std::string commands;  // as one would type them

private:
    const Entry& entry_;
    const GoldenSetup& setup_;
    fs::path folder_;
};

bool asked(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value && std::string(value) != "0";
}

std::string judge(const Entry& entry, Golden& golden, ReportPage& page) {
    std::string findings;
    const auto finding = [&](const std::string& line) { findings += entry.name + ": " + line + "\n"; };
    const fs::path got = golden.render("got", {});
    const fs::path reference = golden.reference();
    if (asked("SHOAL_UPDATE_GOLDENS")) fs::copy_file(got, reference, fs::copy_options::overwrite_existing);
    if (!fs::exists(reference))
        return entry.name + ": no " + reference.string() +
               " (scripts/update_goldens makes it; look at it before it is kept)\n";
    if (const auto size = fs::file_size(reference); size > kLargestReference)
        finding(fmt::format("the reference has {} bytes, expected at most {}", size, kLargestReference));
    page.reference = reference, page.got = got, page.difference = golden.folder() / "difference.png";
    const Compared same = golden.compare(got, reference, entry.limit, page.difference);
    page.rows.push_back({"the picture", same.rmse, entry.limit, same.passed, "at most the limit"});
    if (!same.passed) finding("the picture is not the reference\n" + same.said);
    for (std::size_t i = 0; i < entry.controls.size(); ++i) {
        const Control& control = entry.controls[i];
        const fs::path wrong = golden.render(fmt::format("control_{}", i), control.change);
        const double limit = kControlMargin * entry.limit;
        const Compared compared = golden.compare(wrong, reference, limit);
        const bool failed = !compared.passed && compared.rmse.has_value();
        page.rows.push_back({"control: " + control.name, compared.rmse, limit, failed, "above"});
        if (!failed) finding("the negative control \"" + control.name + "\" passes\n" + compared.said);
        fs::remove(wrong);
    }
    return findings;
}

}  // namespace

std::string runGolden(const Entry& entry, const GoldenSetup& setup) {
    if (entry.controls.empty()) return entry.name + ": no negative control, expected at least one\n";
    if (!(entry.limit > 0) || entry.limit < kSpreadMargin * entry.spread)
        return fmt::format("{}: limit {}, expected at least {} times the spread {}\n", entry.name, entry.limit,
                           kSpreadMargin, entry.spread);
    ReportPage page;
    page.name = entry.name, page.layer = entry.layer, page.reason = entry.reason;
    std::string findings;
    try {
        Golden golden(entry, setup);
        try {
            findings = judge(entry, golden, page);
        } catch (const std::exception& e) {
            findings = entry.name + ": " + e.what() + "\n";
        }
        page.commands = golden.commands;
        page.findings = findings;
    } catch (const std::exception& e) {
        page.findings = findings = entry.name + ": " + e.what() + "\n";
    }
    writeReport(setup.report, page);  // also takes the page of a golden that passes again away
    return findings;
}

std::string measureGolden(const Entry& entry, const GoldenSetup& setup) {
    Golden golden(entry, setup);
    const fs::path base = golden.render("base", {});
    struct Variation {
        std::string name;
        std::vector<std::string> change;
        std::vector<std::pair<std::string, std::string>> environment;
    };
    // Mesa 22.3 keeps compiled shaders without noting the width of vectors they were compiled for, and crashes on those
    // of another: each width has a cache of its own.
    const auto cache = [&](const char* width) { return (setup.work / ("mesa_cache_" + std::string(width))).string(); };
    const Variation variations[] = {
        {"vectors of 128 bits", {}, {{"LP_NATIVE_VECTOR_WIDTH", "128"}, {"MESA_SHADER_CACHE_DIR", cache("128")}}},
        {"vectors of 256 bits", {}, {{"LP_NATIVE_VECTOR_WIDTH", "256"}, {"MESA_SHADER_CACHE_DIR", cache("256")}}},
        {"1 llvmpipe thread", {}, {{"LP_NUM_THREADS", "1"}}},
        {"2 llvmpipe threads", {}, {{"LP_NUM_THREADS", "2"}}},
        {"1 thread", {"--threads", "1"}, {}},
        {"2 threads", {"--threads", "2"}, {}}};
    double spread = 0;
    std::string widest = "none";
    const auto widen = [&](const std::string& name, const fs::path& picture) {
        const double rmse = golden.compare(picture, base, 0).rmse.value_or(1e30);
        if (rmse > spread) spread = rmse, widest = name;
    };
    for (const Variation& v : variations) widen(v.name, golden.render("variation", v.change, v.environment));
    // Other builds of the tool (another compiler, other optimisation) spread too.
    if (const char* others = std::getenv("SHOAL_GOLDEN_TOOLS")) {
        const std::string text = others;
        const std::regex word("[^ ]+");
        for (std::sregex_iterator at(text.begin(), text.end(), word), end; at != end; ++at) {
            GoldenSetup other = setup;
            other.tool = at->str();
            other.work = setup.work / "other";
            widen(at->str(), Golden(entry, other).render("variation", {}));
        }
    }
    std::string nearest = "none";
    double nearestRmse = 1e30;
    for (const Control& control : entry.controls)
        if (const double rmse = golden.compare(golden.render("control", control.change), base, 0).rmse.value_or(0);
            rmse < nearestRmse)
            nearestRmse = rmse, nearest = control.name;
    const bool fits = entry.limit >= kSpreadMargin * spread && nearestRmse > kControlMargin * entry.limit;
    return fmt::format("{:<22} spread {:.3e} ({}), limit {:.3e}, nearest control {:.3e} ({}){}", entry.name, spread,
                       widest, entry.limit, nearestRmse, nearest, fits ? "" : "  <-- limit does not fit");
}

}  // namespace shoal::test
