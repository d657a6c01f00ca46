// Every golden is one test. See support/golden.h for the variables that update and measure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "golden/entries.h"
#include "golden/models.h"
#include "support/golden.h"

namespace shoal::test {

void PrintTo(const Entry& entry, std::ostream* out) { *out << entry.name; }

namespace {

GoldenSetup setup() {
    GoldenSetup s;
    s.tool = SHOAL_TOOL;
    s.sources = std::filesystem::path(SHOAL_SOURCE_DIR) / "tests" / "golden";
    s.work = std::filesystem::path(SHOAL_BUILD_DIR) / "golden_work";
    s.report = std::filesystem::path(SHOAL_BUILD_DIR) / "golden_report";
    s.makeFile = [](const std::filesystem::path& folder, const std::string& name) {
        const auto names = modelNames();
        if (std::find(names.begin(), names.end(), name) == names.end()) return false;
        writeModel(folder, name);
        return true;
    };
    return s;
}

class Golden : public testing::TestWithParam<Entry> {};

TEST_P(Golden, IsTheReference) {
    if (std::getenv("SHOAL_MEASURE_GOLDENS")) {
        std::printf("%s\n", measureGolden(GetParam(), setup()).c_str());
        return;
    }
    const std::string findings = runGolden(GetParam(), setup());
    if (!findings.empty()) ADD_FAILURE() << findings << "pictures: " << (setup().report / "index.html").string();
}

INSTANTIATE_TEST_SUITE_P(All, Golden, testing::ValuesIn(entries()),
                         [](const testing::TestParamInfo<Entry>& info) { return info.param.name; });

TEST(GoldenTable, HasEachNameOnceAndNoReferenceWithoutEntry) {
    std::vector<std::string> names;
    for (const Entry& entry : entries()) names.push_back(entry.name + entry.extension);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
    std::uintmax_t bytes = 0;
    for (const auto& file : std::filesystem::directory_iterator(setup().sources / "reference")) {
        EXPECT_TRUE(std::binary_search(names.begin(), names.end(), file.path().filename().string())) << file.path();
        bytes += file.file_size();
    }
    EXPECT_LE(bytes, 4u << 20) << "all references together";
}

}  // namespace
}  // namespace shoal::test
