#include "gl/shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <span>

#include <shoal/gl/program.h>
#include <shoal/gl/shaders.h>

#include "gl/embedded_shader.h"

namespace shoal::gl {
namespace {

namespace fs = std::filesystem;

// Mesa forgets the file's number of whatever is more than one token (its YYLLOC_DEFAULT sets it to 0), so #line
// directives carry the file in the line number as well: file * kLinesPerFile + line.
constexpr std::size_t kLinesPerFile = 100000;

std::string lineDirective(std::size_t line, std::size_t file) {
    return fmt::format("#line {} {}\n", file * kLinesPerFile + line, file);
}

struct Registry {
    std::mutex mutex;
    std::vector<std::span<const EmbeddedShader>> tables;
};
Registry& registry() {
    static Registry r;
    return r;
}

std::optional<std::string> embeddedText(std::string_view name) {
    Registry& r = registry();
    const std::lock_guard lock(r.mutex);
    for (const auto& table : r.tables)
        for (const EmbeddedShader& shader : table)
            if (shader.path == name) return std::string(shader.text, shader.size);
    return std::nullopt;
}

std::optional<std::string> readText(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(in), {});
}

// The folder `shaders` may stand at any depth below the module: a/b/c is a/shaders/b/c or a/b/shaders/c.
std::optional<std::string> fileText(std::string_view name, const std::string& dir) {
    std::error_code error;
    for (std::size_t slash = name.find('/'); slash != name.npos; slash = name.find('/', slash + 1)) {
        const fs::path path = fs::path(dir) / name.substr(0, slash) / "shaders" / name.substr(slash + 1);
        if (fs::is_regular_file(path, error)) return readText(path);
    }
    return std::nullopt;
}

std::string_view trimLeft(std::string_view s) {
    const std::size_t at = s.find_first_not_of(" \t");
    return at == s.npos ? std::string_view{} : s.substr(at);
}

// The name in a line `#include "name"`; empty for other lines. <...> is C++'s and stays for the compiler to skip.
std::string_view includedName(std::string_view line) {
    line = trimLeft(line);
    if (line.empty() || line[0] != '#') return {};
    line = trimLeft(line.substr(1));
    if (!line.starts_with("include")) return {};
    line = trimLeft(line.substr(7));
    if (line.empty() || line[0] != '"') return {};
    const std::size_t end = line.find('"', 1);
    return end == line.npos ? std::string_view{} : line.substr(1, end - 1);
}

class Flattener {
public:
    explicit Flattener(const std::string& shaderDir) : shaderDir_(shaderDir) {}

    Result<void> add(const std::string& name, const std::string& text) {
        const std::size_t number = out.files.size();
        out.files.push_back(name);
        std::size_t lineNumber = 0;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            std::string_view line(text.data() + at, end - at);
            if (line.ends_with('\r')) line.remove_suffix(1);
            at = end + 1;
            ++lineNumber;
            const std::string included(includedName(line));
            if (included.empty())
                out.text.append(line);
            else if (std::find(out.files.begin(), out.files.end(), included) == out.files.end()) {
                const auto inner = shaderText(included, shaderDir_);
                if (!inner)
                    return internalError(
                        fmt::format("{}:{}: error: no shader named \"{}\"", name, lineNumber, included));
                out.text += lineDirective(1, out.files.size());
                SHOAL_TRY(add(included, *inner));
                out.text += lineDirective(lineNumber + 1, number);
                continue;
            }
            out.text += '\n';
        }
        return {};
    }

    FlatSource out;

private:
    const std::string& shaderDir_;
};

struct Place {
    std::size_t file = 0, line = 0, length = 0;  // length: characters of the log it takes
};

std::optional<std::size_t> takeNumber(std::string_view text, std::size_t& at) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (error != std::errc()) return std::nullopt;
    at = std::size_t(end - text.data());
    return value;
}

bool take(std::string_view text, std::size_t& at, std::string_view what) {
    if (text.substr(at, what.size()) != what) return false;
    at += what.size();
    return true;
}

// "0:12(3):" (Mesa), "0(12) :" (NVIDIA), "0:12:" (reference compiler), at the start of `line`.
std::optional<Place> placeAt(std::string_view line) {
    Place place;
    std::size_t at = 0;
    const auto file = takeNumber(line, at);
    if (!file) return std::nullopt;
    place.file = *file;
    if (take(line, at, ":")) {
        const auto number = takeNumber(line, at);
        if (!number) return std::nullopt;
        place.line = *number;
        if (take(line, at, "(") && !(takeNumber(line, at) && take(line, at, ")"))) return std::nullopt;
        if (!take(line, at, ":")) return std::nullopt;
    } else {
        if (!take(line, at, "(")) return std::nullopt;
        const auto number = takeNumber(line, at);
        if (!number || !take(line, at, ")")) return std::nullopt;
        place.line = *number;
        if (!take(line, at, " :") && !take(line, at, ":")) return std::nullopt;
    }
    if (place.line >= kLinesPerFile) place.file = place.line / kLinesPerFile, place.line %= kLinesPerFile;
    place.length = at;
    return place;
}

}  // namespace

void registerShaders(std::span<const EmbeddedShader> shaders) {
    if (shaders.empty()) return;
    Registry& r = registry();
    const std::lock_guard lock(r.mutex);
    for (const auto& table : r.tables)
        if (table.data() == shaders.data()) return;
    r.tables.push_back(shaders);
}

std::optional<std::string> shaderText(std::string_view name, const std::string& shaderDir) {
    const std::string longer = std::string(name) + ".glsl";
    const bool entry = !name.ends_with(".glsl") && !shaderStage(name).empty();
    if (!shaderDir.empty()) {
        if (auto text = fileText(name, shaderDir)) return text;
        if (entry)
            if (auto text = fileText(longer, shaderDir)) return text;
    }
    if (auto text = embeddedText(name)) return text;
    return entry ? embeddedText(longer) : std::nullopt;
}

std::string_view shaderStage(std::string_view name) {
    if (name.ends_with(".glsl")) name.remove_suffix(5);
    for (std::string_view stage : {"vert", "frag", "comp", "geom"})
        if (name.size() > stage.size() && name.ends_with(stage) && name[name.size() - stage.size() - 1] == '.')
            return stage;
    return {};
}

std::string nameLogPlaces(std::string_view log, const std::vector<std::string>& files) {
    std::string out;
    for (std::size_t at = 0; at < log.size();) {
        const std::size_t end = std::min(log.find_first_of("\n\r", at), log.size());
        std::string_view line = log.substr(at, end - at);
        at = end + 1;
        while (line.ends_with(' ') || line.ends_with('\0')) line.remove_suffix(1);
        if (line.empty()) continue;
        std::string severity;
        for (const auto& [from, to] : {std::pair("ERROR: ", " error:"), std::pair("WARNING: ", " warning:")})
            if (line.starts_with(from) && placeAt(line.substr(std::string_view(from).size()))) {
                line.remove_prefix(std::string_view(from).size());
                severity = to;
            }
        if (!out.empty()) out += '\n';
        const auto place = placeAt(line);
        if (place && place->file < files.size()) {
            out += fmt::format("{}:{}:{}", files[place->file], place->line, severity);
            line.remove_prefix(place->length);
        }
        out += line;
    }
    return out;
}

std::string withDefines(const std::string& flat, const std::vector<std::pair<std::string, std::string>>& defines) {
    if (defines.empty()) return flat;
    // #version must come first; comments and empty lines may stand before it.
    std::size_t at = 0, lineNumber = 1;
    while (at < flat.size() && !trimLeft(std::string_view(flat).substr(at)).starts_with("#version")) {
        at = std::min(flat.find('\n', at), flat.size() - 1) + 1;
        ++lineNumber;
    }
    const std::size_t end = std::min(flat.find('\n', at), flat.size());
    std::string out = flat.substr(0, end) + '\n';
    for (const auto& [name, value] : defines) out += fmt::format("#define {} {}\n", name, value);
    out += lineDirective(lineNumber + 1, 0);
    if (end < flat.size()) out += flat.substr(end + 1);
    return out;
}

Result<FlatSource> flattenShader(const std::string& name, const std::string& shaderDir) {
    const auto text = shaderText(name, shaderDir);
    if (!text)
        return internalError(shaderDir.empty()
                                 ? fmt::format("{}: no such shader is embedded", name)
                                 : fmt::format("{}: no such shader below {} nor embedded", name, shaderDir));
    Flattener flattener(shaderDir);
    SHOAL_TRY(flattener.add(name, *text));
    return std::move(flattener.out);
}

std::vector<std::string> embeddedShaderNames() {
    std::vector<std::string> names;
    Registry& r = registry();
    const std::lock_guard lock(r.mutex);
    for (const auto& table : r.tables)
        for (const EmbeddedShader& shader : table)
            if (!shaderStage(shader.path).empty()) names.emplace_back(shader.path);
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace shoal::gl
