// Move-only owners of GL objects, made and changed with direct state access. GL enums are passed as std::uint32_t with
// GL's values, so that this header needs no GL header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <shoal/gl/device.h>

namespace shoal::gl {

using Enum = std::uint32_t;

// Somebody's texture, not owned: how a technique is given its inputs and outputs.
struct TextureView {
    std::uint32_t name = 0;  // GL texture name, 0 for none
    Enum target = 0x0DE1;    // GL_TEXTURE_2D
    Enum format = 0;         // sized internal format
    int width = 0, height = 0, layers = 1, levels = 1;
    explicit operator bool() const { return name != 0; }
};
struct BufferView {
    std::uint32_t name = 0;
    std::size_t offset = 0, bytes = 0;
    explicit operator bool() const { return name != 0; }
};

struct ObjectLedger;  // what a device counts; outlives the device, so that an object that does too is harmless

// Common part: a name that is deleted when its owner goes. Moved-from owners are empty. Creating needs the device to be
// current; deleting makes it current for the moment where it is not.
class Object {
public:
    Object() = default;
    Object(Object&& other) noexcept { swap(other); }
    Object& operator=(Object&& other) noexcept {
        swap(other);
        return *this;
    }
    std::uint32_t name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

protected:
    enum class Type : std::uint8_t { none, buffer, texture, sampler, framebuffer, vertexArray, query, program };
    Object(Device& device, Type type, std::uint32_t name, std::int64_t bytes);
    ~Object();
    void swap(Object& other) noexcept {
        std::swap(ledger_, other.ledger_), std::swap(type_, other.type_);
        std::swap(name_, other.name_), std::swap(bytes_, other.bytes_);
    }
    void countBytes(std::int64_t bytes);
    static void deleteName(Type type, std::uint32_t name);
    std::shared_ptr<ObjectLedger> ledger_;
    Type type_ = Type::none;
    std::uint32_t name_ = 0;
    std::int64_t bytes_ = 0;
};

class Buffer : public Object {
public:
    Buffer() = default;
    // Immutable storage of `bytes` (at least 1) bytes, contents undefined; updatable with write().
    static Buffer create(Device& device, std::size_t bytes, std::string_view label);
    static Buffer create(Device& device, std::span<const std::byte> data, std::string_view label);
    template <class T>
    static Buffer of(Device& device, std::span<const T> data, std::string_view label) {
        return create(device, std::as_bytes(data), label);
    }
    std::size_t bytes() const { return std::size_t(bytes_); }
    void write(std::size_t offset, std::span<const std::byte> data);
    template <class T>
    void writeAll(std::span<const T> data) {
        write(0, std::as_bytes(data));
    }
    void read(std::size_t offset, std::span<std::byte> to) const;
    void clear(std::uint32_t value);  // every 32-bit word
    BufferView view() const { return {name_, 0, bytes()}; }
    void bindUniform(int binding) const;
    void bindStorage(int binding) const;

private:
    using Object::Object;
};

struct TextureDesc {
    Enum target = 0x0DE1;                         // GL_TEXTURE_2D, _2D_ARRAY, _3D, _CUBE_MAP, _CUBE_MAP_ARRAY
    Enum format = 0x8058;                         // GL_RGBA8
    int width = 1, height = 1, layers = 1;        // layers: array size or depth of a 3D texture (cube arrays: 6 a cube)
    int levels = 1;                               // 0: a full mip chain
    Enum minFilter = 0x2600, magFilter = 0x2600;  // GL_NEAREST
    Enum wrap = 0x812F;                           // GL_CLAMP_TO_EDGE
    std::string_view label = "";
};

class Texture : public Object {
public:
    Texture() = default;
    static Texture create(Device& device, const TextureDesc& desc);
    // Uploads one level (all of a 2D texture or one layer). format and type as GL's pixel transfer names.
    void upload(int level, int layer, Enum format, Enum type, const void* pixels);
    void generateMipmaps();
    void clear(Enum format, Enum type, const void* value);
    // Reads level 0 (all layers); `to` must hold it all. Rows come bottom first as in GL.
    void read(Enum format, Enum type, std::span<std::byte> to) const;
    TextureView view() const { return view_; }
    operator TextureView() const { return view_; }
    int width() const { return view_.width; }
    int height() const { return view_.height; }
    void bind(int unit) const;
    void bindImage(int unit, Enum access, int level = 0) const;  // format: the texture's own; all layers
private:
    using Object::Object;
    TextureView view_;
};
void bindTexture(int unit, const TextureView& texture);
void bindImage(int unit, const TextureView& texture, Enum access, int level = 0);

class Sampler : public Object {
public:
    Sampler() = default;
    static Sampler create(Device& device, Enum minFilter, Enum magFilter, Enum wrapS, Enum wrapT, float anisotropy = 1,
                          bool depthCompare = false);
    void bind(int unit) const;

private:
    using Object::Object;
};

class Framebuffer : public Object {
public:
    Framebuffer() = default;
    struct Attachment {
        TextureView texture;
        int level = 0;
        int layer = -1;  // -1: all layers (layered rendering for arrays)
    };
    // Colour attachments in order (draw buffers set to match), and depth (may be empty).
    static Result<Framebuffer> create(Device& device, std::span<const Attachment> colors, const Attachment& depth,
                                      std::string_view label);
    void bind() const;  // also sets the viewport to its size
    int width() const { return width_; }
    int height() const { return height_; }

private:
    using Object::Object;
    int width_ = 0, height_ = 0;
};

struct VertexAttribute {
    int location = 0, buffer = 0;  // index of the vertex buffer binding
    int componentCount = 4;
    Enum type = 0x1406;  // GL_FLOAT
    bool normalized = false, integer = false;
    int offset = 0;
};
class VertexArray : public Object {
public:
    VertexArray() = default;
    static VertexArray create(Device& device, std::span<const VertexAttribute> attributes, std::string_view label);
    void setBuffer(int index, const BufferView& buffer, int stride, int divisor = 0);
    void setIndices(const BufferView& indices);
    void bind() const;

private:
    using Object::Object;
};

// A buffer that holds one block (std140 or std430 struct shared with GLSL) and is rewritten each frame.
template <class Block>
class BlockBuffer {
public:
    static BlockBuffer create(Device& device, std::string_view label) {
        BlockBuffer b;
        b.buffer_ = Buffer::create(device, sizeof(Block), label);
        return b;
    }
    void write(const Block& block) { buffer_.write(0, std::as_bytes(std::span(&block, 1))); }
    void bindUniform(int binding) const { buffer_.bindUniform(binding); }

private:
    Buffer buffer_;
};

}  // namespace shoal::gl
