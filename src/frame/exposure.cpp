#include "frame/exposure.h"

#include <epoxy/gl.h>

#include <cstddef>

#include "frame/bindings.shared.h"
#include "frame/exposure.shared.h"

namespace shoal::frame {

Result<Exposure> Exposure::create(gl::Device& device) {
    Exposure e;
    SHOAL_TRY_ASSIGN(e.histogram_,
                     device.programs().get({{"frame/exposure_histogram.comp"}, {}, "exposure histogram"}));
    SHOAL_TRY_ASSIGN(e.adapt_, device.programs().get({{"frame/exposure_adapt.comp"}, {}, "exposure adapt"}));
    ExposureState start{};
    start.measured = start.adapted = start.antialiasing = 1;
    e.state_ = gl::Buffer::of(device, std::span<const ExposureState>(&start, 1), "exposure");
    if (!e.state_) return internalError("no memory for the exposure");
    return e;
}

void Exposure::bind() const { state_.bindStorage(SHOAL_STORAGE_PASS); }

void Exposure::count(gl::TextureView radiance, bool weighted) {
    bind();
    gl::bindTexture(SHOAL_UNIT_PASS, radiance);
    glBindSampler(SHOAL_UNIT_PASS, 0);
    histogram_->set(0, weighted ? 1 : 0);
    histogram_->dispatch((radiance.width + SHOAL_EXPOSURE_STRIDE - 1) / SHOAL_EXPOSURE_STRIDE,
                         (radiance.height + SHOAL_EXPOSURE_STRIDE - 1) / SHOAL_EXPOSURE_STRIDE);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void Exposure::measureForAntialiasing(gl::TextureView radiance) {
    count(radiance, false);
    adapt_->set(0, Vec4{0, 0, 1, 0});
    adapt_->dispatch(1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void Exposure::setForAntialiasing(float factor) {
    state_.write(offsetof(ExposureState, antialiasing), std::as_bytes(std::span(&factor, 1)));
}

void Exposure::adapt(gl::TextureView radiance, bool weighted, float share, bool forget) {
    count(radiance, weighted);
    adapt_->set(0, Vec4{share, forget ? 1.0f : 0.0f, 0, 0});
    adapt_->dispatch(1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

float Exposure::adapted() const {
    float value = 1;
    state_.read(offsetof(ExposureState, adapted), std::as_writable_bytes(std::span(&value, 1)));
    return value;
}

}  // namespace shoal::frame
