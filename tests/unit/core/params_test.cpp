// Parameters: every type from words, ranges, what the errors say, nearest words, and the table for --help.
#include <shoal/core/params.h>
#include <limits>

#include <gtest/gtest.h>

namespace shoal {
namespace {

struct CameraParams {
    float fovDeg = 60;
    int steps = 8;
    std::uint32_t seed = 1;
    bool shadows = true;
    Vec2 offset{0, 0};
    Vec3 albedo{0.5f, 0.5f, 0.5f};
    Vec4 rect{0, 0, 1, 1};
    std::string tone = "agx";
    std::string title = "untitled";
    float nearM = 0.1f;
};

template <class Params, class Visitor>
void visit(Params& p, Visitor&& v) {
    v(p.fovDeg, Field{"fovDeg", "deg", 1, 179, "vertical field of view"});
    v(p.steps, Field{"steps", "", 1, 64, "steps"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "seed"});
    v(p.shadows, Field{"shadows", "", 0, 1, "cast shadows"});
    v(p.offset, Field{"offset", "px", -1e30, 1e30, "shift"});
    v(p.albedo, Field{"albedo", "", 0, 1, "colour"});
    v(p.rect, Field{"rect", "", 0, 1e30, "rectangle"});
    v(p.tone, Field{"tone", "", -1e30, 1e30, "curve", {"agx", "plain"}});
    v(p.title, Field{"title", "", -1e30, 1e30, "title"});
    v(p.nearM, Field{"nearM", "m", 0.1, 1e30, "near plane"});
}

// Sets a field from words, as --set does; "" or the error.
std::string set(CameraParams& params, std::string_view name, std::string_view words) {
    const Result<FieldValue> value = parseFieldValue(words);
    if (!value) return value.error().message;
    const Result<void> result = setField(params, name, *value);
    return result ? "" : result.error().message;
}

std::string set(std::string_view name, std::string_view words) {
    CameraParams params;
    return set(params, name, words);
}

TEST(Params, EveryTypeIsSetFromWords) {
    CameraParams p;
    EXPECT_EQ(set(p, "fovDeg", "45.5"), "");
    EXPECT_EQ(set(p, "steps", "64"), "");
    EXPECT_EQ(set(p, "seed", "4294967295"), "");
    EXPECT_EQ(set(p, "shadows", "false"), "");
    EXPECT_EQ(set(p, "offset", "[-1e3, +2]"), "");
    EXPECT_EQ(set(p, "albedo", " [ 0, 0.25 ,1 ] "), "");
    EXPECT_EQ(set(p, "rect", "[1,2,3,4]"), "");
    EXPECT_EQ(set(p, "tone", "plain"), "");
    EXPECT_EQ(set(p, "title", "\"a \\\"b\\\" c\""), "");
    EXPECT_EQ(p.fovDeg, 45.5f);
    EXPECT_EQ(p.steps, 64);
    EXPECT_EQ(p.seed, 4294967295u);
    EXPECT_FALSE(p.shadows);
    EXPECT_EQ(p.offset, (Vec2{-1000, 2}));
    EXPECT_EQ(p.albedo, (Vec3{0, 0.25f, 1}));
    EXPECT_EQ(p.rect, (Vec4{1, 2, 3, 4}));
    EXPECT_EQ(p.tone, "plain");
    EXPECT_EQ(p.title, "a \"b\" c");
    EXPECT_TRUE(validate(p));
}

TEST(Params, ErrorsNameFieldFoundAndExpected) {
    EXPECT_EQ(set("fovDeg", "400"), "fovDeg: found 400, expected 1 .. 179 deg");
    EXPECT_EQ(set("fovDeg", "wide"), "fovDeg: found \"wide\", expected a number, 1 .. 179 deg");
    EXPECT_EQ(set("fovDeg", "true"), "fovDeg: found true, expected a number, 1 .. 179 deg");
    EXPECT_EQ(set("fovDeg", "[1]"), "fovDeg: found [1], expected a number, 1 .. 179 deg");
    EXPECT_EQ(set("steps", "65"), "steps: found 65, expected 1 .. 64");
    EXPECT_EQ(set("shadows", "1"), "shadows: found 1, expected true or false");
    EXPECT_EQ(set("albedo", "[0, 2, 0]"), "albedo: found 2 in [0, 2, 0], expected 0 .. 1");
    EXPECT_EQ(set("albedo", "[0, 0]"), "albedo: found [0, 0], expected 3 numbers, 0 .. 1");
    EXPECT_EQ(set("albedo", "0.5"), "albedo: found 0.5, expected 3 numbers, 0 .. 1");
    EXPECT_EQ(set("rect", "[0, 0, 0, -1]"), "rect: found -1 in [0, 0, 0, -1], expected at least 0");
    EXPECT_EQ(set("nearM", "0"), "nearM: found 0, expected at least 0.1 m");
    EXPECT_EQ(set("tone", "AGX"), "tone: found \"AGX\", expected agx | plain (did you mean \"agx\"?)");
    EXPECT_EQ(set("tone", "filmic"), "tone: found \"filmic\", expected agx | plain");
}

TEST(Params, NanAndInfinityAreRefused) {
    for (const char* words : {"nan", "inf", "-inf", "1e999", "1e60"}) {  // 1e60 does not fit a float
        EXPECT_NE(set("fovDeg", words), "") << words;
        EXPECT_NE(set("offset", std::string("[0, ") + words + "]"), "") << words;
        EXPECT_NE(set("steps", words), "") << words;
    }
    EXPECT_EQ(set("fovDeg", "nan"), "fovDeg: found nan, expected 1 .. 179 deg");
    EXPECT_EQ(set("offset", "[0, nan]"), "offset: found nan in [0, nan], expected a finite number");
}

TEST(Params, InfinityIsRefusedEvenByAnInfiniteRange) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(detail::checkField(float(kInfinity), Field{"x", "m", 0, kInfinity}),
              "x: found inf, expected at least 0 m");
    EXPECT_EQ(detail::checkField(1e35f, Field{"x", "m", 0, kInfinity}), "");
}

TEST(Params, IntegersRefuseFractionsAndWhatDoesNotFit) {
    EXPECT_EQ(set("steps", "2.5"), "steps: found 2.5, expected an integer, 1 .. 64");
    EXPECT_EQ(set("steps", "2.0"), "");
    EXPECT_EQ(set("seed", "-1"), "seed: found -1, expected 0 .. 4294967295");
    EXPECT_EQ(set("seed", "4294967296"), "seed: found 4294967296, expected 0 .. 4294967295");
    int free = 0;
    EXPECT_EQ(detail::assignField(free, Field{"count"}, *parseFieldValue("3e9")).error().message,
              "count: found 3000000000, expected an integer, -2147483648 .. 2147483647");
    EXPECT_EQ(free, 0);
}

TEST(Params, AFailedSetChangesNothing) {
    CameraParams p;
    EXPECT_NE(set(p, "albedo", "[0, 0, 7]"), "");
    EXPECT_EQ(p.albedo, CameraParams{}.albedo);
}

TEST(Params, RangeEndsAreIncludedAlthoughAFloatRounds) {
    CameraParams p;
    EXPECT_EQ(set(p, "nearM", "0.1"), "");
    EXPECT_TRUE(validate(p));
    float x = 0;
    EXPECT_TRUE(detail::assignField(x, Field{"x", "", 0, 0.7}, *parseFieldValue("0.7")));  // 0.7f < 0.7
    EXPECT_EQ(detail::checkField(x, Field{"x", "", 0.7, 1}), "");
    EXPECT_NE(detail::checkField(0.69999f, Field{"x", "", 0.7, 1}), "");
}

TEST(Params, ATextFieldTakesWordsThatLookLikeNumbers) {
    CameraParams p;
    EXPECT_EQ(set(p, "title", "2026"), "");
    EXPECT_EQ(p.title, "2026");
    FieldValue fromFile;  // a TOML number has no words
    fromFile.numbers = {5};
    EXPECT_EQ(setField(p, "title", fromFile).error().message, "title: found 5, expected a text");
}

TEST(Params, UnknownKeyNamesTheNearest) {
    EXPECT_EQ(set("fovDg", "60"), "unknown key \"fovDg\" (did you mean \"fovDeg\"?)");
    EXPECT_EQ(set("FOVDEG", "60"), "unknown key \"FOVDEG\" (did you mean \"fovDeg\"?)");
}

TEST(Params, ValidateNamesTheFirstViolation) {
    CameraParams p;
    p.steps = 0;
    p.albedo.y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(validate(p).error().message, "steps: found 0, expected 1 .. 64");
    p.steps = 1;
    EXPECT_EQ(validate(p).error().message, "albedo: found nan in [0.5, nan, 0.5], expected 0 .. 1");
    p.albedo.y = 0;
    p.offset.x = std::numeric_limits<float>::infinity();  // no range, yet not finite
    EXPECT_EQ(validate(p).error().message, "offset: found inf in [inf, 0], expected a finite number");
    p.offset.x = 0;
    p.tone = "aqx";
    EXPECT_EQ(validate(p).error().message, "tone: found \"aqx\", expected agx | plain (did you mean \"agx\"?)");
    p.tone = "agx";
    EXPECT_TRUE(validate(p));
}

TEST(Params, DescribeGivesOneRowAField) {
    const std::vector<FieldRow> rows = describe(CameraParams{});
    ASSERT_EQ(rows.size(), 10u);
    EXPECT_EQ(rows[0].name, "fovDeg");
    EXPECT_EQ(rows[0].unit, "deg");
    EXPECT_EQ(rows[0].range, "1 .. 179");
    EXPECT_EQ(rows[0].value, "60");
    EXPECT_EQ(rows[0].sentence, "vertical field of view");
    EXPECT_EQ(rows[4].range, "");
    EXPECT_EQ(rows[5].value, "[0.5, 0.5, 0.5]");
    EXPECT_EQ(rows[7].range, "agx | plain");
    EXPECT_EQ(rows[9].range, "at least 0.1");
    EXPECT_EQ(rows[9].value, "0.1");
}

TEST(Params, ShownValuesReadBackToTheSame) {
    for (const float x : {0.1f, 1e-20f, 3.4e38f, -7.0f, 0.333333343f}) {
        const FieldValue value = *parseFieldValue(detail::showField(x));
        EXPECT_EQ(float(value.numbers.at(0)), x);
    }
    EXPECT_EQ(parseFieldValue(detail::showField(Vec3{1, -2.5f, 0.1f}))->numbers.size(), 3u);
}

TEST(ParseFieldValue, TellsTheKind) {
    using Kind = FieldValue::Kind;
    EXPECT_EQ(parseFieldValue("3.5")->kind, Kind::number);
    EXPECT_EQ(parseFieldValue("-1e-3")->numbers, std::vector<double>{-1e-3});
    EXPECT_EQ(parseFieldValue("+5")->numbers, std::vector<double>{5});
    EXPECT_EQ(parseFieldValue("[1, 2, 3]")->numbers, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(parseFieldValue("[]")->kind, Kind::numbers);
    EXPECT_EQ(parseFieldValue("true")->kind, Kind::boolean);
    EXPECT_TRUE(parseFieldValue("true")->boolean);
    EXPECT_FALSE(parseFieldValue("false")->boolean);
    for (const char* words : {"agx", "\"agx\"", "'agx'", "  agx "}) {
        EXPECT_EQ(parseFieldValue(words)->kind, Kind::text) << words;
        EXPECT_EQ(parseFieldValue(words)->text, "agx") << words;
    }
    EXPECT_EQ(parseFieldValue("\"true\"")->kind, Kind::text);
    EXPECT_EQ(parseFieldValue("\"\"")->text, "");
    EXPECT_EQ(parseFieldValue("3.5m")->kind, Kind::text);
    EXPECT_EQ(parseFieldValue("+-5")->kind, Kind::text);
}

TEST(ParseFieldValue, ErrorsSayWhatIsWrong) {
    EXPECT_EQ(parseFieldValue(" ").error().message, "found nothing, expected a value");
    EXPECT_EQ(parseFieldValue("[1, 2").error().message, "found \"[1, 2\", expected a list of numbers that ends in ]");
    EXPECT_EQ(parseFieldValue("[").error().message, "found \"[\", expected a list of numbers that ends in ]");
    EXPECT_EQ(parseFieldValue("[1, x]").error().message, "found \"x\" in \"[1, x]\", expected a number");
    EXPECT_EQ(parseFieldValue("[1,,2]").error().message, "found \"\" in \"[1,,2]\", expected a number");
    EXPECT_EQ(parseFieldValue("\"open").error().message, "found \"\"open\", expected one text in quotes");
    EXPECT_EQ(parseFieldValue("\"a\" b").error().message, "found \"\"a\" b\", expected one text in quotes");
}

TEST(ParseFieldValue, ErrorsStayOneShortLine) {
    const std::string message = parseFieldValue("[\n\x01" + std::string(5000, 'x')).error().message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_NE(message.find("\\x0a\\x01"), std::string::npos);
    EXPECT_LT(message.size(), 200u);
}

const std::vector<std::string> kVerbs{"render", "info", "compare", "demo", "bench"};

TEST(NearestWord, FindsTyposOfAllFourKinds) {
    EXPECT_EQ(nearestWord("rendr", kVerbs), "render");    // a letter missing
    EXPECT_EQ(nearestWord("rennder", kVerbs), "render");  // one too many
    EXPECT_EQ(nearestWord("remder", kVerbs), "render");   // another one
    EXPECT_EQ(nearestWord("erndre", kVerbs), "render");   // neighbours swapped, twice
    EXPECT_EQ(nearestWord("COMPAER", kVerbs), "compare");
}

TEST(NearestWord, ASwapCountsOnce) { EXPECT_EQ(nearestWord("ba", {"cd", "bcd", "ab"}), "ab"); }

TEST(NearestWord, CaseIsIgnoredBeforeLettersAreChanged) { EXPECT_EQ(nearestWord("FOV", {"foo", "fov"}), "fov"); }

TEST(NearestWord, NothingIsNearWhenTooManyLettersDiffer) {
    EXPECT_EQ(nearestWord("photograph", kVerbs), "");
    EXPECT_EQ(nearestWord("x", kVerbs), "");
    EXPECT_EQ(nearestWord("", kVerbs), "");
    EXPECT_EQ(nearestWord("render", {}), "");
    EXPECT_EQ(nearestWord("ab", {"cd"}), "");                         // nothing in common
    EXPECT_EQ(nearestWord("abcdefghi", {"abcdefxyz"}), "abcdefxyz");  // three of nine: a third
    EXPECT_EQ(nearestWord("abcdefghi", {"abcdewxyz"}), "");           // four of nine
    EXPECT_EQ(nearestWord(std::string(1000000, 'x'), kVerbs), "");    // at once
}

TEST(UnknownWord, NamesTheNearestOrLists) {
    EXPECT_EQ(unknownWord("verb", "rendr", kVerbs), "unknown verb \"rendr\" (did you mean \"render\"?)");
    EXPECT_EQ(unknownWord("verb", "photograph", kVerbs),
              "unknown verb \"photograph\", known: render, info, compare, demo, bench");
    EXPECT_EQ(unknownWord("option", "--x", {}), "unknown option \"--x\"");
}

}  // namespace
}  // namespace shoal
