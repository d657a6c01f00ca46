// Runs a program, the tool most of all, and keeps what it said.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace shoal::test {

struct ProgramRun {
    int exitCode = -1;     // -1: it did not end by itself (`problem` says why)
    std::string out, err;  // what it wrote to stdout and stderr
    std::string command;   // as one would type it
    std::string problem;   // "killed by signal 11", "longer than 60 s", ...
    double seconds = 0;
    // For the message of a failed check.
    std::string describe() const;
};

struct RunOptions {
    std::filesystem::path folder;                                  // it runs there; empty: here
    std::vector<std::pair<std::string, std::string>> environment;  // besides our own
    double limitS = 100;                                           // killed after so long
};

// words[0] is looked up in PATH where it has no slash. Nothing is asked of a shell.
ProgramRun runProgram(const std::vector<std::string>& words, const RunOptions& options = {});

#ifdef SHOAL_TOOL
// `shoal WORDS...`
inline ProgramRun runTool(std::vector<std::string> words, const RunOptions& options = {}) {
    words.insert(words.begin(), SHOAL_TOOL);
    return runProgram(words, options);
}
#endif

// How many lines a text has; a last one without "\n" counts.
std::size_t lineCount(const std::string& text);
// Whole file as text; "" where there is none.
std::string readText(const std::filesystem::path& file);

}  // namespace shoal::test
