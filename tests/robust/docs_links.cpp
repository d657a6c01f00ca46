// Links of the documentation lead to files that are there.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace shoal::test {
namespace {

namespace fs = std::filesystem;

TEST(DocsLinks, LeadToFiles) {
    const fs::path root = SHOAL_SOURCE_DIR;
    std::vector<fs::path> pages = {root / "README.md", root / "CHANGELOG.md"};
    for (const char* folder : {"docs", "scenes"})
        for (const auto& entry : fs::recursive_directory_iterator(root / folder))
            if (entry.path().extension() == ".md") pages.push_back(entry.path());
    const std::regex link(R"(\]\(([^)#\s]+)[^)]*\))");
    std::size_t count = 0;
    for (const fs::path& page : pages) {
        const std::string text = readText(page);
        for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i) {
            const std::string target = (*i)[1];
            if (target.find("://") != std::string::npos) continue;
            EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << " links to " << target;
            ++count;
        }
    }
    EXPECT_GT(count, 5u);
}

}  // namespace
}  // namespace shoal::test
