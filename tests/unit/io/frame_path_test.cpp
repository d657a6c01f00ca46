#include <gtest/gtest.h>

#include <shoal/io/image.h>

namespace shoal::io {
namespace {

std::string pathOf(const std::string& pattern, int frame) {
    const auto path = framePath(pattern, frame);
    return path ? path->string() : "error: " + path.error().message;
}

TEST(FramePath, PutsTheNumberWhereItIsAskedFor) {
    EXPECT_EQ(pathOf("out/f.exr", 7), "out/f_0007.exr");
    EXPECT_EQ(pathOf("out/f_####.png", 7), "out/f_0007.png");
    EXPECT_EQ(pathOf("out/#.png", 123), "out/123.png");
    EXPECT_EQ(pathOf("out/f%04d.png", 7), "out/f0007.png");
    EXPECT_EQ(pathOf("out/f%d.png", 7), "out/f7.png");
    EXPECT_EQ(pathOf("f%06d", 7), "f000007");
    EXPECT_EQ(pathOf("f", 12345), "f_12345");
    EXPECT_EQ(pathOf("50%%_%02d.png", 7), "50%_07.png");
    EXPECT_EQ(pathOf("50%%.png", 7), "50%_0007.png");
    EXPECT_EQ(pathOf("a%d#1/f.png", 7), "a%d#1/f_0007.png");  // a folder's name is left alone
    EXPECT_EQ(pathOf("v1.2/f.left.png", 0), "v1.2/f.left_0000.png");
    EXPECT_TRUE(hasFramePlaceholder("a/f_#.png"));
    EXPECT_TRUE(hasFramePlaceholder("a/f_%d.png"));
    EXPECT_FALSE(hasFramePlaceholder("a%d/f.png"));
}

TEST(FramePath, RefusesPatternsThatMeanNothing) {
    for (const char* bad : {"f%04d_##.png", "f_#_#.png", "f%d%d.png", "f%s.png", "f%4d.png", "f%", "f%04.png",
                            "f%x.png", "f%099999999999d.png", "f%n.png", "f_################.png", "out/", ""})
        EXPECT_FALSE(framePath(bad, 1)) << bad;
    EXPECT_FALSE(framePath("f.png", -1));
    EXPECT_NE(pathOf("f%s.png", 1).find("%s"), std::string::npos);
}

}  // namespace
}  // namespace shoal::io
