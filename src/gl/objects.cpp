#include <shoal/gl/objects.h>

#include <fmt/format.h>

#include <algorithm>

#include <shoal/core/assert.h>

#include "gl/device_state.h"

namespace shoal::gl {
namespace {

void setLabel(GLenum kind, GLuint name, std::string_view label) {
    if (!label.empty()) glObjectLabel(kind, name, GLsizei(std::min<std::size_t>(label.size(), 255)), label.data());
}

void requireCurrent(Device& device) {
    SHOAL_ASSERT_MSG(
        device.state().isCurrent(),
        fmt::format("device \"{}\" is not current on this thread: call makeCurrent()", device.info().name));
}

}  // namespace

Object::Object(Device& device, Type type, std::uint32_t name, std::int64_t bytes)
    : ledger_(device.state().ledger), type_(type), name_(name), bytes_(bytes) {
    ++ledger_->objectCount;
    ledger_->bytes += bytes;
}

Object::~Object() {
    if (!name_) return;
    --ledger_->objectCount;
    ledger_->bytes -= bytes_;
    if (!ledger_->device) return;  // the device said so when it went
    const ScopedCurrent current(ledger_->device->state());
    if (current.ok())
        deleteName(type_, name_);
    else
        ledger_->device->log(LogLevel::warning, "cannot delete an OpenGL object: its context cannot be made current");
}

void Object::countBytes(std::int64_t bytes) {
    ledger_->bytes += bytes - bytes_;
    bytes_ = bytes;
}

void Object::deleteName(Type type, std::uint32_t name) {
    switch (type) {
        case Type::buffer:
            glDeleteBuffers(1, &name);
            break;
        case Type::texture:
            glDeleteTextures(1, &name);
            break;
        case Type::sampler:
            glDeleteSamplers(1, &name);
            break;
        case Type::framebuffer:
            glDeleteFramebuffers(1, &name);
            break;
        case Type::vertexArray:
            glDeleteVertexArrays(1, &name);
            break;
        case Type::query:
            glDeleteQueries(1, &name);
            break;
        case Type::program:
            glDeleteProgram(name);
            break;
        case Type::none:
            break;
    }
}

// ---- Buffer

namespace {

// 0 when the driver has no memory for it; that is logged.
GLuint makeBuffer(Device& device, std::size_t bytes, const void* data, std::string_view label) {
    requireCurrent(device);
    SHOAL_ASSERT_MSG(bytes > 0, fmt::format("buffer \"{}\" of 0 bytes", label));
    GLuint name = 0;
    glCreateBuffers(1, &name);
    glNamedBufferStorage(name, GLsizeiptr(bytes), data, GL_DYNAMIC_STORAGE_BIT);
    GLint64 got = 0;
    glGetNamedBufferParameteri64v(name, GL_BUFFER_SIZE, &got);
    if (std::size_t(got) != bytes) {
        device.log(LogLevel::error, fmt::format("out of memory: {} bytes for buffer \"{}\"", bytes, label));
        glDeleteBuffers(1, &name);
        return 0;
    }
    setLabel(GL_BUFFER, name, label);
    return name;
}

}  // namespace

Buffer Buffer::create(Device& device, std::size_t bytes, std::string_view label) {
    const GLuint name = makeBuffer(device, bytes, nullptr, label);
    return name ? Buffer(device, Type::buffer, name, std::int64_t(bytes)) : Buffer();
}

Buffer Buffer::create(Device& device, std::span<const std::byte> data, std::string_view label) {
    const GLuint name = makeBuffer(device, data.size(), data.data(), label);
    return name ? Buffer(device, Type::buffer, name, std::int64_t(data.size())) : Buffer();
}

void Buffer::write(std::size_t offset, std::span<const std::byte> data) {
    SHOAL_ASSERT_LE(offset + data.size(), bytes());
    if (data.empty()) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glNamedBufferSubData(name_, GLintptr(offset), GLsizeiptr(data.size()), data.data());
}

void Buffer::read(std::size_t offset, std::span<std::byte> to) const {
    SHOAL_ASSERT_LE(offset + to.size(), bytes());
    if (to.empty()) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(name_, GLintptr(offset), GLsizeiptr(to.size()), to.data());
}

void Buffer::clear(std::uint32_t value) {
    SHOAL_ASSERT_EQ(bytes() % 4, std::size_t(0));
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

void Buffer::bindUniform(int binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, GLuint(binding), name_); }
void Buffer::bindStorage(int binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLuint(binding), name_); }

// ---- Sampler

Sampler Sampler::create(Device& device, Enum minFilter, Enum magFilter, Enum wrapS, Enum wrapT, float anisotropy,
                        bool depthCompare) {
    requireCurrent(device);
    GLuint name = 0;
    glCreateSamplers(1, &name);
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GLint(minFilter));
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GLint(magFilter));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GLint(wrapS));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GLint(wrapT));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_R, GLint(wrapT));
    const Capabilities& can = device.capabilities();
    if (anisotropy > 1 && can.anisotropicFiltering)
        glSamplerParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(anisotropy, can.maxAnisotropy));
    if (depthCompare) {
        glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glSamplerParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);  // reversed z: the larger depth is nearer
    }
    return Sampler(device, Type::sampler, name, 0);
}

void Sampler::bind(int unit) const { glBindSampler(GLuint(unit), name_); }

// ---- Framebuffer

namespace {

bool hasStencil(GLenum format) { return format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8; }

void attach(GLuint framebuffer, GLenum point, const Framebuffer::Attachment& a) {
    if (a.layer < 0)
        glNamedFramebufferTexture(framebuffer, point, a.texture.name, a.level);
    else
        glNamedFramebufferTextureLayer(framebuffer, point, a.texture.name, a.level, a.layer);
}

const char* statusName(GLenum status) {
    switch (status) {
        case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
            return "an attachment is incomplete";
        case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
            return "it has no attachment";
        case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
            return "sample counts differ";
        case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
            return "layered and plain attachments are mixed";
        case GL_FRAMEBUFFER_UNSUPPORTED:
            return "the driver does not support this combination of formats";
        default:
            return "unknown reason";
    }
}

}  // namespace

Result<Framebuffer> Framebuffer::create(Device& device, std::span<const Attachment> colors, const Attachment& depth,
                                        std::string_view label) {
    requireCurrent(device);
    const Attachment* first = !colors.empty() ? &colors.front() : depth.texture ? &depth : nullptr;
    if (!first) return internalError(fmt::format("framebuffer \"{}\": no attachments", label));
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    Framebuffer out(device, Type::framebuffer, name, 0);
    std::vector<GLenum> drawBuffers;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        attach(name, GLenum(GL_COLOR_ATTACHMENT0 + i), colors[i]);
        drawBuffers.push_back(colors[i].texture ? GLenum(GL_COLOR_ATTACHMENT0 + i) : GLenum(GL_NONE));
    }
    if (depth.texture)
        attach(name, hasStencil(depth.texture.format) ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth);
    if (drawBuffers.empty()) drawBuffers.push_back(GL_NONE);
    glNamedFramebufferDrawBuffers(name, GLsizei(drawBuffers.size()), drawBuffers.data());
    glNamedFramebufferReadBuffer(name, drawBuffers.front());
    setLabel(GL_FRAMEBUFFER, name, label);
    const GLenum status = glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        return internalError(
            fmt::format("framebuffer \"{}\" cannot be drawn to: {} (0x{:04x})", label, statusName(status), status));
    out.width_ = std::max(first->texture.width >> first->level, 1);
    out.height_ = std::max(first->texture.height >> first->level, 1);
    return out;
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, name_);
    glViewport(0, 0, width_, height_);
}

// ---- VertexArray

VertexArray VertexArray::create(Device& device, std::span<const VertexAttribute> attributes, std::string_view label) {
    requireCurrent(device);
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    setLabel(GL_VERTEX_ARRAY, name, label);
    for (const VertexAttribute& a : attributes) {
        const auto location = GLuint(a.location);
        glEnableVertexArrayAttrib(name, location);
        if (a.integer)
            glVertexArrayAttribIFormat(name, location, a.componentCount, a.type, GLuint(a.offset));
        else
            glVertexArrayAttribFormat(name, location, a.componentCount, a.type, a.normalized ? GL_TRUE : GL_FALSE,
                                      GLuint(a.offset));
        glVertexArrayAttribBinding(name, location, GLuint(a.buffer));
    }
    return VertexArray(device, Type::vertexArray, name, 0);
}

void VertexArray::setBuffer(int index, const BufferView& buffer, int stride, int divisor) {
    glVertexArrayVertexBuffer(name_, GLuint(index), buffer.name, GLintptr(buffer.offset), stride);
    glVertexArrayBindingDivisor(name_, GLuint(index), GLuint(divisor));
}

void VertexArray::setIndices(const BufferView& indices) { glVertexArrayElementBuffer(name_, indices.name); }
void VertexArray::bind() const { glBindVertexArray(name_); }

}  // namespace shoal::gl
