// Textures to images, top row first.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include <shoal/core/parallel.h>
#include <shoal/frame/post.h>

namespace shoal::frame {
namespace {

constexpr std::size_t kRowsPerTask = 32;

// Pixel transfer of a format: what GL is asked for, and how many channels that has.
struct Transfer {
    gl::Enum format = 0, type = 0;
    int channelCount = 0;
};

Transfer transferOf(gl::Enum format) {
    switch (format) {
        case GL_RGBA32F:
        case GL_RGBA16F:
            return {GL_RGBA, GL_FLOAT, 4};
        case GL_RGBA8:
            return {GL_RGBA, GL_FLOAT, 4};
        case GL_R11F_G11F_B10F:
            return {GL_RGB, GL_FLOAT, 3};
        case GL_RG32F:
        case GL_RG16F:
        case GL_RG16:
            return {GL_RG, GL_FLOAT, 2};
        case GL_R32F:
        case GL_R16F:
        case GL_R8:
            return {GL_RED, GL_FLOAT, 1};
        case GL_DEPTH_COMPONENT32F:
            return {GL_DEPTH_COMPONENT, GL_FLOAT, 1};
        case GL_R32UI:
            return {GL_RED_INTEGER, GL_UNSIGNED_INT, 1};
        default:
            return {};
    }
}

// Level 0, bottom row first, 4 bytes a channel.
void download(const gl::TextureView& texture, gl::Enum format, gl::Enum type, std::size_t bytes, void* to) {
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT);
    GLint alignment = 4, rowLength = 0, packBuffer = 0;
    glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
    glGetIntegerv(GL_PACK_ROW_LENGTH, &rowLength);
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &packBuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glGetTextureImage(texture.name, 0, format, type, GLsizei(bytes), to);
    glPixelStorei(GL_PACK_ALIGNMENT, alignment);
    glPixelStorei(GL_PACK_ROW_LENGTH, rowLength);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(packBuffer));
}

Result<void> checkReadable(const gl::Device& device, const gl::TextureView& texture, bool knownFormat) {
    (void)device;
    if (!texture) return internalError("cannot read a texture that is not there");
    if (texture.target != GL_TEXTURE_2D)
        return internalError(
            fmt::format("cannot read a texture of target 0x{:04x}, expected GL_TEXTURE_2D", texture.target));
    if (!knownFormat) return internalError(fmt::format("cannot read a texture of format 0x{:04x}", texture.format));
    return {};
}

}  // namespace

Result<Image> readImage(gl::Device& device, const gl::TextureView& texture, int channelCount) {
    const Transfer transfer = transferOf(texture.format);
    SHOAL_TRY(checkReadable(device, texture, transfer.format != 0));
    if (channelCount < 1 || channelCount > transfer.channelCount)
        return internalError(
            fmt::format("asked for {} channels of a texture with {}", channelCount, transfer.channelCount));
    const std::size_t rowFloats = std::size_t(texture.width) * std::size_t(transfer.channelCount);
    std::vector<float> raw(rowFloats * std::size_t(texture.height));
    download(texture, transfer.format, transfer.type, raw.size() * sizeof(float), raw.data());

    Image image(texture.width, texture.height, channelCount);
    parallelFor(std::size_t(texture.height), kRowsPerTask, [&](std::size_t y) {
        const float* from = raw.data() + (std::size_t(texture.height) - 1 - y) * rowFloats;
        float* to = image.at(0, int(y));
        if (transfer.type == GL_UNSIGNED_INT) {
            for (int x = 0; x < texture.width; ++x) {
                std::uint32_t value;
                std::memcpy(&value, from + x, sizeof value);
                to[x] = float(value);
            }
        } else if (channelCount == transfer.channelCount) {
            std::copy(from, from + rowFloats, to);
        } else {
            for (int x = 0; x < texture.width; ++x, from += transfer.channelCount, to += channelCount)
                std::copy(from, from + channelCount, to);
        }
    });
    return image;
}

Result<ByteImage> readByteImage(gl::Device& device, const gl::TextureView& texture) {
    SHOAL_TRY(checkReadable(device, texture, texture.format == GL_RGBA8));
    ByteImage image(texture.width, texture.height);
    download(texture, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.size(), image.pixels.data());
    const std::ptrdiff_t row = std::ptrdiff_t(texture.width) * 4;
    for (std::ptrdiff_t low = 0, high = texture.height - 1; low < high; ++low, --high)
        std::swap_ranges(image.pixels.begin() + low * row, image.pixels.begin() + (low + 1) * row,
                         image.pixels.begin() + high * row);
    return image;
}

}  // namespace shoal::frame
