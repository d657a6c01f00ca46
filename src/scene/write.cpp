// Scene files out. The text is edited in place, statement by statement; where that cannot say what is wanted, the tree
// is written whole. The edited text is parsed again and compared, so the short way is never a wrong way.
#include <shoal/scene/write.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scene/statements.h"
#include "scene/tree.h"

namespace shoal::scene {

namespace {

std::string numberText(double number) {
    std::string text = fmt::format("{}", number);
    return text;
}

bool isBareKey(std::string_view key) {
    return !key.empty() &&
           std::all_of(key.begin(), key.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

std::string keyText(std::string_view key) { return isBareKey(key) ? std::string(key) : quotedToml(key); }

// On one line: tables as { }, arrays as [ ].
std::string inlineText(const Tree& tree) {
    std::string text;
    if (tree.kind == Tree::Kind::table) {
        for (const TreeMember& member : tree.members)
            text += (text.empty() ? "" : ", ") + keyText(member.name) + " = " + inlineText(member.tree);
        return text.empty() ? "{}" : "{ " + text + " }";
    }
    if (tree.kind == Tree::Kind::array) {
        for (const Tree& element : tree.elements) text += (text.empty() ? "" : ", ") + inlineText(element);
        return "[" + text + "]";
    }
    switch (tree.value.kind) {
        case FieldValue::Kind::boolean:
            return tree.value.boolean ? "true" : "false";
        case FieldValue::Kind::number:
            return numberText(tree.value.numbers.at(0));
        case FieldValue::Kind::numbers:
            for (const double number : tree.value.numbers) text += (text.empty() ? "" : ", ") + numberText(number);
            return "[" + text + "]";
        case FieldValue::Kind::text:
            break;
    }
    return quotedToml(tree.value.text);
}

bool isArrayOfTables(const Tree& tree) {
    return tree.kind == Tree::Kind::array && !tree.elements.empty() &&
           std::all_of(tree.elements.begin(), tree.elements.end(),
                       [](const Tree& element) { return element.kind == Tree::Kind::table; });
}

// Plain values of a table first, then its tables under headers: [camera], [[model]].
void writeTable(const Tree& table, const std::string& path, std::string& text) {
    const bool atRoot = path.empty();
    for (const TreeMember& member : table.members) {
        const bool asHeader = atRoot && (member.tree.kind == Tree::Kind::table || isArrayOfTables(member.tree));
        if (!asHeader) text += keyText(member.name) + " = " + inlineText(member.tree) + "\n";
    }
    if (!atRoot) return;
    for (const TreeMember& member : table.members) {
        if (member.tree.kind == Tree::Kind::table) {
            text += "\n[" + keyText(member.name) + "]\n";
            writeTable(member.tree, member.name, text);
        } else if (isArrayOfTables(member.tree)) {
            for (const Tree& element : member.tree.elements) {
                text += "\n[[" + keyText(member.name) + "]]\n";
                writeTable(element, member.name, text);
            }
        }
    }
}

bool sameTree(const Tree& a, const Tree& b) {
    if (a.kind != b.kind) return false;
    if (a.kind == Tree::Kind::value)
        return a.value.kind == b.value.kind && a.value.boolean == b.value.boolean &&
               a.value.numbers == b.value.numbers &&
               (a.value.kind != FieldValue::Kind::text || a.value.text == b.value.text);
    if (a.members.size() != b.members.size() || a.elements.size() != b.elements.size()) return false;
    for (std::size_t i = 0; i < a.elements.size(); ++i)
        if (!sameTree(a.elements[i], b.elements[i])) return false;
    for (const TreeMember& member : a.members) {
        const Tree* other = b.find(member.name);
        if (!other || !sameTree(member.tree, *other)) return false;
    }
    return true;
}

// The tree's keys of texts that name files of the folder `from`, as they must be written in the folder `to`.
void collectMoved(const Tree& tree, const std::string& path, const std::filesystem::path& from,
                  const std::filesystem::path& to, std::vector<Override>& moved) {
    for (const TreeMember& member : tree.members)
        collectMoved(member.tree, path.empty() ? member.name : path + "." + member.name, from, to, moved);
    for (std::size_t i = 0; i < tree.elements.size(); ++i)
        collectMoved(tree.elements[i], path + "[" + std::to_string(i) + "]", from, to, moved);
    if (tree.kind != Tree::Kind::value || tree.value.kind != FieldValue::Kind::text || tree.value.text.empty()) return;
    const std::filesystem::path name(tree.value.text);
    std::error_code error;
    if (name.is_absolute() || !name.has_extension() || name.native().size() > 4096) return;
    // Of a numbered sequence the folder is enough.
    const bool numbered = tree.value.text.find('#') != std::string::npos;
    const std::filesystem::path there = numbered ? (from / name).parent_path() : from / name;
    if (!std::filesystem::exists(there, error) || error) return;
    const std::filesystem::path relative = (from / name).lexically_normal().lexically_relative(to);
    moved.push_back({path, quotedToml((relative.empty() ? from / name : relative).generic_string())});
}

const Tree* findPath(const Tree& root, const std::string& path) {
    const Tree* at = &root;
    std::size_t begin = 0;
    while (at && begin < path.size()) {
        std::size_t end = path.find_first_of(".[", begin);
        end = std::min(end, path.size());
        if (end > begin) at = at->find(std::string_view(path).substr(begin, end - begin));
        if (at && end < path.size() && path[end] == '[') {
            const std::size_t index = std::size_t(std::atoll(path.c_str() + end + 1));
            at = index < at->elements.size() ? &at->elements[index] : nullptr;
            end = path.find(']', end) + 1;
            if (end < path.size() && path[end] == '[') {
                begin = end;
                continue;
            }
        }
        begin = end < path.size() && path[end] == '.' ? end + 1 : end;
    }
    return at;
}

std::string parentOf(const std::string& path) {
    const std::size_t cut = path.find_last_of(".[");
    return cut == std::string::npos ? "" : path.substr(0, cut);
}

// Makes one change in the text; false where the text has no place for it.
bool editOne(std::string& text, const std::string& key, const Tree& wanted) {
    for (std::string path = key; !path.empty(); path = parentOf(path)) {
        const Tree* value = findPath(wanted, path);
        if (!value) return false;
        const Statements statements = Statements::of(text);
        if (const Statement* statement = statements.find(path)) {
            text.replace(statement->valueBegin, statement->valueEnd - statement->valueBegin, inlineText(*value));
            return true;
        }
        const std::string parent = parentOf(path);
        const std::size_t dot = path.rfind('.');
        const std::string name = dot == std::string::npos ? path : path.substr(dot + 1);
        if (parent != (dot == std::string::npos ? "" : path.substr(0, dot))) continue;  // an array's element
        if (const auto at = statements.endOfTable(parent)) {
            const std::string line = keyText(name) + " = " + inlineText(*value) + "\n";
            text.insert(*at, *at > 0 && text[*at - 1] != '\n' ? "\n" + line : line);
            return true;
        }
        // A table of the root that the file has not got yet.
        if (!parent.empty() && parent.find_first_of(".[") == std::string::npos && !statements.find(parent)) {
            const Tree* table = findPath(wanted, parent);
            if (!table || table->kind != Tree::Kind::table) return false;
            text += (text.empty() || text.back() == '\n' ? "\n[" : "\n\n[") + keyText(parent) + "]\n" + keyText(name) +
                    " = " + inlineText(*value) + "\n";
            return true;
        }
    }
    return false;
}

std::optional<std::string> editedText(std::string text, const std::vector<Override>& changes, const Tree& wanted,
                                      const std::filesystem::path& file) {
    for (const char* other :
         {"camera.orbit", "camera.path", "camera.poses", "camera.model", "sun.elevationDeg", "sun.azimuthDeg"}) {
        if (findPath(wanted, other)) continue;
        const Statements statements = Statements::of(text);
        if (const Statement* statement = statements.find(other))
            text.erase(statement->begin, statement->end - statement->begin);
    }
    for (const Override& change : changes)
        if (!editOne(text, change.key, wanted)) return {};
    const auto again = parseTree(text, file);
    if (!again || !sameTree(*again, wanted)) return {};
    return text;
}

}  // namespace

std::string quotedToml(std::string_view value) {
    std::string text = "\"";
    for (const char c : value) {
        if (c == '"' || c == '\\')
            text += '\\', text += c;
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            text += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
        else
            text += c;
    }
    return text + "\"";
}

std::string sceneTextForModels(std::span<const std::filesystem::path> files) {
    std::string text = "ground = true  # one below everything\n";
    for (const std::filesystem::path& file : files)
        text += "\n[[model]]\nfile = " + quotedToml(std::filesystem::absolute(file).lexically_normal().string()) +
                "\nclip = \"*\"  # the first there is\n";
    return text;
}

Result<std::string> changedSceneText(std::string_view text, const std::filesystem::path& from,
                                     const std::filesystem::path& to, std::span<const Override> changes) {
    SHOAL_TRY_ASSIGN(Tree wanted, parseTree(text, from));
    SHOAL_TRY(applyOverrides(wanted, changes));
    std::vector<Override> all(changes.begin(), changes.end());
    const auto folderOf = [](const std::filesystem::path& file) {
        return std::filesystem::absolute(file).lexically_normal().parent_path();
    };
    if (folderOf(from) != folderOf(to)) {
        std::vector<Override> moved;
        collectMoved(wanted, "", folderOf(from), folderOf(to), moved);
        SHOAL_TRY(applyOverrides(wanted, moved));
        all.insert(all.end(), moved.begin(), moved.end());
    }
    if (auto edited = editedText(std::string(text), all, wanted, to)) return *std::move(edited);
    std::string whole = "# Written whole by shoal.\n";
    writeTable(wanted, "", whole);
    return whole;
}

}  // namespace shoal::scene
