#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include <shoal/core/assert.h>
#include <shoal/gl/objects.h>

#include "gl/device_state.h"
#include "gl/pixel_store.h"

namespace shoal::gl {
namespace {

// Formats of one size, in bytes per texel (per 4 x 4 block for block-compressed formats). Unused places are 0.
struct FormatSize {
    int bytes = 0;
    bool block = false;
    std::array<GLenum, 20> formats{};
};

constexpr FormatSize kFormatSizes[] = {
    {1, false, {GL_R8, GL_R8_SNORM, GL_R8UI, GL_R8I}},
    {2,
     false,
     {GL_RG8, GL_RG8_SNORM, GL_RG8UI, GL_RG8I, GL_R16, GL_R16_SNORM, GL_R16F, GL_R16UI, GL_R16I, GL_RGB565,
      GL_DEPTH_COMPONENT16}},
    {3, false, {GL_RGB8, GL_SRGB8, GL_DEPTH_COMPONENT24}},
    {4, false, {GL_RGBA8, GL_RGBA8_SNORM, GL_SRGB8_ALPHA8, GL_RGBA8UI, GL_RGBA8I, GL_RGB10_A2, GL_RGB10_A2UI}},
    {4, false, {GL_R11F_G11F_B10F, GL_RGB9_E5, GL_RG16, GL_RG16_SNORM, GL_RG16F, GL_RG16UI, GL_RG16I}},
    {4, false, {GL_R32F, GL_R32UI, GL_R32I, GL_DEPTH_COMPONENT32, GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8}},
    {6, false, {GL_RGB16, GL_RGB16F}},
    {8, false, {GL_RGBA16, GL_RGBA16_SNORM, GL_RGBA16F, GL_RGBA16UI, GL_RGBA16I, GL_RG32F, GL_RG32UI, GL_RG32I}},
    {8, false, {GL_DEPTH32F_STENCIL8}},
    {12, false, {GL_RGB32F, GL_RGB32UI, GL_RGB32I}},
    {16, false, {GL_RGBA32F, GL_RGBA32UI, GL_RGBA32I}},
    {8, true, {GL_COMPRESSED_RED_RGTC1}},
    {16,
     true,
     {GL_COMPRESSED_RG_RGTC2, GL_COMPRESSED_RGBA_BPTC_UNORM, GL_COMPRESSED_SRGB_ALPHA_BPTC_UNORM,
      GL_COMPRESSED_RGB_BPTC_SIGNED_FLOAT, GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT}},
};

// 0 bytes for formats without a fixed size.
FormatSize formatSize(GLenum format) {
    for (const FormatSize& row : kFormatSizes)
        if (format && std::find(row.formats.begin(), row.formats.end(), format) != row.formats.end()) return row;
    return {};
}

std::int64_t storageBytes(const TextureView& t) {
    const FormatSize size = formatSize(t.format);
    std::int64_t sum = 0;
    for (int level = 0; level < t.levels; ++level) {
        std::int64_t w = std::max(t.width >> level, 1), h = std::max(t.height >> level, 1);
        const std::int64_t d = t.target == GL_TEXTURE_3D ? std::max(t.layers >> level, 1) : t.layers;
        if (size.block) w = (w + 3) / 4, h = (h + 3) / 4;
        sum += w * h * d * size.bytes;
    }
    return sum;
}

int fullLevelCount(const TextureView& t) {
    const int largest = std::max({t.width, t.height, t.target == GL_TEXTURE_3D ? t.layers : 1});
    return std::bit_width(unsigned(largest));
}

void allocate(const TextureView& t) {
    if (t.target == GL_TEXTURE_2D || t.target == GL_TEXTURE_CUBE_MAP)
        glTextureStorage2D(t.name, t.levels, t.format, t.width, t.height);
    else
        glTextureStorage3D(t.name, t.levels, t.format, t.width, t.height, t.layers);
}

void requireSane(Device& device, const TextureDesc& d) {
    SHOAL_ASSERT_MSG(
        device.state().isCurrent(),
        fmt::format("device \"{}\" is not current on this thread: call makeCurrent()", device.info().name));
    SHOAL_ASSERT_MSG(
        d.width > 0 && d.height > 0 && d.layers > 0 && d.levels >= 0,
        fmt::format("texture \"{}\" of {} x {} x {}, {} levels", d.label, d.width, d.height, d.layers, d.levels));
    SHOAL_ASSERT_MSG(d.target == GL_TEXTURE_2D || d.target == GL_TEXTURE_2D_ARRAY || d.target == GL_TEXTURE_3D ||
                         d.target == GL_TEXTURE_CUBE_MAP || d.target == GL_TEXTURE_CUBE_MAP_ARRAY,
                     fmt::format("texture \"{}\": unexpected target 0x{:04x}", d.label, d.target));
    SHOAL_ASSERT_MSG(
        formatSize(d.format).bytes > 0,
        fmt::format("texture \"{}\": unexpected format 0x{:04x}; expected a sized one", d.label, d.format));
}

}  // namespace

Texture Texture::create(Device& device, const TextureDesc& desc) {
    requireSane(device, desc);
    TextureView view{0, desc.target, desc.format, desc.width, desc.height, desc.layers, desc.levels};
    if (desc.target == GL_TEXTURE_2D) view.layers = 1;
    if (desc.target == GL_TEXTURE_CUBE_MAP) view.layers = 6;
    view.levels = desc.levels == 0 ? fullLevelCount(view) : std::min(desc.levels, fullLevelCount(view));
    glCreateTextures(desc.target, 1, &view.name);
    allocate(view);
    GLint width = 0;  // stays 0 where the storage was refused, for its size or for want of memory
    glGetTextureLevelParameteriv(view.name, 0, GL_TEXTURE_WIDTH, &width);
    if (width != desc.width) {
        device.log(LogLevel::error, fmt::format("no storage for texture \"{}\": {} x {} x {}, {} bytes", desc.label,
                                                view.width, view.height, view.layers, storageBytes(view)));
        glDeleteTextures(1, &view.name);
        return {};
    }
    glTextureParameteri(view.name, GL_TEXTURE_MIN_FILTER, GLint(desc.minFilter));
    glTextureParameteri(view.name, GL_TEXTURE_MAG_FILTER, GLint(desc.magFilter));
    for (GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(view.name, axis, GLint(desc.wrap));
    if (!desc.label.empty())
        glObjectLabel(GL_TEXTURE, view.name, GLsizei(std::min<std::size_t>(desc.label.size(), 255)), desc.label.data());
    Texture out(device, Type::texture, view.name, storageBytes(view));
    out.view_ = view;
    return out;
}

void Texture::upload(int level, int layer, Enum format, Enum type, const void* pixels) {
    SHOAL_ASSERT(level >= 0 && level < view_.levels && layer < view_.layers && pixels);
    const PixelStoreScope tight;
    const int w = std::max(view_.width >> level, 1), h = std::max(view_.height >> level, 1);
    if (view_.target == GL_TEXTURE_2D) {
        glTextureSubImage2D(name_, level, 0, 0, w, h, format, type, pixels);
        return;
    }
    const int all = view_.target == GL_TEXTURE_3D ? std::max(view_.layers >> level, 1) : view_.layers;
    glTextureSubImage3D(name_, level, 0, 0, std::max(layer, 0), w, h, layer < 0 ? all : 1, format, type, pixels);
}

void Texture::generateMipmaps() {
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGenerateTextureMipmap(name_);
}

void Texture::clear(Enum format, Enum type, const void* value) {
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    for (int level = 0; level < view_.levels; ++level) glClearTexImage(name_, level, format, type, value);
}

void Texture::read(Enum format, Enum type, std::span<std::byte> to) const {
    const PixelStoreScope tight;
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(name_, 0, format, type, GLsizei(to.size()), to.data());
}

void Texture::bind(int unit) const { glBindTextureUnit(GLuint(unit), name_); }
void Texture::bindImage(int unit, Enum access, int level) const { gl::bindImage(unit, view_, access, level); }

void bindTexture(int unit, const TextureView& texture) { glBindTextureUnit(GLuint(unit), texture.name); }

void bindImage(int unit, const TextureView& texture, Enum access, int level) {
    // An empty view unbinds; the format must be a legal one even then.
    const GLenum format = texture ? texture.format : GLenum(GL_R32UI);
    glBindImageTexture(GLuint(unit), texture.name, level, GL_TRUE, 0, access, format);
}

}  // namespace shoal::gl
