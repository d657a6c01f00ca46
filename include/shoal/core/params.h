// One description of every parameter: name, unit, range, default and a sentence. Beside each parameter struct stands a
//   template <class Params, class Visitor> void visit(Params& p, Visitor&& v) { v(p.field, Field{...}); ... }
// (Params may be const). TOML binding, --set, validation, panels, --help and the docs table all come from it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <shoal/core/math.h>
#include <shoal/core/result.h>

namespace shoal {

struct Field {
    const char* name;       // camelCase, as in the scene file
    const char* unit = "";  // "m", "W/m2", "deg", "px", "" for none
    double lowest = -1e30;  // range, both ends included; every component of a vector
    double highest = 1e30;
    const char* sentence = "";              // what it does
    std::vector<std::string> choices = {};  // for a std::string field: the words it may be; empty: free text
};

// A value of a parameter in words or from words: what TOML or --set gives.
struct FieldValue {
    enum class Kind { boolean, number, numbers, text } kind = Kind::number;
    bool boolean = false;
    std::vector<double> numbers;  // one for Kind::number
    std::string text;
};

// "3.5", "[1, 2, 3]", "true", "agx" or "\"agx\"" to a value. `text` keeps the words of every kind: a text field takes
// "5" too.
Result<FieldValue> parseFieldValue(std::string_view words);

namespace detail {
Result<void> assignField(bool& to, const Field&, const FieldValue&);
Result<void> assignField(int& to, const Field&, const FieldValue&);
Result<void> assignField(std::uint32_t& to, const Field&, const FieldValue&);
Result<void> assignField(float& to, const Field&, const FieldValue&);
Result<void> assignField(Vec2& to, const Field&, const FieldValue&);
Result<void> assignField(Vec3& to, const Field&, const FieldValue&);
Result<void> assignField(Vec4& to, const Field&, const FieldValue&);
Result<void> assignField(std::string& to, const Field&, const FieldValue&);
std::string checkField(bool, const Field&);
std::string checkField(int, const Field&);
std::string checkField(std::uint32_t, const Field&);
std::string checkField(float, const Field&);
std::string checkField(Vec2, const Field&);
std::string checkField(Vec3, const Field&);
std::string checkField(Vec4, const Field&);
std::string checkField(const std::string&, const Field&);
std::string showField(bool);
std::string showField(int);
std::string showField(std::uint32_t);
std::string showField(float);
std::string showField(Vec2);
std::string showField(Vec3);
std::string showField(Vec4);
std::string showField(const std::string&);
std::string showRange(const Field&);  // "0 .. 1", "at least 0", "a | b", "" where everything will do; no unit
}  // namespace detail

// Nearest of `known` to `word` by edit distance, or "" when none is close (more than a third of its letters off, at
// least 2).
std::string nearestWord(std::string_view word, const std::vector<std::string>& known);
// `unknown key "fovDg" (did you mean "fovDeg"?)`: what every unknown name is answered with. `what`: "key", "verb",
// "option".
std::string unknownWord(std::string_view what, std::string_view word, const std::vector<std::string>& known);

// Sets field `name` of `params`; the error names the field, the value found and the range or words expected.
template <class Params>
Result<void> setField(Params& params, std::string_view name, const FieldValue& value) {
    std::vector<std::string> known;
    bool found = false;
    Result<void> result;
    visit(params, [&](auto& field, const Field& description) {
        known.push_back(description.name);
        if (name != description.name) return;
        found = true;
        result = detail::assignField(field, description, value);
    });
    if (!found) return badInput(unknownWord("key", name, known));
    return result;
}

// The first field out of range, in words; ok where there is none.
template <class Params>
Result<void> validate(const Params& params) {
    std::string wrong;
    visit(params, [&](const auto& field, const Field& description) {
        if (wrong.empty()) wrong = detail::checkField(field, description);
    });
    if (!wrong.empty()) return badInput(wrong);
    return {};
}

// One row a field: name, unit, range, default, sentence. For --help and the docs table.
struct FieldRow {
    std::string name, unit, range, value, sentence;
};
template <class Params>
std::vector<FieldRow> describe(const Params& params) {
    std::vector<FieldRow> rows;
    visit(params, [&](const auto& field, const Field& d) {
        rows.push_back({d.name, d.unit, detail::showRange(d), detail::showField(field), d.sentence});
    });
    return rows;
}

}  // namespace shoal
