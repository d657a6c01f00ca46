#include <fmt/format.h>
#include <shoal/core/params.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace shoal {

namespace {

constexpr double kUnbounded = 1e30;  // Field's default ends
constexpr std::size_t kLongestShown = 60;

using Kind = FieldValue::Kind;

// `"text"` on one line whatever is in it, cut where it is long.
std::string quoted(std::string_view text) {
    std::string shown = "\"";
    for (const char c : text.substr(0, kLongestShown))
        shown += (unsigned char)c < 0x20 || c == 0x7f ? fmt::format("\\x{:02x}", (unsigned char)c) : std::string(1, c);
    return shown + (text.size() > kLongestShown ? "..." : "") + "\"";
}

std::string listed(const std::vector<double>& numbers) {
    constexpr std::size_t kMostShown = 6;
    std::string shown = "[";
    for (std::size_t i = 0; i < std::min(numbers.size(), kMostShown); ++i)
        shown += (i == 0 ? "" : ", ") + fmt::format("{}", numbers[i]);
    return shown + (numbers.size() > kMostShown ? ", ...]" : "]");
}

std::string found(const FieldValue& value) {
    switch (value.kind) {
        case Kind::boolean:
            return value.boolean ? "true" : "false";
        case Kind::number:
            return value.numbers.empty() ? "nothing" : fmt::format("{}", value.numbers[0]);
        case Kind::numbers:
            return listed(value.numbers);
        case Kind::text:
            break;
    }
    return quoted(value.text);
}

// "1 .. 179 deg", "at least 0 m", "" where every number will do.
std::string rangeWords(const Field& field) {
    const bool below = field.lowest > -kUnbounded, above = field.highest < kUnbounded;
    if (!below && !above) return "";
    const std::string unit = field.unit[0] != '\0' ? std::string(" ") + field.unit : "";
    if (!above) return fmt::format("at least {}{}", field.lowest, unit);
    if (!below) return fmt::format("at most {}{}", field.highest, unit);
    return fmt::format("{} .. {}{}", field.lowest, field.highest, unit);
}

std::string choiceWords(const Field& field) {
    std::string words;
    for (const std::string& choice : field.choices) words += (words.empty() ? "" : " | ") + choice;
    return words;
}

std::string wrong(const Field& field, std::string_view foundWords, std::string_view expected) {
    return fmt::format("{}: found {}, expected {}", field.name, foundWords, expected);
}

// What a number of this field should have been. `what`: "a number", "an integer", "3 numbers".
std::string expectedNumber(const Field& field, std::string_view what) {
    const std::string range = rangeWords(field);
    return range.empty() ? std::string(what) : fmt::format("{}, {}", what, range);
}

// Compared as floats: 0.1f is above the double 0.1, yet within a range that ends at 0.1.
bool inRange(float value, const Field& field) {
    return std::isfinite(value) && value >= float(field.lowest) && value <= float(field.highest);
}

std::string rangeOrNumber(const Field& field, std::string_view what) {
    const std::string range = rangeWords(field);
    return range.empty() ? std::string(what) : range;
}

template <class Integer>
Result<void> assignInteger(Integer& to, const Field& field, const FieldValue& value) {
    if (value.kind != Kind::number || value.numbers.size() != 1)
        return badInput(wrong(field, found(value), expectedNumber(field, "an integer")));
    const double number = value.numbers[0];
    if (!std::isfinite(number) || number != std::floor(number))
        return badInput(wrong(field, found(value), expectedNumber(field, "an integer")));
    constexpr double kLeast = double(std::numeric_limits<Integer>::lowest()),
                     kMost = double(std::numeric_limits<Integer>::max());
    if (number < kLeast || number > kMost || number < field.lowest || number > field.highest)
        return badInput(wrong(field, found(value),
                              rangeOrNumber(field, fmt::format("an integer, {:.0f} .. {:.0f}", kLeast, kMost))));
    to = Integer(number);
    return {};
}

// Every component, or an error; `to` changes only when all of them are right.
Result<void> assignFloats(std::initializer_list<float*> to, const Field& field, const FieldValue& value) {
    const bool scalar = to.size() == 1;
    const std::string what = scalar ? "a number" : fmt::format("{} numbers", to.size());
    if (value.kind != (scalar ? Kind::number : Kind::numbers) || value.numbers.size() != to.size())
        return badInput(wrong(field, found(value), expectedNumber(field, what)));
    for (const double number : value.numbers)
        if (!inRange(float(number), field)) {
            const std::string inWhat = scalar ? found(value) : fmt::format("{} in {}", number, listed(value.numbers));
            return badInput(wrong(field, inWhat, rangeOrNumber(field, "a finite number")));
        }
    std::size_t i = 0;
    for (float* component : to) *component = float(value.numbers[i++]);
    return {};
}

std::string checkFloats(std::initializer_list<float> values, const Field& field) {
    for (const float value : values)
        if (!inRange(value, field)) {
            const std::string all = listed({values.begin(), values.end()});
            const std::string inWhat =
                values.size() == 1 ? fmt::format("{}", value) : fmt::format("{} in {}", value, all);
            return wrong(field, inWhat, rangeOrNumber(field, "a finite number"));
        }
    return "";
}

template <class Integer>
std::string checkInteger(Integer value, const Field& field) {
    if (double(value) >= field.lowest && double(value) <= field.highest) return "";
    return wrong(field, fmt::format("{}", value), rangeWords(field));
}

std::string_view trimmed(std::string_view words) {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::size_t first = words.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return words.substr(first, words.find_last_not_of(kSpace) - first + 1);
}

// The whole of `words` as a number. One too large for a double is an infinity, which every field refuses.
bool parseNumber(std::string_view words, double& number) {
    if (words.starts_with('+') && words.size() > 1 && words[1] != '-') words.remove_prefix(1);
    const auto [end, error] = std::from_chars(words.data(), words.data() + words.size(), number);
    if (error == std::errc::invalid_argument || end != words.data() + words.size()) return false;
    if (error == std::errc::result_out_of_range) number = HUGE_VAL;
    return true;
}

Result<FieldValue> parseList(std::string_view words) {
    FieldValue value{Kind::numbers, false, {}, std::string(words)};
    if (words.size() < 2 || !words.ends_with(']'))
        return badInput(fmt::format("found {}, expected a list of numbers that ends in ]", quoted(words)));
    std::string_view rest = trimmed(words.substr(1, words.size() - 2));
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const std::string_view item = trimmed(rest.substr(0, comma));
        double number = 0;
        if (!parseNumber(item, number))
            return badInput(fmt::format("found {} in {}, expected a number", quoted(item), quoted(words)));
        value.numbers.push_back(number);
        rest = comma == std::string_view::npos ? std::string_view{} : trimmed(rest.substr(comma + 1));
    }
    return value;
}

Result<FieldValue> parseQuoted(std::string_view words) {
    const char quote = words[0];
    FieldValue value{Kind::text, false, {}, {}};
    std::size_t i = 1;
    for (; i < words.size() && words[i] != quote; ++i) {
        const bool escape = quote == '"' && words[i] == '\\' && i + 1 < words.size();
        const char c = escape ? words[++i] : words[i];
        value.text += escape && c == 'n' ? '\n' : escape && c == 't' ? '\t' : c;
    }
    if (i + 1 != words.size()) return badInput(fmt::format("found {}, expected one text in quotes", quoted(words)));
    return value;
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

std::string lowered(std::string_view word) {
    std::string result(word);
    std::transform(result.begin(), result.end(), result.begin(), lower);
    return result;
}

// Insertions, deletions, substitutions and swaps of neighbours (optimal string alignment) [Damerau 1964].
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> twoBack(b.size() + 1), back(b.size() + 1), now(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) back[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            now[j] = std::min({back[j] + 1, now[j - 1] + 1, back[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], twoBack[j - 2] + 1);
        }
        std::swap(twoBack, back);
        std::swap(back, now);
    }
    return back[b.size()];
}

}  // namespace

Result<FieldValue> parseFieldValue(std::string_view words) {
    words = trimmed(words);
    if (words.empty()) return badInput("found nothing, expected a value");
    if (words[0] == '[') return parseList(words);
    if (words[0] == '"' || words[0] == '\'') return parseQuoted(words);
    FieldValue value{Kind::text, words == "true", {}, std::string(words)};
    double number = 0;
    if (words == "true" || words == "false") {
        value.kind = Kind::boolean;
    } else if (parseNumber(words, number)) {
        value.kind = Kind::number;
        value.numbers = {number};
    }
    return value;
}

namespace detail {

Result<void> assignField(bool& to, const Field& field, const FieldValue& value) {
    if (value.kind != Kind::boolean) return badInput(wrong(field, found(value), "true or false"));
    to = value.boolean;
    return {};
}
Result<void> assignField(int& to, const Field& field, const FieldValue& value) {
    return assignInteger(to, field, value);
}
Result<void> assignField(std::uint32_t& to, const Field& field, const FieldValue& value) {
    return assignInteger(to, field, value);
}
Result<void> assignField(float& to, const Field& field, const FieldValue& value) {
    return assignFloats({&to}, field, value);
}
Result<void> assignField(Vec2& to, const Field& field, const FieldValue& value) {
    return assignFloats({&to.x, &to.y}, field, value);
}
Result<void> assignField(Vec3& to, const Field& field, const FieldValue& value) {
    return assignFloats({&to.x, &to.y, &to.z}, field, value);
}
Result<void> assignField(Vec4& to, const Field& field, const FieldValue& value) {
    return assignFloats({&to.x, &to.y, &to.z, &to.w}, field, value);
}
Result<void> assignField(std::string& to, const Field& field, const FieldValue& value) {
    // A number or true that came from the command line (its words are kept) is a text when the field is one.
    if (value.kind != Kind::text && value.text.empty())
        return badInput(wrong(field, found(value), field.choices.empty() ? "a text" : choiceWords(field)));
    if (std::string problem = checkField(value.text, field); !problem.empty()) return badInput(std::move(problem));
    to = value.text;
    return {};
}

std::string checkField(bool, const Field&) { return ""; }
std::string checkField(int value, const Field& field) { return checkInteger(value, field); }
std::string checkField(std::uint32_t value, const Field& field) { return checkInteger(value, field); }
std::string checkField(float value, const Field& field) { return checkFloats({value}, field); }
std::string checkField(Vec2 value, const Field& field) { return checkFloats({value.x, value.y}, field); }
std::string checkField(Vec3 value, const Field& field) { return checkFloats({value.x, value.y, value.z}, field); }
std::string checkField(Vec4 value, const Field& field) {
    return checkFloats({value.x, value.y, value.z, value.w}, field);
}
std::string checkField(const std::string& value, const Field& field) {
    const std::vector<std::string>& choices = field.choices;
    if (choices.empty() || std::find(choices.begin(), choices.end(), value) != choices.end()) return "";
    std::string problem = wrong(field, quoted(value), choiceWords(field));
    if (const std::string near = nearestWord(value, choices); !near.empty())
        problem += fmt::format(" (did you mean \"{}\"?)", near);
    return problem;
}

std::string showField(bool value) { return value ? "true" : "false"; }
std::string showField(int value) { return fmt::format("{}", value); }
std::string showField(std::uint32_t value) { return fmt::format("{}", value); }
std::string showField(float value) { return fmt::format("{}", value); }
std::string showField(Vec2 v) { return fmt::format("[{}, {}]", v.x, v.y); }
std::string showField(Vec3 v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }
std::string showField(Vec4 v) { return fmt::format("[{}, {}, {}, {}]", v.x, v.y, v.z, v.w); }
std::string showField(const std::string& value) { return value; }

std::string showRange(const Field& field) {
    if (!field.choices.empty()) return choiceWords(field);
    Field plain = field;
    plain.unit = "";  // has a column of its own
    return rangeWords(plain);
}

}  // namespace detail

std::string nearestWord(std::string_view word, const std::vector<std::string>& known) {
    const std::string wanted = lowered(word);
    const std::size_t limit = std::max<std::size_t>(2, word.size() / 3);
    std::string nearest;
    std::size_t nearestDistance = limit + 1;
    for (const std::string& candidate : known) {
        const std::size_t longer = std::max(word.size(), candidate.size()),
                          shorter = std::min(word.size(), candidate.size());
        if (longer - shorter >= nearestDistance) continue;  // the distance is at least that
        const std::size_t distance = editDistance(wanted, lowered(candidate));
        if (distance >= nearestDistance || distance >= longer) continue;  // nothing in common is not near
        nearestDistance = distance;
        nearest = candidate;
    }
    return nearest;
}

std::string unknownWord(std::string_view what, std::string_view word, const std::vector<std::string>& known) {
    const std::string near = nearestWord(word, known);
    std::string message = fmt::format("unknown {} {}", what, quoted(word));
    if (!near.empty()) return message + fmt::format(" (did you mean \"{}\"?)", near);
    constexpr std::size_t kMostListed = 16;
    if (known.empty() || known.size() > kMostListed) return message;
    message += ", known:";
    for (std::size_t i = 0; i < known.size(); ++i) message += (i == 0 ? " " : ", ") + known[i];
    return message;
}

}  // namespace shoal
