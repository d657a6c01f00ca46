// Devices: choosing, information, several at once, objects that outlive theirs.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <optional>

#include <shoal/gl/objects.h>

#include "support/gl_device.h"

namespace shoal::gl {
namespace {

using test::GlTest;
using test::Messages;

class GlDevice : public GlTest {};

TEST_F(GlDevice, SaysWhatItIs) {
    const DeviceInfo& info = device().info();
    EXPECT_FALSE(info.name.empty());
    EXPECT_FALSE(info.renderer.empty());
    EXPECT_FALSE(info.vendor.empty());
    EXPECT_NE(info.version.find("4."), std::string::npos) << info.version;
    EXPECT_TRUE(info.problem.empty());
    const Capabilities& can =
        device().capabilities();  // minimums of the OpenGL 4.5 specification, tables 23.53 to 23.66
    EXPECT_GE(can.maxTextureSize, 16384);
    EXPECT_GE(can.maxSamples, 4);
    EXPECT_GE(can.maxStorageBlockBytes, 1 << 24);
    EXPECT_GE(can.maxComputeSharedBytes, 32768);
    EXPECT_GE(can.maxAnisotropy, can.anisotropicFiltering ? 2.0f : 1.0f);
}

TEST_F(GlDevice, ReportsAnErrorToTheLogAndCountsIt) {
    expectedErrorCount = 1;
    glEnable(0xDEAD);
    EXPECT_EQ(device().debugErrorCount(), 1);
    EXPECT_TRUE(messages.contains("error: OpenGL:")) << messages.all();
    while (glGetError() != GL_NO_ERROR) {
    }
}

TEST_F(GlDevice, IsChosenByNameAndByPartOfTheRenderer) {
    const DeviceInfo info = device().info();
    for (const std::string& wanted : {info.name, info.renderer.substr(1, 6)}) {
        auto other = Device::create({.device = wanted, .log = {}, .shaderDir = ""});
        ASSERT_TRUE(other) << wanted << ": " << other.error().message;
        EXPECT_EQ((*other)->info().renderer, info.renderer);
    }
    ASSERT_TRUE(device().makeCurrent());
}

TEST_F(GlDevice, ListsItself) {
    bool found = false;
    for (const DeviceInfo& info : listDevices()) {
        found = found || (info.name == device().info().name && info.renderer == device().info().renderer);
        EXPECT_EQ(info.version.empty(), !info.problem.empty()) << info.name << ": " << info.problem;
    }
    EXPECT_TRUE(found);
    GLint probe = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &probe);  // the context that was current is so still
    EXPECT_EQ(probe, 4);
}

TEST(GlDeviceChoice, UnknownNamesSayWhatWasTried) {
    const auto device = Device::create({.device = "no such renderer", .log = {}, .shaderDir = ""});
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().kind, ErrorKind::noDevice);
    EXPECT_NE(device.error().message.find("\"no such renderer\""), std::string::npos) << device.error().message;
    for (const DeviceInfo& info : listDevices())
        EXPECT_NE(device.error().message.find(info.name + ":"), std::string::npos) << device.error().message;
    EXPECT_EQ(device.error().message.find('\n'), std::string::npos);
}

TEST(GlDeviceChoice, GpuAndCpuGiveOnlyTheirKind) {
    for (const auto& [wanted, software] : {std::pair("gpu", false), std::pair("cpu", true)}) {
        const auto device = Device::create({.device = wanted, .log = {}, .shaderDir = ""});
        if (device) {
            EXPECT_EQ((*device)->software(), software) << wanted;
        } else {
            EXPECT_EQ(device.error().kind, ErrorKind::noDevice) << wanted;
        }
    }
}

TEST(GlDeviceChoice, WithoutADebugContextErrorsAreCountedToo) {
    auto device = Device::create({.device = "auto", .log = {}, .shaderDir = ""});
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ((*device)->debugErrorCount(), 0);
    glEnable(0xDEAD);
    EXPECT_EQ((*device)->debugErrorCount(), 1);
}

TEST(GlDeviceChoice, NoContextIsNoDevice) {
    const auto device = Device::fromCurrentContext({});
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().kind, ErrorKind::noDevice);
}

TEST(GlDeviceLife, ObjectsThatOutliveTheirDeviceAreHarmlessAndLogged) {
    Messages messages;
    std::optional<Buffer> buffer;
    Texture texture;
    {
        auto device = Device::create({.device = "auto", .log = messages.sink(), .debug = true, .shaderDir = ""});
        ASSERT_TRUE(device) << device.error().message;
        buffer = Buffer::create(**device, 64, "outlives");
        texture = Texture::create(**device, {.width = 4, .height = 4});
    }
    EXPECT_TRUE(messages.contains("2 OpenGL objects (128 bytes) outlive")) << messages.all();
    // A new device may have the same address and the same names: what is left of the old one must not touch them.
    auto device = Device::create({.device = "auto", .log = {}, .shaderDir = ""});
    ASSERT_TRUE(device);
    const Buffer other = Buffer::create(**device, 64, "other");
    buffer.reset();
    texture = Texture();
    EXPECT_TRUE(glIsBuffer(other.name()));
    EXPECT_EQ((*device)->liveObjectCount(), 1);
    EXPECT_EQ((*device)->liveBytes(), 64);
}

}  // namespace
}  // namespace shoal::gl
