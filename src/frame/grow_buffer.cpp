#include "frame/grow_buffer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

namespace shoal::frame {

Result<std::size_t> GrowBuffer::reserve(gl::Device& device, std::size_t bytes) {
    const std::size_t offset = used_, needed = used_ + bytes;
    if (buffer_ && needed <= buffer_.bytes()) {
        used_ = needed;
        return offset;
    }
    // The first storage fits exactly: most scenes load one model.
    const std::size_t capacity = buffer_ ? std::max(needed, buffer_.bytes() + buffer_.bytes() / 2) : needed;
    gl::Buffer larger = gl::Buffer::create(device, std::max<std::size_t>(capacity, 4), label_);
    if (!larger)
        return badInput(std::string("out of graphics memory: ") + std::to_string(capacity) + " bytes for " + label_);
    used_ = needed;
    if (offset > 0) glCopyNamedBufferSubData(buffer_.name(), larger.name(), 0, 0, GLsizeiptr(offset));
    buffer_ = std::move(larger);
    return offset;
}

Result<std::size_t> GrowBuffer::append(gl::Device& device, std::span<const std::byte> data) {
    SHOAL_TRY_ASSIGN(const std::size_t offset, reserve(device, data.size()));
    if (!data.empty()) buffer_.write(offset, data);
    return offset;
}

bool ensureBytes(gl::Device& device, gl::Buffer& buffer, std::size_t bytes, const char* label) {
    if (buffer && buffer.bytes() >= bytes) return false;
    const std::size_t grown = buffer ? std::max(bytes, buffer.bytes() + buffer.bytes() / 2) : bytes;
    buffer = gl::Buffer::create(device, std::max<std::size_t>(grown, 4), label);
    return true;
}

}  // namespace shoal::frame
