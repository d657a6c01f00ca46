// Exposure measured on the GPU from a histogram of log luminance (shaders/exposure_*.comp).
#pragma once

#include <shoal/core/result.h>
#include <shoal/frame/context.h>
#include <shoal/gl/program.h>

namespace shoal::frame {

class Exposure {
public:
    static Result<Exposure> create(gl::Device& device);
    // Sets the factor that weighs samples against each other (exposure.io.glsl, displayWeight) from a picture.
    void measureForAntialiasing(gl::TextureView radiance);
    void setForAntialiasing(float factor);
    // Follows the picture's brightness; share: how far to go in this step, 0..1. weighted: rgb is divided by a first.
    void adapt(gl::TextureView radiance, bool weighted, float share, bool forget);
    void bind() const;      // at SHOAL_STORAGE_PASS
    float adapted() const;  // reads back: waits for the GPU

private:
    void count(gl::TextureView radiance, bool weighted);
    const gl::Program *histogram_ = nullptr, *adapt_ = nullptr;
    gl::Buffer state_;
};

}  // namespace shoal::frame
