// A GPU buffer that things are appended to while models load.
#pragma once

#include <cstdint>
#include <span>

#include <shoal/core/result.h>
#include <shoal/gl/objects.h>

namespace shoal::frame {

class GrowBuffer {
public:
    explicit GrowBuffer(const char* label) : label_(label) {}
    // Appends; what is there already is copied on the GPU when the storage grows. Returns the offset in bytes, or an
    // error where the driver has no memory for it.
    Result<std::size_t> append(gl::Device& device, std::span<const std::byte> data);
    // Like append, contents undefined.
    Result<std::size_t> reserve(gl::Device& device, std::size_t bytes);
    void clear() { used_ = 0; }
    std::size_t used() const { return used_; }
    const gl::Buffer& buffer() const { return buffer_; }
    explicit operator bool() const { return bool(buffer_); }

private:
    const char* label_;
    gl::Buffer buffer_;
    std::size_t used_ = 0;
};

// Makes `buffer` hold at least `bytes`; contents are lost when it grows. True when it is another buffer afterwards.
bool ensureBytes(gl::Device& device, gl::Buffer& buffer, std::size_t bytes, const char* label);

}  // namespace shoal::frame
