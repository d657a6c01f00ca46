// Result and the assertions: values, errors and what a programmer's mistake prints.
#include <shoal/core/result.h>
#include <memory>

#include <gtest/gtest.h>

namespace shoal {
namespace {

Result<int> half(int n) {
    if (n % 2 != 0) return badInput("n: found " + std::to_string(n) + ", expected an even number");
    return n / 2;
}

Result<int> quarter(int n) {
    SHOAL_TRY_ASSIGN(const int h, half(n));
    SHOAL_TRY_ASSIGN(const int q, half(h));
    return q;
}

Result<void> checkQuarter(int n) {
    SHOAL_TRY(quarter(n));
    return {};
}

TEST(Result, HoldsAValue) {
    const Result<int> r = half(8);
    ASSERT_TRUE(r);
    EXPECT_EQ(*r, 4);
}

TEST(Result, HoldsAnError) {
    const Result<int> r = half(3);
    ASSERT_FALSE(r);
    EXPECT_EQ(r.error().kind, ErrorKind::badInput);
    EXPECT_EQ(r.error().message, "n: found 3, expected an even number");
}

TEST(Result, TryPassesTheFirstErrorOn) {
    EXPECT_EQ(*quarter(12), 3);
    EXPECT_EQ(quarter(6).error().message, "n: found 3, expected an even number");
    EXPECT_TRUE(checkQuarter(4));
    EXPECT_EQ(checkQuarter(5).error().message, "n: found 5, expected an even number");
}

TEST(Result, CarriesMoveOnlyValues) {
    Result<std::unique_ptr<int>> r = std::make_unique<int>(7);
    const std::unique_ptr<int> p = *std::move(r);
    EXPECT_EQ(*p, 7);
}

TEST(ResultDeathTest, ValueOfAFailedResultPrintsItsMessage) {
    EXPECT_DEATH(half(3).value(), "found 3, expected an even number");
    EXPECT_DEATH(checkQuarter(5).value(), "found 5, expected an even number");
}

TEST(ResultDeathTest, ErrorOfASuccessAsserts) {
    EXPECT_DEATH((void)half(2).error(), "assertion failed: has_value\\(\\)|has_value");
}

TEST(AssertDeathTest, PrintsFileExpressionAndOperands) {
    const int count = 3;
    EXPECT_DEATH(SHOAL_ASSERT_EQ(count, 4),
                 "result_test.cpp:[0-9]+: assertion failed: count == 4 \\(left 3, right 4\\)");
    EXPECT_DEATH(SHOAL_ASSERT_LT(count, 2), "count < 2 \\(left 3, right 2\\)");
    EXPECT_DEATH(SHOAL_ASSERT(count == 1), "assertion failed: count == 1\n");
    EXPECT_DEATH(SHOAL_ASSERT_MSG(count == 1, "three people"), "count == 1 \\(three people\\)");
}

TEST(Assert, EvaluatesItsOperandsOnceAndGoesOn) {
    int calls = 0;
    const auto next = [&] { return ++calls; };
    SHOAL_ASSERT_EQ(next(), 1);
    SHOAL_ASSERT_GE(next(), 2);
    EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace shoal
