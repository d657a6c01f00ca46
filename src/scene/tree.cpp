#include "scene/tree.h"

#include <algorithm>
#include <cctype>
#include <charconv>

// toml++ 3.3.0 aborts on broken tables such as "\n[\n["; without the check its parser reports them as errors.
#define TOML_ASSERT(condition) static_cast<void>(0)
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_UNRELEASED_FEATURES 0
#include <toml++/toml.h>

namespace shoal::scene {

Tree* Tree::find(std::string_view key) {
    for (auto& [name, member] : members)
        if (name == key) return &member;
    return nullptr;
}

const Tree* Tree::find(std::string_view key) const { return const_cast<Tree*>(this)->find(key); }

std::vector<std::string> Tree::keys() const {
    std::vector<std::string> names;
    for (const auto& member : members) names.push_back(member.name);
    return names;
}

const char* describeKind(const Tree& tree) {
    if (tree.kind == Tree::Kind::table) return "a table";
    if (tree.kind == Tree::Kind::array) return "an array";
    switch (tree.value.kind) {
        case FieldValue::Kind::boolean:
            return "true or false";
        case FieldValue::Kind::number:
            return "a number";
        case FieldValue::Kind::numbers:
            return "an array of numbers";
        case FieldValue::Kind::text:
            return "a text";
    }
    return "a value";
}

namespace {

// Scenes need five levels; every level is a few frames of the stack here and in what reads the tree.
constexpr int kDeepestLevel = 32;

Result<Tree> convert(const toml::node& node, const std::string& file, int level);

bool isNumber(const toml::node& node) { return node.is_integer() || node.is_floating_point(); }

double numberOf(const toml::node& node) {
    return node.is_integer() ? double(node.as_integer()->get()) : node.as_floating_point()->get();
}

Result<Tree> convertArray(const toml::array& array, Tree tree, int level) {
    if (!array.empty() && std::all_of(array.begin(), array.end(), isNumber)) {
        tree.kind = Tree::Kind::value;
        tree.value.kind = FieldValue::Kind::numbers;
        for (const toml::node& element : array) tree.value.numbers.push_back(numberOf(element));
        return tree;
    }
    tree.kind = Tree::Kind::array;
    for (const toml::node& element : array) {
        SHOAL_TRY_ASSIGN(Tree child, convert(element, tree.place.file, level + 1));
        tree.elements.push_back(std::move(child));
    }
    return tree;
}

Result<Tree> convertTable(const toml::table& table, Tree tree, int level) {
    tree.kind = Tree::Kind::table;
    // The library sorts by name; a person's order is that of the places.
    std::vector<std::pair<std::pair<int, int>, TreeMember>> placed;
    for (const auto& [key, value] : table) {
        SHOAL_TRY_ASSIGN(Tree child, convert(value, tree.place.file, level + 1));
        const toml::source_position at = key.source().begin;
        child.place.line = int(at.line);
        placed.push_back({{int(at.line), int(at.column)}, {std::string(key.str()), std::move(child)}});
    }
    std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [place, member] : placed) tree.members.push_back(std::move(member));
    return tree;
}

Result<Tree> convert(const toml::node& node, const std::string& file, int level) {
    Tree tree;
    tree.place = {file, int(node.source().begin.line)};
    if (level > kDeepestLevel)
        return badInput(tree.place.describe() + ": found tables nested more than " + std::to_string(kDeepestLevel) +
                        " deep, expected fewer");
    if (const auto* table = node.as_table()) return convertTable(*table, std::move(tree), level);
    if (const auto* array = node.as_array()) return convertArray(*array, std::move(tree), level);
    tree.kind = Tree::Kind::value;
    if (node.is_boolean()) {
        tree.value.kind = FieldValue::Kind::boolean;
        tree.value.boolean = node.as_boolean()->get();
    } else if (isNumber(node)) {
        tree.value.kind = FieldValue::Kind::number;
        tree.value.numbers = {numberOf(node)};
    } else if (const auto* text = node.as_string()) {
        tree.value.kind = FieldValue::Kind::text;
        tree.value.text = text->get();
    } else {
        return badInput(tree.place.describe() + ": found a date or time, expected a number, a text, true or false");
    }
    return tree;
}

// One step of an override's key: a name, then indices.
struct Step {
    std::string name;
    std::vector<std::size_t> indices;
};

Result<std::vector<Step>> splitKey(const std::string& key) {
    const Error malformed = usageError("--set " + key + ": expected a key such as camera.fovDeg or model[0].clip");
    std::vector<Step> steps;
    std::size_t at = 0;
    while (at <= key.size()) {
        const std::size_t end = std::min(key.find('.', at), key.size());
        const std::string_view part = std::string_view(key).substr(at, end - at);
        Step step;
        const std::size_t bracket = std::min(part.find('['), part.size());
        step.name = part.substr(0, bracket);
        if (step.name.empty()) return malformed;
        std::string_view rest = part.substr(bracket);
        while (!rest.empty()) {
            const std::size_t close = rest.find(']');
            std::size_t index = 0;
            if (rest[0] != '[' || close == std::string_view::npos || close > 9) return malformed;
            const auto [last, error] = std::from_chars(rest.data() + 1, rest.data() + close, index);
            if (error != std::errc() || last != rest.data() + close) return malformed;
            step.indices.push_back(index);
            rest.remove_prefix(close + 1);
        }
        steps.push_back(std::move(step));
        at = end + 1;
    }
    return steps;
}

// The words after "=" as a tree: any TOML value, or else a bare text.
Tree treeOfWords(const std::string& words) {
    toml::parse_result parsed = toml::parse("value = " + words + "\n");
    if (parsed && parsed.table().size() == 1) {
        if (auto tree = convert(*parsed.table().get("value"), "", 0)) {
            const auto forgetPlaces = [](auto& self, Tree& t) -> void {
                t.place = {};
                for (auto& member : t.members) self(self, member.tree);
                for (Tree& element : t.elements) self(self, element);
            };
            forgetPlaces(forgetPlaces, *tree);
            return *std::move(tree);
        }
    }
    Tree text;
    text.kind = Tree::Kind::value;
    text.value.kind = FieldValue::Kind::text;
    text.value.text = words;
    return text;
}

}  // namespace

namespace {

// Line of a dotted key (a.b.c) with more than `most` dots, 0 where there is none. toml++ limits nested values but not
// these, and overflows the stack on long ones. What can stand in a key makes a run; a dot after a dot is prose.
int lineOfDeepKey(std::string_view text, int most) {
    int line = 1, dots = 0;
    char before = 0;
    for (const char c : text) {
        const bool inKey = std::isalnum(static_cast<unsigned char>(c)) ||
                           std::string_view("_-.\"' \t").find(c) != std::string_view::npos;
        if (!inKey) dots = 0;
        if (c == '.' && before != '.' && ++dots > most) return line;
        if (c == '\n') ++line;
        if (c != ' ' && c != '\t') before = c;
    }
    return 0;
}

}  // namespace

Result<Tree> parseTree(std::string_view text, const std::filesystem::path& file) {
    if (text.size() > kSceneTextLimit)
        return badInput(file.string() + ": " + std::to_string(text.size()) +
                        " bytes, expected a scene file of at most " + std::to_string(kSceneTextLimit));
    if (const int line = lineOfDeepKey(text, 2 * kDeepestLevel))
        return badInput(file.string() + ":" + std::to_string(line) + ": found a key of more than " +
                        std::to_string(2 * kDeepestLevel) + " parts, expected fewer");
    const toml::parse_result parsed = toml::parse(text, file.string());
    if (!parsed) {
        const toml::parse_error& error = parsed.error();
        std::string description(error.description());
        std::replace(description.begin(), description.end(), '\n', ' ');
        return badInput(file.string() + ":" + std::to_string(error.source().begin.line) +
                        ": not valid TOML: " + description);
    }
    return convert(parsed.table(), file.string(), 0);
}

Result<void> applyOverride(Tree& root, const Override& change) {
    SHOAL_TRY_ASSIGN(const std::vector<Step> steps, splitKey(change.key));
    Tree* at = &root;
    for (const Step& step : steps) {
        if (at->kind != Tree::Kind::table)
            return usageError("--set " + change.key + ": " + step.name + " is asked of " + describeKind(*at) +
                              ", expected a table");
        Tree* member = at->find(step.name);
        if (!member) {
            at->members.push_back({step.name, Tree{}});
            member = &at->members.back().tree;
        }
        for (const std::size_t index : step.indices) {
            if (member->kind != Tree::Kind::array || index >= member->elements.size())
                return usageError("--set " + change.key + ": no element " + std::to_string(index) + ", " + step.name +
                                  " has " + std::to_string(member->elements.size()));
            member = &member->elements[index];
        }
        at = member;
    }
    *at = treeOfWords(change.value);
    return {};
}

Result<void> applyOverrides(Tree& root, std::span<const Override> changes) {
    for (const Override& change : changes) SHOAL_TRY(applyOverride(root, change));
    // Two ways to say the same thing: the one that was set counts.
    const auto replaces = [&](const char* key, const char* table, const std::vector<std::string>& others) {
        Tree* tree = root.find(table);
        const auto isSet = [&](const std::string& wanted) {
            return std::any_of(changes.begin(), changes.end(), [&](const Override& c) { return c.key == wanted; });
        };
        if (!tree || !isSet(key)) return;
        std::erase_if(tree->members, [&](const TreeMember& member) {
            return std::find(others.begin(), others.end(), member.name) != others.end() &&
                   !isSet(std::string(table) + "." + member.name);
        });
    };
    replaces("camera.position", "camera", {"orbit", "path", "poses", "model"});
    replaces("sun.toSun", "sun", {"elevationDeg", "azimuthDeg"});
    return {};
}

}  // namespace shoal::scene
