#include <shoal/io/poses.h>

#include <cmath>

#include <gtest/gtest.h>

#include <shoal/io/file.h>

#include "support/test_folder.h"

namespace shoal::io {
namespace {

using test::TestFolder;

std::string errorOf(std::string_view text) {
    const auto poses = parsePoses(text, "p.csv");
    return poses ? "" : poses.error().message;
}

TEST(Poses, ReadsBackWhatWasWritten) {
    const TestFolder folder;
    std::vector<CameraPose> poses;
    for (int i = 0; i < 20; ++i) {
        const Vec3 axis = normalize(Vec3{1, float(i), -2});
        poses.push_back({float(i) / 30.0f, {0.1f * float(i), 1e-9f, -1234.567f}, axisAngle(axis, 0.3f * float(i))});
    }
    ASSERT_TRUE(writePoses(folder / "p.csv", poses));
    const auto back = readPoses(folder / "p.csv");
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->size(), poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_EQ((*back)[i].time, poses[i].time);
        EXPECT_EQ((*back)[i].position, poses[i].position);
        EXPECT_EQ((*back)[i].worldFromCamera, poses[i].worldFromCamera);
    }
}

TEST(Poses, TakesColumnsInAnyOrderAndLeavesOthersAlone) {
    const auto poses =
        parsePoses("\xef\xbb\xbf# made by hand\r\n\"qw\"; qx ;name;qy;qz;z;y;x;frame\r\n\r\n1;0;walk;0;0;3;2;+1;15\r\n",
                   "p.csv", 30);
    ASSERT_TRUE(poses) << poses.error().message;
    ASSERT_EQ(poses->size(), 1u);
    EXPECT_EQ(poses->at(0).time, 0.5f);
    EXPECT_EQ(poses->at(0).position, (Vec3{1, 2, 3}));
    EXPECT_EQ(poses->at(0).worldFromCamera, (Quat{0, 0, 0, 1}));
}

TEST(Poses, LooksAtTheTarget) {
    const Vec3 targets[] = {{1, 2, -5}, {1, 2, 9},   {5, 2, 3}, {-5, 2, 3},
                            {4, 7, 1},  {-3, -2, 8}, {1, 9, 3}, {1, -9, 3}};
    std::string text = "time,x,y,z,tx,ty,tz\n";
    int row = 0;
    for (const Vec3 t : targets)
        text += std::to_string(row++) + ",1,2,3," + std::to_string(t.x) + "," + std::to_string(t.y) + "," +
                std::to_string(t.z) + "\n";
    const auto poses = parsePoses(text, "p.csv");
    ASSERT_TRUE(poses) << poses.error().message;
    for (std::size_t i = 0; i < std::size(targets); ++i) {
        const Quat q = poses->at(i).worldFromCamera;
        const Vec3 forward = rotate(q, {0, 0, -1}), expected = normalize(targets[i] - Vec3{1, 2, 3});
        const Vec3 right = rotate(q, {1, 0, 0}), up = rotate(q, {0, 1, 0});
        EXPECT_NEAR(length(forward - expected), 0, 1e-6f) << i;
        EXPECT_NEAR(right.y, 0, 1e-6f) << i;  // the horizon is level
        EXPECT_GE(up.y, -1e-6f) << i;
        EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-6f);
    }
    EXPECT_NEAR(length(rotate(poses->at(7).worldFromCamera, {0, 1, 0}) - Vec3{0, 0, -1}), 0, 1e-6f);  // straight down
}

TEST(Poses, NamesTheLineThatIsWrong) {
    const std::string header = "time,x,y,z,qx,qy,qz,qw\n", row = "0,1,2,3,0,0,0,1\n";
    EXPECT_NE(errorOf("").find("no header"), std::string::npos);
    EXPECT_NE(errorOf(header).find("no row"), std::string::npos);
    EXPECT_NE(errorOf("x,y,z,qx,qy,qz,qw\n").find("line 1: found no column \"time\""), std::string::npos);
    EXPECT_NE(errorOf("time,x,y,qx,qy,qz,qw\n").find("\"z\""), std::string::npos);
    EXPECT_NE(errorOf("time,x,y,z,qx,qy,qz\n").find("\"qw\""), std::string::npos);
    EXPECT_NE(errorOf("time,x,y,z,tx,ty\n").find("\"tz\""), std::string::npos);
    EXPECT_NE(errorOf("time,x,y,z\n").find("qx, qy, qz, qw"), std::string::npos);
    EXPECT_NE(errorOf("time,x,x,y,z,qx,qy,qz,qw\n").find("two columns"), std::string::npos);
    EXPECT_NE(errorOf(header + row + "1,1,2,3,0,0,0\n").find("p.csv: line 3: found 7 cells, expected 8"),
              std::string::npos);
    EXPECT_NE(errorOf(header + "0,1,2,3,0,0,zero,1\n").find("line 2: qz: found \"zero\""), std::string::npos);
    for (const char* number : {"nan", "inf", "1e99", "", "1.5m", "0x10", "--1"})
        EXPECT_NE(errorOf(header + "0,1," + number + ",3,0,0,0,1\n").find("y: found"), std::string::npos) << number;
    EXPECT_NE(errorOf(header + "0,1,2,3,0,0,0,2\n").find("length 2"), std::string::npos);
    EXPECT_NE(errorOf(header + row + row).find("line 3: time 0 does not increase"), std::string::npos);
    EXPECT_NE(errorOf("time,x,y,z,tx,ty,tz\n0,1,2,3,1,2,3\n").find("line 2: the target is at the camera"),
              std::string::npos);
}

}  // namespace
}  // namespace shoal::io
