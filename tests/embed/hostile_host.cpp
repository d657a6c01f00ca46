// Shoal in somebody else's context: the host's state does not change the picture, and the host gets its state back.
#include "embed/hostile_host.h"

#include <gtest/gtest.h>

#include <array>

#include <shoal/gl/objects.h>
#include <shoal/gl/program.h>
#include <shoal/gl/timer.h>

#include "embed/gl_state_snapshot.h"
#include "support/gl_device.h"
#include "support/shader_folder.h"

namespace shoal::gl {
namespace {

using test::difference;
using test::HostileHost;
using test::takeSnapshot;

constexpr int kSize = 32;

void writeShaders(const test::ShaderFolder& folder) {
    folder.write("t/shaders/tri.vert", R"(#version 450 core
layout(location = 0) in vec2 position;
layout(location = 0) out vec2 at;
void main() { at = position * 0.5 + 0.5; gl_Position = vec4(position * 0.8, 0.5, 1.0); }
)");
    folder.write("t/shaders/tri.frag", R"(#version 450 core
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) in vec2 at;
layout(location = 0) out vec4 color;
void main() { color = texture(picture, at * 3.0); }
)");
    folder.write("t/shaders/invert.comp", R"(#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba8) uniform image2D picture;
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    imageStore(picture, p, vec4(1) - imageLoad(picture, p));
}
)");
}

using Picture = std::array<std::uint32_t, kSize * kSize>;

// What a small renderer does: upload, clear, draw a textured quad, run a compute pass over it, read.
Picture draw(Device& device, bool startKnown) {
    Texture texture = Texture::create(device, {.width = 4,
                                               .height = 4,
                                               .minFilter = GL_LINEAR,
                                               .magFilter = GL_LINEAR,
                                               .wrap = GL_REPEAT,
                                               .label = "texture"});
    std::array<std::uint32_t, 16> texels{};
    for (std::uint32_t i = 0; i < 16; ++i) texels[i] = 0xFF000000u | (i * 0x0F0A05u);
    texture.upload(0, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    Texture color = Texture::create(device, {.width = kSize, .height = kSize, .label = "color"});
    Texture depth =
        Texture::create(device, {.format = GL_DEPTH_COMPONENT32F, .width = kSize, .height = kSize, .label = "depth"});
    const Framebuffer::Attachment colors[] = {{color, 0, -1}};
    const auto target = Framebuffer::create(device, colors, {depth, 0, -1}, "target");
    const float corners[] = {-1, -1, 1, -1, 1, 1, -1, 1};
    const std::uint32_t order[] = {0, 1, 2, 0, 2, 3};
    const Buffer vertices = Buffer::of(device, std::span<const float>(corners), "vertices");
    const Buffer indices = Buffer::of(device, std::span<const std::uint32_t>(order), "indices");
    const VertexAttribute attributes[] = {{.location = 0, .buffer = 0, .componentCount = 2}};
    VertexArray array = VertexArray::create(device, attributes, "quad");
    array.setBuffer(0, vertices.view(), 8);
    array.setIndices(indices.view());
    const auto program = device.programs().get({{"t/tri.vert", "t/tri.frag"}, {}, "quad"});
    const auto invert = device.programs().get({{"t/invert.comp"}, {}, "invert"});
    EXPECT_TRUE(target && program && invert);

    const PassScope scope(nullptr, "host test");
    if (startKnown) setKnownState();
    target->bind();
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    (*program)->use();
    texture.bind(0);
    array.bind();
    glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, nullptr);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    color.bindImage(0, GL_READ_WRITE);
    (*invert)->dispatch(kSize, kSize);
    Picture out{};
    color.read(GL_RGBA, GL_UNSIGNED_BYTE, std::as_writable_bytes(std::span(out)));
    return out;
}

class HostileHostTest : public test::GlTest {
protected:
    void SetUp() override {
        writeShaders(folder);
        open(folder.path());
    }
    test::ShaderFolder folder;
};

TEST_F(HostileHostTest, StateDoesNotChangeThePicture) {
    const Picture clean = draw(device(), true);
    EXPECT_NE(clean[kSize * kSize / 2 + kSize / 2], clean[0]) << "something is drawn";
    const HostileHost host;
    host.mess();
    EXPECT_EQ(draw(device(), true), clean);
    host.mess();
    EXPECT_NE(draw(device(), false), clean) << "negative control: without setKnownState() the host's state shows";
    setKnownState();
}

TEST_F(HostileHostTest, GuardGivesBackEverything) {
    const HostileHost host;
    host.mess();
    const auto before = takeSnapshot();
    {
        const StateGuard guard;
        draw(device(), true);
        EXPECT_GT(difference(before, takeSnapshot()).size(), 1000u) << "negative control: drawing changes the state";
    }
    EXPECT_EQ(difference(before, takeSnapshot()), "");
    setKnownState();
}

TEST_F(HostileHostTest, GuardGivesBackAFreshContextsStateToo) {
    const auto before = takeSnapshot();
    {
        const StateGuard guard;
        const HostileHost host;
        host.mess();
        glBindBuffer(GL_ARRAY_BUFFER, 0);  // what no pass of Shoal's touches, and no guard saves
        glBindBuffer(GL_COPY_READ_BUFFER, 0);
        glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
    }
    EXPECT_EQ(difference(before, takeSnapshot()), "");
}

TEST_F(HostileHostTest, MakingObjectsAndProgramsNeedsNoGuard) {
    const HostileHost host;
    host.mess();
    const auto before = takeSnapshot();
    {
        Texture t = Texture::create(device(), {.width = 4, .height = 4, .levels = 0, .label = "texture"});
        const std::array<std::uint32_t, 16> texels{};
        t.upload(0, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
        t.generateMipmaps();
        Buffer b = Buffer::create(device(), 64, "buffer");
        b.clear(1);
        const Sampler s = Sampler::create(device(), GL_LINEAR, GL_LINEAR, GL_REPEAT, GL_REPEAT);
        ASSERT_TRUE(device().programs().get({{"t/tri.vert", "t/tri.frag"}, {}, "quad"}));
    }
    EXPECT_EQ(difference(before, takeSnapshot()), "");
}

TEST_F(HostileHostTest, ADeviceOfTheHostsContextLeavesNoNamesBehind) {
    auto names = [] {
        std::array<int, 6> counts{};
        for (GLuint i = 1; i < 1000; ++i) {
            counts[0] += glIsBuffer(i), counts[1] += glIsTexture(i), counts[2] += glIsProgram(i),
                counts[3] += glIsFramebuffer(i);
            counts[4] += glIsVertexArray(i), counts[5] += glIsShader(i);
        }
        return counts;
    };
    const auto before = names();
    GLint depthBefore = 0, depthAfter = 0;
    glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depthBefore);
    void *callback = nullptr, *callbackAfter = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
    {
        auto guest =
            Device::fromCurrentContext({.device = "auto", .log = {}, .debug = true, .shaderDir = folder.path()});
        ASSERT_TRUE(guest) << guest.error().message;
        EXPECT_EQ((*guest)->info().name, "host");
        EXPECT_TRUE((*guest)->makeCurrent());
        const StateGuard guard;
        const Picture picture = draw(**guest, true);
        EXPECT_EQ(picture, draw(device(), true)) << "the same picture through either device";
        EXPECT_GT(names()[2], before[2]) << "negative control: programs of the guest exist while it does";
        EXPECT_EQ((*guest)->debugErrorCount(), 0);
        EXPECT_EQ((*guest)->liveBytes(), 0);
    }
    glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depthAfter);
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callbackAfter);
    EXPECT_EQ(depthAfter, depthBefore);
    EXPECT_EQ(callbackAfter, callback) << "the host's message callback is back";
    auto after = names();
    after[2] -= int(device().programs().size());  // of this test's own device
    EXPECT_EQ(after, before);
}

TEST_F(HostileHostTest, TwoDevicesInOneProcessTakeTurns) {
    auto second = Device::create({.device = "auto", .log = messages.sink(), .debug = true, .shaderDir = folder.path()});
    ASSERT_TRUE(second) << second.error().message;
    Device* const devices[] = {device_.get(), second->get()};
    ASSERT_TRUE(devices[0]->makeCurrent());
    const Picture expected = draw(*devices[0], true);
    Buffer kept[2];
    for (int turn = 0; turn < 6; ++turn) {
        Device& current = *devices[turn % 2];
        ASSERT_TRUE(current.makeCurrent());
        EXPECT_EQ(draw(current, true), expected) << "turn " << turn;
        kept[turn % 2] = Buffer::create(current, 64, "kept");
        EXPECT_EQ(current.liveBytes(), 64);
    }
    ASSERT_TRUE(devices[0]->makeCurrent());
    kept[1] = Buffer();  // deleted in its own context, not in the current one
    EXPECT_TRUE(glIsBuffer(kept[0].name()));
    EXPECT_EQ(devices[1]->liveBytes(), 0);
    EXPECT_EQ(devices[1]->debugErrorCount(), 0) << messages.all();
    second->reset();
    EXPECT_EQ(draw(*devices[0], true), expected) << "the first is untouched by the second's end";
    kept[0] = Buffer();
}

}  // namespace
}  // namespace shoal::gl
