// Buffers, textures, framebuffers, samplers, vertex arrays: what goes in comes out, and every byte is counted.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <numeric>

#include <shoal/gl/objects.h>

#include "support/gl_device.h"

namespace shoal::gl {
namespace {

template <class T>
std::span<std::byte> writable(std::vector<T>& v) {
    return std::as_writable_bytes(std::span(v));
}

class GlObjects : public test::GlTest {};

TEST_F(GlObjects, BufferGivesBackWhatWasWritten) {
    std::vector<std::uint32_t> data(1000);
    std::iota(data.begin(), data.end(), 7u);
    Buffer buffer = Buffer::of(device(), std::span<const std::uint32_t>(data), "data");
    EXPECT_EQ(buffer.bytes(), 4000u);
    EXPECT_EQ(device().liveBytes(), 4000);
    std::vector<std::uint32_t> got(1000);
    buffer.read(0, writable(got));
    EXPECT_EQ(got, data);

    const std::uint32_t patch[] = {1, 2, 3};
    buffer.write(40, std::as_bytes(std::span(patch)));
    buffer.read(0, writable(got));
    std::copy(std::begin(patch), std::end(patch), data.begin() + 10);
    EXPECT_EQ(got, data);

    buffer.clear(0xABCD1234u);
    buffer.read(0, writable(got));
    EXPECT_EQ(got, std::vector<std::uint32_t>(1000, 0xABCD1234u));
}

TEST_F(GlObjects, MovingKeepsOneOwner) {
    Buffer a = Buffer::create(device(), 16, "a");
    const std::uint32_t name = a.name();
    Buffer b = std::move(a);
    EXPECT_EQ(b.name(), name);
    EXPECT_FALSE(a);
    EXPECT_EQ(device().liveObjectCount(), 1);
    {
        Buffer c = Buffer::create(device(), 32, "c");
        b = std::move(c);  // the old b goes with c
    }
    EXPECT_FALSE(glIsBuffer(name));
    EXPECT_EQ(device().liveObjectCount(), 1);
    EXPECT_EQ(device().liveBytes(), 32);
}

TEST_F(GlObjects, TextureGivesBackEveryFormat) {
    struct Case {
        GLenum internal, format, type;
        std::int64_t texelBytes;
    };
    const Case cases[] = {{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
                          {GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1},
                          {GL_RG16F, GL_RG, GL_HALF_FLOAT, 4},
                          {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16},
                          {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4},
                          {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4}};
    for (const Case& c : cases) {
        Texture t = Texture::create(device(), {.format = c.internal, .width = 5, .height = 3, .label = "round trip"});
        ASSERT_TRUE(t);
        EXPECT_EQ(device().liveBytes(), 15 * c.texelBytes);
        std::vector<std::byte> in(std::size_t(15 * c.texelBytes)), out(in.size());
        if (c.type == GL_FLOAT)
            for (std::size_t i = 0; i < in.size() / 4; ++i) reinterpret_cast<float*>(in.data())[i] = float(i) / 64;
        else
            for (std::size_t i = 0; i < in.size(); ++i) in[i] = std::byte(i % 60);  // no half is a NaN then
        t.upload(0, 0, c.format, c.type, in.data());
        t.read(c.format, c.type, out);
        EXPECT_EQ(in, out) << std::hex << c.internal;
    }
}

TEST_F(GlObjects, TransfersIgnoreAHostsPixelStore) {
    Texture t = Texture::create(device(), {.width = 3, .height = 2, .label = "tight"});
    std::vector<std::uint32_t> in = {1, 2, 3, 4, 5, 6}, out(6);
    const Buffer pixels = Buffer::create(device(), 4096, "a host's pixel buffer");
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 17);
    glPixelStorei(GL_PACK_SKIP_ROWS, 1);
    glPixelStorei(GL_PACK_SWAP_BYTES, GL_TRUE);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, pixels.name());
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, pixels.name());
    t.upload(0, 0, GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV, in.data());
    t.read(GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV, writable(out));
    EXPECT_EQ(in, out);
    GLint rowLength = 0, bound = 0;
    glGetIntegerv(GL_UNPACK_ROW_LENGTH, &rowLength);
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &bound);
    EXPECT_EQ(rowLength, 17);
    EXPECT_EQ(bound, GLint(pixels.name()));
}

TEST_F(GlObjects, LayersAndLevelsAreSeparate) {
    for (GLenum target : {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_CUBE_MAP_ARRAY}) {
        const int layers = target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_3D ? 4 : 6;
        Texture t = Texture::create(device(), {.target = target,
                                               .format = GL_R32UI,
                                               .width = 8,
                                               .height = 8,
                                               .layers = layers,
                                               .levels = 2,
                                               .label = "layers"});
        ASSERT_TRUE(t);
        const std::uint32_t minusOne = ~0u;
        t.clear(GL_RED_INTEGER, GL_UNSIGNED_INT, &minusOne);
        std::vector<std::uint32_t> want;
        for (int layer = 0; layer < layers; ++layer) {
            const std::vector<std::uint32_t> texels(64, std::uint32_t(layer));
            if (layer != 1) t.upload(0, layer, GL_RED_INTEGER, GL_UNSIGNED_INT, texels.data());
            want.insert(want.end(), 64, layer == 1 ? minusOne : std::uint32_t(layer));
        }
        const std::vector<std::uint32_t> other(std::size_t(16 * layers), 99);
        t.upload(1, -1, GL_RED_INTEGER, GL_UNSIGNED_INT, other.data());
        std::vector<std::uint32_t> got(want.size());
        t.read(GL_RED_INTEGER, GL_UNSIGNED_INT, writable(got));
        EXPECT_EQ(got, want) << std::hex << target;
    }
}

TEST_F(GlObjects, FullMipChainsAreCountedAndFilled) {
    Texture t = Texture::create(device(), {.format = GL_R32F, .width = 8, .height = 4, .levels = 0, .label = "mips"});
    EXPECT_EQ(t.view().levels, 4);
    EXPECT_EQ(device().liveBytes(), 4 * (32 + 8 + 2 + 1));
    std::vector<float> in(32);
    std::iota(in.begin(), in.end(), 0.0f);
    t.upload(0, 0, GL_RED, GL_FLOAT, in.data());
    t.generateMipmaps();
    float top = 0;
    glGetTextureImage(t.name(), 3, GL_RED, GL_FLOAT, 4, &top);
    EXPECT_FLOAT_EQ(top, 15.5f);  // mean of 0..31
}

TEST_F(GlObjects, AnImpossibleTextureIsEmptyAndLogged) {
    expectedErrorCount = 1;
    const int tooLarge = device().capabilities().maxTextureSize + 1;
    const Texture t = Texture::create(device(), {.width = tooLarge, .height = 1, .label = "too large"});
    EXPECT_FALSE(t);
    EXPECT_TRUE(messages.contains("no storage for texture \"too large\"")) << messages.all();
    while (glGetError() != GL_NO_ERROR) {
    }
}

TEST_F(GlObjects, FramebufferDrawsIntoEveryAttachment) {
    Texture color = Texture::create(device(), {.format = GL_RGBA32F, .width = 4, .height = 4, .label = "color"});
    Texture ids = Texture::create(
        device(),
        {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32UI, .width = 4, .height = 4, .layers = 3, .label = "ids"});
    Texture depth =
        Texture::create(device(), {.format = GL_DEPTH_COMPONENT32F, .width = 4, .height = 4, .label = "depth"});
    const std::uint32_t none = 0;
    ids.clear(GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    const Framebuffer::Attachment colors[] = {{color, 0, -1}, {ids, 0, 2}};
    auto target = Framebuffer::create(device(), colors, {depth, 0, -1}, "target");
    ASSERT_TRUE(target) << target.error().message;
    EXPECT_EQ(target->width(), 4);
    EXPECT_EQ(target->height(), 4);
    setKnownState();
    target->bind();
    const float red[] = {1, 0, 0, 1}, half = 0.5f;
    const GLuint seven[] = {7, 0, 0, 0};
    glClearBufferfv(GL_COLOR, 0, red);
    glClearBufferuiv(GL_COLOR, 1, seven);
    glClearBufferfv(GL_DEPTH, 0, &half);
    std::vector<float> gotColor(64), gotDepth(16);
    std::vector<std::uint32_t> gotIds(48), wantIds(48, 0);
    std::fill(wantIds.begin() + 32, wantIds.end(), 7u);  // layer 2 only
    color.read(GL_RGBA, GL_FLOAT, writable(gotColor));
    ids.read(GL_RED_INTEGER, GL_UNSIGNED_INT, writable(gotIds));
    depth.read(GL_DEPTH_COMPONENT, GL_FLOAT, writable(gotDepth));
    EXPECT_EQ(gotColor[60], 1.0f);
    EXPECT_EQ(gotColor[61], 0.0f);
    EXPECT_EQ(gotIds, wantIds);
    EXPECT_EQ(gotDepth, std::vector<float>(16, 0.5f));
    GLint viewport[4] = {};
    glGetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_EQ(viewport[2], 4);
}

TEST_F(GlObjects, AnIncompleteFramebufferIsAnError) {
    const auto nothing = Framebuffer::create(device(), {}, {}, "nothing");
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().message, "framebuffer \"nothing\": no attachments");
    Texture plain = Texture::create(device(), {.width = 4, .height = 4, .label = "plain"});
    Texture array = Texture::create(
        device(), {.target = GL_TEXTURE_2D_ARRAY, .width = 4, .height = 4, .layers = 2, .label = "array"});
    const Framebuffer::Attachment mixed[] = {{plain, 0, -1}, {array, 0, -1}};
    const auto target = Framebuffer::create(device(), mixed, {}, "mixed");
    ASSERT_FALSE(target);
    EXPECT_NE(target.error().message.find("framebuffer \"mixed\" cannot be drawn to"), std::string::npos)
        << target.error().message;
}

TEST_F(GlObjects, EveryKindIsCountedAndDeleted) {
    {
        const Buffer buffer = Buffer::create(device(), 256, "buffer");
        const Texture texture = Texture::create(device(), {.width = 2, .height = 2, .label = "texture"});
        const Sampler sampler =
            Sampler::create(device(), GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT, GL_REPEAT, 64, true);
        const VertexAttribute attributes[] = {{.location = 0, .buffer = 0, .componentCount = 3}};
        VertexArray array = VertexArray::create(device(), attributes, "array");
        array.setBuffer(0, buffer.view(), 12);
        array.setIndices(buffer.view());
        EXPECT_EQ(device().liveObjectCount(), 4);
        EXPECT_EQ(device().liveBytes(), 256 + 16);
        GLfloat anisotropy = 0;
        if (device().capabilities().anisotropicFiltering) {
            glGetSamplerParameterfv(sampler.name(), GL_TEXTURE_MAX_ANISOTROPY_EXT, &anisotropy);
            EXPECT_EQ(anisotropy, device().capabilities().maxAnisotropy);
        }
    }
    EXPECT_EQ(device().liveObjectCount(), 0);
    EXPECT_EQ(device().liveBytes(), 0);
}

TEST(GlObjectsDeath, WrongUseAsserts) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(
        {
            auto device = Device::create({.device = "auto", .log = {}, .shaderDir = ""});
            Buffer buffer = Buffer::create(**device, 16, "small");
            const std::byte data[17] = {};
            buffer.write(0, data);
        },
        "left 17, right 16");
    EXPECT_DEATH(
        {
            auto device = Device::create({.device = "auto", .log = {}, .shaderDir = ""});
            auto other = Device::create({.device = "auto", .log = {}, .shaderDir = ""});
            Buffer::create(**device, 16, "foreign");
        },
        "is not current on this thread");
}

}  // namespace
}  // namespace shoal::gl
