// golden_report/index.html: reference, picture and difference of every golden that failed, with the numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shoal::test {

struct ReportRow {
    std::string what;
    std::optional<double> rmse;
    double limit = 0;
    bool ok = false;
    std::string expected;  // "at most the limit", "above"
};

struct ReportPage {
    std::string name, layer, reason, commands, findings;
    std::filesystem::path reference, got, difference;
    std::vector<ReportRow> rows;
};

// Adds the page, or takes it away where `findings` is empty, and writes the index anew. Tests may do so at the same
// time.
void writeReport(const std::filesystem::path& folder, const ReportPage& page);

}  // namespace shoal::test
