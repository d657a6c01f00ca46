#include <gtest/gtest.h>

#include <shoal/core/model.h>

namespace shoal {
namespace {

TEST(MatchesAny, TakesWholeNamesAndBeginningsThatEndInAStar) {
    const std::vector<std::string> patterns = {"hull", "mast_*", ""};
    EXPECT_TRUE(matchesAny(patterns, "hull"));
    EXPECT_FALSE(matchesAny(patterns, "hull2"));
    EXPECT_FALSE(matchesAny(patterns, "hul"));
    EXPECT_TRUE(matchesAny(patterns, "mast_1"));
    EXPECT_TRUE(matchesAny(patterns, "mast_"));
    EXPECT_FALSE(matchesAny(patterns, "mast"));
    EXPECT_FALSE(matchesAny(patterns, "the mast_1"));
    EXPECT_TRUE(matchesAny(patterns, ""));  // by the empty name, not by a star
}

TEST(MatchesAny, AStarAloneTakesAllAndNoPatternTakesNothing) {
    const std::vector<std::string> all = {"*"};
    EXPECT_TRUE(matchesAny(all, ""));
    EXPECT_TRUE(matchesAny(all, "anything*"));
    EXPECT_FALSE(matchesAny({}, ""));
    EXPECT_FALSE(matchesAny({}, "*"));
}

}  // namespace
}  // namespace shoal
