#include "scene/statements.h"

namespace shoal::scene {

namespace {

// Past a quoted text that begins at `at`; three quotes in a row begin one over several lines.
std::size_t pastText(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const bool isLong = text.substr(at, 3) == std::string(3, quote);
    const std::string close(isLong ? 3 : 1, quote);
    for (std::size_t i = at + close.size(); i < text.size(); ++i) {
        if (quote == '"' && text[i] == '\\') {
            ++i;
            continue;
        }
        if (text.substr(i, close.size()) == close) return i + close.size();
    }
    return text.size();
}

std::size_t endOfLine(std::string_view text, std::size_t at) {
    const std::size_t end = text.find('\n', at);
    return end == std::string_view::npos ? text.size() : end;
}

// Past the value that begins at `at`: to the end of its line or its comment, brackets closed.
std::size_t pastValue(std::string_view text, std::size_t at) {
    int depth = 0;
    std::size_t last = at;
    for (std::size_t i = at; i < text.size();) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            last = i = pastText(text, i);
            continue;
        }
        if (c == '#') {
            if (depth == 0) break;
            i = endOfLine(text, i);
            continue;
        }
        if (c == '\n' && depth == 0) break;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        ++i;
        if (c != ' ' && c != '\t' && c != '\r' && c != '\n') last = i;
    }
    return last;
}

// "a . b" or a."b c" as "a.b" and "a.b c"; nothing where a part has a dot or bracket of its own.
std::optional<std::string> plainKey(std::string_view words) {
    std::string key;
    for (std::size_t i = 0; i < words.size();) {
        const char c = words[i];
        if (c == ' ' || c == '\t') {
            ++i;
        } else if (c == '"' || c == '\'') {
            const std::size_t end = pastText(words, i);
            const std::string_view part = words.substr(i + 1, end - i - 2);
            if (part.find_first_of(".[]\\") != std::string_view::npos) return {};
            key += part;
            i = end;
        } else {
            key += c;
            ++i;
        }
    }
    return key;
}

}  // namespace

Statements Statements::of(std::string_view text) {
    Statements found;
    std::map<std::string, int> counts;  // of [[headers]]
    std::string table;
    bool known = true;
    found.tableEnds_[""] = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t first = text.find_first_not_of(" \t\r", at);
        if (first == std::string_view::npos) break;
        const std::size_t lineEnd = endOfLine(text, first);
        if (text[first] == '\n' || text[first] == '#') {
            at = lineEnd + 1;
            continue;
        }
        if (text[first] == '[') {
            const bool isArray = text.substr(first, 2) == "[[";
            const std::size_t begin = first + (isArray ? 2 : 1);
            const std::size_t close = text.find(']', begin);
            const auto key = plainKey(text.substr(begin, close - begin));
            known = key.has_value();
            table = key.value_or("");
            // [model.copies] belongs to the last [[model]].
            const std::size_t dot = table.find('.');
            const std::string root = table.substr(0, dot);
            if (dot != std::string::npos && counts.contains(root))
                table = root + "[" + std::to_string(counts[root] - 1) + "]" + table.substr(dot);
            if (isArray) table += "[" + std::to_string(counts[table]++) + "]";
            if (known) found.tableEnds_[table] = std::min(lineEnd + 1, text.size());
            at = lineEnd + 1;
            continue;
        }
        std::size_t equals = first;
        while (equals < lineEnd && text[equals] != '=')
            equals = text[equals] == '"' || text[equals] == '\'' ? pastText(text, equals) : equals + 1;
        if (equals >= lineEnd) break;
        const auto key = plainKey(text.substr(first, equals - first));
        Statement statement;
        statement.begin = at;
        statement.valueBegin = std::min(text.find_first_not_of(" \t", equals + 1), text.size());
        statement.valueEnd = pastValue(text, statement.valueBegin);
        statement.end = std::min(endOfLine(text, statement.valueEnd) + 1, text.size());
        if (known && key) {
            statement.path = table.empty() ? *key : table + "." + *key;
            found.tableEnds_[table] = statement.end;
            found.statements_.push_back(statement);
        }
        at = statement.end;
    }
    return found;
}

const Statement* Statements::find(std::string_view path) const {
    for (const Statement& statement : statements_)
        if (statement.path == path) return &statement;
    return nullptr;
}

std::optional<std::size_t> Statements::endOfTable(const std::string& path) const {
    const auto found = tableEnds_.find(path);
    if (found == tableEnds_.end()) return {};
    return found->second;
}

}  // namespace shoal::scene
