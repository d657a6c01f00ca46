// What every refusal of the tool must look like.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/test_folder.h"

namespace shoal::test {

inline void writeText(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

// Every file under `folder` with its content, to see that nothing changed.
inline std::vector<std::pair<std::string, std::string>> contentOf(const std::filesystem::path& folder) {
    std::vector<std::pair<std::string, std::string>> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        files.emplace_back(entry.path().string(), entry.is_regular_file() ? readText(entry.path()) : "");
    std::sort(files.begin(), files.end());
    return files;
}

// Exactly one line on stderr that says "shoal: ...", nothing on stdout, the exit code, and each of `mentions` in the
// line.
inline void expectRefusal(const ProgramRun& run, int exitCode, const std::vector<std::string>& mentions) {
    EXPECT_EQ(run.exitCode, exitCode) << run.describe();
    EXPECT_EQ(lineCount(run.err), 1u) << run.describe();
    EXPECT_EQ(run.err.rfind("shoal: ", 0), 0u) << run.describe();
    EXPECT_EQ(run.out, "") << run.describe();
    for (const std::string& mention : mentions)
        EXPECT_NE(run.err.find(mention), std::string::npos) << "expected a word of \"" << mention << "\"\n"
                                                            << run.describe();
}

}  // namespace shoal::test
