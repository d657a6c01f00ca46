// Materials on the GPU: one record each, and which textures and program they need.
#pragma once

#include <string>
#include <vector>

#include <shoal/core/model.h>

#include "frame/geometry.shared.h"
#include "frame/gpu_texture.h"
#include "frame/grow_buffer.h"

namespace shoal::frame {

// Which variant of the surface programs draws a material.
enum class SurfaceVariant { flat, baseTexture, allTextures };
inline constexpr int kSurfaceVariantCount = 3;

struct GpuMaterial {
    SurfaceVariant variant = SurfaceVariant::flat;
    bool masked = false, transparent = false, doubleSided = false;
    bool castsShadow = true, maskedShadow = false;
    int textures[SHOAL_TEXTURE_COUNT] = {}, samplers[SHOAL_TEXTURE_COUNT] = {};
    bool usesUv1 = false;
};

class MaterialStore {
public:
    static Result<MaterialStore> create(gl::Device& device);
    // Adds all of a model's materials and their textures; returns the index of the first. Index 0 is the default
    // material.
    Result<int> add(const Model& model);
    const GpuMaterial& at(int index) const { return materials_[std::size_t(index)]; }
    // The material's record as uniform block, its textures to their units.
    void bind(int index) const;
    void bindRecords() const { records_.buffer().bindStorage(SHOAL_STORAGE_MATERIALS); }
    Result<void> clear();  // all but the default material

private:
    explicit MaterialStore(gl::Device& device) : device_(&device), textures_(device) {}
    Result<void> addRecord(const Material& material, GpuMaterial gpu);
    gl::Device* device_;
    TextureStore textures_;
    GrowBuffer records_{"materials"};
    std::vector<GpuMaterial> materials_;
};

}  // namespace shoal::frame
