#include <gtest/gtest.h>

#include "frame/fullscreen.h"

namespace shoal::frame {
namespace {

TEST(DefinesOf, NamesTheBitsThatAreSetInOrder) {
    const char* const names[] = {"A", "B", "C"};
    using Defines = std::vector<std::pair<std::string, std::string>>;
    EXPECT_EQ(definesOf(0, names), Defines{});
    EXPECT_EQ(definesOf(1, names), (Defines{{"A", "1"}}));
    EXPECT_EQ(definesOf(6, names), (Defines{{"B", "1"}, {"C", "1"}}));
    EXPECT_EQ(definesOf(8 + 4, names), (Defines{{"C", "1"}}));  // bits without a name are nothing
}

}  // namespace
}  // namespace shoal::frame
