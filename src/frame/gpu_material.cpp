#include "frame/gpu_material.h"

#include <epoxy/gl.h>

#include <cmath>
#include <map>
#include <utility>

#include <shoal/frame/context.h>

namespace shoal::frame {
namespace {

constexpr float kBlendShadowCutoff = 0.5f;  // blended surfaces cast the shadow of what is at least half there

const TextureUse* textureUse(const Material& m, int slot) {
    const TextureUse* const uses[SHOAL_TEXTURE_COUNT] = {&m.baseColorTexture, &m.metallicRoughnessTexture,
                                                         &m.normalTexture, &m.occlusionTexture, &m.emissionTexture};
    return uses[slot];
}

// KHR_texture_transform: translation * rotation * scale, the rotation counter-clockwise in a uv plane whose v points
// down.
void setUvRows(MaterialRecord& record, int slot, const TextureUse& use) {
    const float c = std::cos(use.rotation), s = std::sin(use.rotation);
    record.uv[2 * slot] = {c * use.scale.x, s * use.scale.y, use.offset.x, float(use.uvSet)};
    record.uv[2 * slot + 1] = {-s * use.scale.x, c * use.scale.y, use.offset.y, 0};
}

MaterialRecord makeRecord(const Material& m) {
    MaterialRecord record{};
    record.baseColor = m.baseColor;
    const float f = (m.ior - 1) / (m.ior + 1);
    const std::uint32_t flags = m.unlit ? kFlagUnlit : 0;
    record.surface = {m.roughness, m.metallic, std::min(f * f / 0.16f, 1.0f), float(flags) / 255.0f};
    record.emission = {m.emission.x, m.emission.y, m.emission.z,
                       m.alphaMode == AlphaMode::mask ? m.alphaCutoff : kBlendShadowCutoff};
    record.detail = {m.normalScale, m.occlusionStrength, m.transmission, m.ior};
    for (int slot = 0; slot < SHOAL_TEXTURE_COUNT; ++slot) setUvRows(record, slot, *textureUse(m, slot));
    return record;
}

TextureMeaning meaningOf(const Material& m, int slot) {
    TextureMeaning meaning;
    meaning.color = slot == SHOAL_TEXTURE_BASE_COLOR || slot == SHOAL_TEXTURE_EMISSION;
    if (slot == SHOAL_TEXTURE_BASE_COLOR && m.alphaMode == AlphaMode::mask && m.baseColor.w > 0)
        meaning.coverageCutoff = std::min(m.alphaCutoff / m.baseColor.w, 1.0f);
    return meaning;
}

}  // namespace

Result<MaterialStore> MaterialStore::create(gl::Device& device) {
    MaterialStore store(device);
    store.textures_.sampler({});  // index 0: what a material without textures binds
    SHOAL_TRY(store.clear());
    return store;
}

Result<void> MaterialStore::clear() {
    textures_.clear();
    records_.clear();
    materials_.clear();
    Material plain;
    plain.metallic = 0;
    return addRecord(plain, {});
}

Result<void> MaterialStore::addRecord(const Material& m, GpuMaterial gpu) {
    gpu.masked = m.alphaMode == AlphaMode::mask;
    gpu.transparent = m.alphaMode == AlphaMode::blend || m.transmission > 0;
    gpu.doubleSided = m.doubleSided;
    gpu.castsShadow = m.transmission <= 0;
    gpu.maskedShadow = m.alphaMode != AlphaMode::opaque;
    if (gpu.masked && gpu.variant == SurfaceVariant::flat) gpu.variant = SurfaceVariant::baseTexture;
    const MaterialRecord record = makeRecord(m);
    SHOAL_TRY(records_.append(*device_, std::as_bytes(std::span(&record, 1))));
    materials_.push_back(gpu);
    return {};
}

Result<int> MaterialStore::add(const Model& model) {
    const int first = int(materials_.size());
    std::map<std::pair<int, TextureMeaning>, int> known;
    for (const Material& m : model.materials) {
        GpuMaterial gpu;
        for (int slot = 0; slot < SHOAL_TEXTURE_COUNT; ++slot) {
            const TextureUse& use = *textureUse(m, slot);
            gpu.samplers[slot] = textures_.sampler(use);
            gpu.textures[slot] = slot == SHOAL_TEXTURE_NORMAL ? textures_.flatNormal() : textures_.white();
            if (use.image < 0) continue;
            const auto key = std::pair(use.image, meaningOf(m, slot));
            auto found = known.find(key);
            if (found == known.end()) {
                const std::string name = model.name + " image " + std::to_string(use.image);
                SHOAL_TRY_ASSIGN(const int texture,
                                 textures_.add(model.images[std::size_t(use.image)], key.second, name));
                found = known.emplace(key, texture).first;
            }
            gpu.textures[slot] = found->second;
            gpu.usesUv1 |= use.uvSet == 1;
            const bool base = slot == SHOAL_TEXTURE_BASE_COLOR;
            gpu.variant = std::max(gpu.variant, base ? SurfaceVariant::baseTexture : SurfaceVariant::allTextures);
        }
        SHOAL_TRY(addRecord(m, gpu));
    }
    return first;
}

void MaterialStore::bind(int index) const {
    const GpuMaterial& m = at(index);
    glBindBufferRange(GL_UNIFORM_BUFFER, SHOAL_BLOCK_PASS, records_.buffer().name(),
                      GLintptr(index) * GLintptr(sizeof(MaterialRecord)), GLsizeiptr(sizeof(MaterialRecord)));
    for (int slot = 0; slot < SHOAL_TEXTURE_COUNT; ++slot)
        textures_.bind(SHOAL_UNIT_BASE_COLOR + slot, m.textures[slot], m.samplers[slot]);
}

}  // namespace shoal::frame
