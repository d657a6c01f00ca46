#include "io/gltf_json.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shoal::io {

namespace {

constexpr std::size_t kItemLimit = std::size_t(1) << 25;
constexpr std::uint32_t kNoItem = ~std::uint32_t(0);

const char* nameOf(JsonTree::Kind kind) {
    switch (kind) {
        case JsonTree::Kind::null:
            return "null";
        case JsonTree::Kind::boolean:
            return "a boolean";
        case JsonTree::Kind::number:
            return "a number";
        case JsonTree::Kind::string:
            return "a string";
        case JsonTree::Kind::array:
            return "an array";
        case JsonTree::Kind::object:
            return "an object";
    }
    return "";
}

// One line of at most 160 characters; what the lexer quotes may be a whole embedded buffer.
std::string shortened(std::string text) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while ..."
    if (const auto at = text.find("line "); at != std::string::npos && at < 80) text.erase(0, at);
    if (text.size() > 160) {
        std::size_t cut = 160;
        while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
        text.resize(cut);
        text += "...";
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace

// Receives the SAX events. Children are collected on one shared stack until their parent closes, then stored together.
class JsonBuilder {
public:
    using number_integer_t = nlohmann::json::number_integer_t;
    using number_unsigned_t = nlohmann::json::number_unsigned_t;
    using number_float_t = nlohmann::json::number_float_t;
    using string_t = nlohmann::json::string_t;
    using binary_t = nlohmann::json::binary_t;

    explicit JsonBuilder(JsonTree& tree) : tree_(tree) {}
    std::string error;

    bool null() { return add(JsonTree::Kind::null) != kNoItem; }
    bool boolean(bool value) { return addNumber(JsonTree::Kind::boolean, value ? 1 : 0); }
    bool number_integer(number_integer_t value) { return addNumber(JsonTree::Kind::number, double(value)); }
    bool number_unsigned(number_unsigned_t value) { return addNumber(JsonTree::Kind::number, double(value)); }
    bool number_float(number_float_t value, const string_t&) { return addNumber(JsonTree::Kind::number, value); }
    bool string(string_t& value) {
        const std::uint32_t item = add(JsonTree::Kind::string);
        if (item == kNoItem) return false;
        tree_.items_[item].first = std::uint32_t(tree_.strings_.size());
        tree_.strings_.push_back(std::move(value));
        return true;
    }
    bool binary(binary_t&) { return false; }
    bool start_object(std::size_t) { return open(JsonTree::Kind::object); }
    bool start_array(std::size_t) { return open(JsonTree::Kind::array); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(string_t& name) {
        auto found = keyIndex_.find(name);
        if (found == keyIndex_.end()) {
            tree_.keys_.push_back(name);
            found = keyIndex_.emplace(tree_.keys_.back(), std::uint32_t(tree_.keys_.size() - 1)).first;
        }
        pendingKey_ = found->second;
        return true;
    }
    template <class Exception>
    bool parse_error(std::size_t, const std::string&, const Exception& exception) {
        error = shortened(exception.what());
        return false;
    }

private:
    struct Frame {
        std::uint32_t item;
        std::size_t firstChild;  // in pending_
    };

    std::uint32_t add(JsonTree::Kind kind) {
        if (tree_.items_.size() >= kItemLimit) {
            error = fmt::format("more than {} values", kItemLimit);
            return kNoItem;
        }
        JsonTree::Item item;
        item.kind = kind;
        const auto index = std::uint32_t(tree_.items_.size());
        if (!frames_.empty()) {
            const Frame& frame = frames_.back();
            item.parent = frame.item;
            item.place = tree_.items_[frame.item].kind == JsonTree::Kind::object
                             ? pendingKey_
                             : std::uint32_t(pending_.size() - frame.firstChild);
            pending_.push_back(index);
        }
        tree_.items_.push_back(item);
        return index;
    }
    bool addNumber(JsonTree::Kind kind, double value) {
        const std::uint32_t item = add(kind);
        if (item == kNoItem) return false;
        tree_.items_[item].number = value;
        return true;
    }
    bool open(JsonTree::Kind kind) {
        const std::uint32_t item = add(kind);
        if (item == kNoItem) return false;
        frames_.push_back({item, pending_.size()});
        return true;
    }
    bool close() {
        const Frame frame = frames_.back();
        frames_.pop_back();
        JsonTree::Item& item = tree_.items_[frame.item];
        item.first = std::uint32_t(tree_.children_.size());
        item.count = std::uint32_t(pending_.size() - frame.firstChild);
        tree_.children_.insert(tree_.children_.end(), pending_.begin() + std::ptrdiff_t(frame.firstChild),
                               pending_.end());
        pending_.resize(frame.firstChild);
        return true;
    }

    JsonTree& tree_;
    std::vector<Frame> frames_;
    std::vector<std::uint32_t> pending_;
    std::unordered_map<std::string_view, std::uint32_t> keyIndex_;
    std::uint32_t pendingKey_ = 0;
};

JsonTree::JsonTree(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    JsonBuilder builder(*this);
    if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder))
        throw GltfError{fmt::format("not valid JSON: {}", builder.error)};
    if (items_.empty() || items_[0].kind != Kind::object)
        throw GltfError{fmt::format("not glTF: the JSON is {}, expected an object",
                                    items_.empty() ? "empty" : nameOf(items_[0].kind))};
}

JsonValue JsonTree::root() const { return JsonValue(this, 0); }

std::string JsonValue::path() const {
    if (!tree_) return {};
    std::vector<std::uint32_t> chain;
    for (std::uint32_t i = item_; i != 0; i = tree_->items_[i].parent) chain.push_back(i);
    std::string out;
    for (auto it = chain.rbegin(); it != chain.rend(); ++it) {
        const JsonTree::Item& item = tree_->items_[*it];
        if (tree_->items_[item.parent].kind == JsonTree::Kind::array) {
            out += fmt::format("[{}]", item.place);
        } else {
            if (!out.empty()) out += '.';
            out += tree_->keys_[item.place].substr(0, 60);
        }
        if (out.size() > 200) return out + "...";
    }
    return out;
}

void JsonValue::fail(std::string_view message) const {
    const std::string where = path();
    throw GltfError{where.empty() ? std::string(message) : fmt::format("{}: {}", where, message)};
}

JsonValue JsonValue::find(std::string_view key) const {
    if (!tree_) return {};
    const JsonTree::Item& self = item();
    if (self.kind != JsonTree::Kind::object) fail(fmt::format("{}, expected an object", nameOf(self.kind)));
    for (std::uint32_t i = 0; i < self.count; ++i) {
        const std::uint32_t child = tree_->children_[self.first + i];
        if (tree_->keys_[tree_->items_[child].place] == key) return {tree_, child};
    }
    return {};
}

JsonValue JsonValue::object(std::string_view key) const {
    const JsonValue value = find(key);
    if (value && value.item().kind != JsonTree::Kind::object)
        value.fail(fmt::format("{}, expected an object", nameOf(value.item().kind)));
    return value;
}

JsonValue JsonValue::array(std::string_view key) const {
    const JsonValue value = find(key);
    if (value && value.item().kind != JsonTree::Kind::array)
        value.fail(fmt::format("{}, expected an array", nameOf(value.item().kind)));
    return value;
}

JsonValue JsonValue::require(std::string_view key) const {
    const JsonValue value = find(key);
    if (!value) fail(fmt::format("\"{}\" is missing", key));
    return value;
}

std::size_t JsonValue::size() const { return tree_ ? item().count : 0; }

JsonValue JsonValue::operator[](std::size_t i) const { return {tree_, tree_->children_[item().first + i]}; }

std::string_view JsonValue::key(std::size_t i) const {
    return tree_->keys_[tree_->items_[tree_->children_[item().first + i]].place];
}

bool JsonValue::boolean(std::string_view key, bool fallback) const {
    const JsonValue value = find(key);
    if (!value) return fallback;
    if (value.item().kind != JsonTree::Kind::boolean)
        value.fail(fmt::format("{}, expected true or false", nameOf(value.item().kind)));
    return value.item().number != 0;
}

float JsonValue::asReal() const {
    if (item().kind != JsonTree::Kind::number) fail(fmt::format("{}, expected a number", nameOf(item().kind)));
    const double value = item().number;
    // Compared as doubles: converting a larger double to float is undefined.
    if (!(std::abs(value) <= 3.4e38)) fail(fmt::format("{:g} is too large", value));
    return float(value);
}

float JsonValue::real(std::string_view key, float fallback) const {
    const JsonValue value = find(key);
    return value ? value.asReal() : fallback;
}

std::size_t JsonValue::asWhole() const {
    if (item().kind != JsonTree::Kind::number) fail(fmt::format("{}, expected a whole number", nameOf(item().kind)));
    const double value = item().number;
    if (!(value >= 0 && value <= 9007199254740992.0) || value != std::floor(value))
        fail(fmt::format("{:g}, expected a whole number from 0", value));
    return std::size_t(value);
}

std::size_t JsonValue::whole(std::string_view key, std::size_t fallback) const {
    const JsonValue value = find(key);
    return value ? value.asWhole() : fallback;
}

int JsonValue::index(std::string_view key, std::size_t count) const {
    const JsonValue value = find(key);
    if (!value) return -1;
    const std::size_t index = value.asWhole();
    if (index >= count) fail(fmt::format("{} {}, but there are only {}", key, index, count));
    return int(index);
}

int JsonValue::requireIndex(std::string_view key, std::size_t count) const {
    require(key);
    return index(key, count);
}

int JsonValue::asIndex(std::size_t count, std::string_view ofWhat) const {
    const std::size_t index = asWhole();
    if (index >= count) fail(fmt::format("{} {}, but there are only {}", ofWhat, index, count));
    return int(index);
}

const std::string& JsonValue::asText() const {
    if (item().kind != JsonTree::Kind::string) fail(fmt::format("{}, expected a string", nameOf(item().kind)));
    return tree_->strings_[item().first];
}

const std::string& JsonValue::text(std::string_view key) const {
    static const std::string kEmpty;
    const JsonValue value = find(key);
    return value ? value.asText() : kEmpty;
}

void JsonValue::readReals(std::string_view key, float* out, std::size_t count) const {
    const JsonValue value = array(key);
    if (!value) return;
    if (value.size() != count) value.fail(fmt::format("{} numbers, expected {}", value.size(), count));
    for (std::size_t i = 0; i < count; ++i) out[i] = value[i].asReal();
}

}  // namespace shoal::io
