// Where the statements of a TOML text stand, so that one value can be changed and all else left as it was written.
// Reads valid TOML only (parseTree comes first); what it does not understand it does not list.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::scene {

// `key = value`, offsets into the text. [begin, end) are whole lines.
struct Statement {
    std::string path;  // "camera.fovDeg", "model[0].file"
    std::size_t begin = 0, end = 0, valueBegin = 0, valueEnd = 0;
};

class Statements {
public:
    static Statements of(std::string_view text);
    const Statement* find(std::string_view path) const;
    // Where a further statement of table `path` ("" the root) goes; nothing where it has no header.
    std::optional<std::size_t> endOfTable(const std::string& path) const;

private:
    std::vector<Statement> statements_;
    std::map<std::string, std::size_t> tableEnds_;
};

}  // namespace shoal::scene
