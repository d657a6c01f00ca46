// Materials and textures of the formats that assimp reads, as metal-rough ones.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <shoal/core/parallel.h>
#include <shoal/io/image.h>

#include "io/assimp_parts.h"

namespace shoal::io {

namespace {

constexpr float kDefaultRoughness = 0.8f;

class MaterialReader {
public:
    MaterialReader(const aiScene& scene, const std::filesystem::path& path, const LogSink& log, Model& model)
        : scene_(scene), path_(path), log_(log), model_(model) {}
    void readAll() {
        for (unsigned i = 0; i < scene_.mNumMaterials; ++i) readMaterial(*scene_.mMaterials[i]);
        decodeImages();
    }

private:
    void warn(const std::string& message) const {
        if (log_) log_(LogLevel::warning, fmt::format("{}: {}", path_.string(), message));
    }
    int image(const std::string& reference);
    TextureUse texture(const aiMaterial& source, std::initializer_list<aiTextureType> types);
    void readMaterial(const aiMaterial& source);
    void decodeImages();

    const aiScene& scene_;
    const std::filesystem::path& path_;
    const LogSink& log_;
    Model& model_;
    std::map<std::string, int> imageOfReference_;
    std::vector<std::string> imageReferences_;
};

int MaterialReader::image(const std::string& reference) {
    const auto [found, added] = imageOfReference_.emplace(reference, int(imageReferences_.size()));
    if (added) imageReferences_.push_back(reference);
    return found->second;
}

TextureUse MaterialReader::texture(const aiMaterial& source, std::initializer_list<aiTextureType> types) {
    TextureUse use;
    for (const aiTextureType type : types) {
        aiString reference;
        unsigned uvSet = 0;
        aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
        if (source.GetTexture(type, 0, &reference, nullptr, &uvSet, nullptr, nullptr, modes) != aiReturn_SUCCESS)
            continue;
        if (reference.length == 0) continue;
        const auto wrap = [](aiTextureMapMode mode) {
            return mode == aiTextureMapMode_Mirror  ? Wrap::mirror
                   : mode == aiTextureMapMode_Clamp ? Wrap::clamp
                                                    : Wrap::repeat;
        };
        use.image = image(std::string(reference.C_Str(), reference.length));
        use.uvSet = uvSet == 1 ? 1 : 0;
        use.wrapU = wrap(modes[0]);
        use.wrapV = wrap(modes[1]);
        return use;
    }
    return use;
}

// Roughness from a Phong exponent as Blender's exporters write it: (1 - roughness)^2 times 1000 (OBJ) or 100 (others).
float roughnessOf(float shininess, bool obj) {
    return 1 - std::sqrt(std::clamp(shininess / (obj ? 1000.0f : 100.0f), 0.0f, 1.0f));
}

void MaterialReader::readMaterial(const aiMaterial& source) {
    const bool obj = path_.extension() == ".obj" || path_.extension() == ".OBJ";
    Material material;
    aiString name;
    if (source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) material.name = std::string(name.C_Str(), name.length);
    material.baseColorTexture = texture(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    material.normalTexture = texture(source, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA});
    material.emissionTexture = texture(source, {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE});
    aiColor4D color(1, 1, 1, 1);
    if (source.Get(AI_MATKEY_BASE_COLOR, color) != aiReturn_SUCCESS) source.Get(AI_MATKEY_COLOR_DIFFUSE, color);
    // Exporters leave a black or grey colour under a texture, which then is meant to replace it.
    if (material.baseColorTexture.image >= 0 && color.r + color.g + color.b == 0) color = aiColor4D(1, 1, 1, 1);
    float opacity = 1;
    source.Get(AI_MATKEY_OPACITY, opacity);
    if (!(opacity > 0)) opacity = 1;  // FBX writers disagree on the sense of 0; nobody means an invisible surface
    const auto unitRange = [](float v) { return std::isfinite(v) ? std::clamp(v, 0.0f, 1.0f) : 1.0f; };
    material.baseColor = {unitRange(color.r), unitRange(color.g), unitRange(color.b), unitRange(opacity)};
    if (material.baseColor.w < 1) material.alphaMode = AlphaMode::blend;

    float value = 0;
    material.metallic = source.Get(AI_MATKEY_METALLIC_FACTOR, value) == aiReturn_SUCCESS ? unitRange(value) : 0.0f;
    if (source.Get(AI_MATKEY_ROUGHNESS_FACTOR, value) == aiReturn_SUCCESS)
        material.roughness = unitRange(value);
    else if (source.Get(AI_MATKEY_SHININESS, value) == aiReturn_SUCCESS && value > 0)
        material.roughness = roughnessOf(value, obj);
    else
        material.roughness = kDefaultRoughness;
    aiColor3D emission(0, 0, 0);
    source.Get(AI_MATKEY_COLOR_EMISSIVE, emission);
    material.emission = max(Vec3{emission.r, emission.g, emission.b}, {0, 0, 0});
    // These formats mostly do not say; seeing a back face is better than missing a front one.
    int twoSided = 1;
    material.doubleSided = source.Get(AI_MATKEY_TWOSIDED, twoSided) != aiReturn_SUCCESS || twoSided != 0;
    model_.materials.push_back(std::move(material));
}

// Where a texture may lie: as written, else by its name alone beside the model or in its "textures" folder.
std::optional<std::filesystem::path> findBeside(const std::filesystem::path& model, std::string reference) {
    std::replace(reference.begin(), reference.end(), '\\', '/');
    const std::filesystem::path folder = model.parent_path(), file = std::filesystem::path(reference).filename();
    for (const std::filesystem::path& candidate : {folder / reference, folder / file, folder / "textures" / file}) {
        std::error_code error;
        if (std::filesystem::is_regular_file(candidate, error)) return candidate;
    }
    return std::nullopt;
}

// Decodes all; a texture that cannot be found or is no PNG or JPEG is left out with a warning, as its path is often one
// of the author's machine.
void MaterialReader::decodeImages() {
    std::vector<std::optional<Result<ByteImage>>> decoded(imageReferences_.size());
    parallelFor(decoded.size(), 1, [&](std::size_t i) {
        const std::string& reference = imageReferences_[i];
        if (const aiTexture* embedded = scene_.GetEmbeddedTexture(reference.c_str())) {
            if (embedded->mHeight == 0) {
                decoded[i] =
                    decodeImage({reinterpret_cast<const std::byte*>(embedded->pcData), embedded->mWidth}, reference);
            } else if (embedded->mWidth <= unsigned(kImageSideLimit) &&
                       embedded->mHeight <= unsigned(kImageSideLimit)) {
                ByteImage pixels(int(embedded->mWidth), int(embedded->mHeight));
                for (std::size_t p = 0; p < pixels.pixels.size() / 4; ++p) {
                    const aiTexel t = embedded->pcData[p];
                    const std::uint8_t rgba[4] = {t.r, t.g, t.b, t.a};
                    std::copy_n(rgba, 4, pixels.pixels.data() + p * 4);
                }
                decoded[i] = std::move(pixels);
            }
        } else if (const auto file = findBeside(path_, reference)) {
            decoded[i] = readByteImage(*file);
        }
    });
    std::vector<int> place(decoded.size(), -1);
    for (std::size_t i = 0; i < decoded.size(); ++i) {
        if (!decoded[i]) {
            warn(fmt::format("texture \"{}\" is not there and is left out", imageReferences_[i]));
        } else if (!*decoded[i]) {
            warn(fmt::format("texture left out: {}", decoded[i]->error().message));
        } else {
            place[i] = int(model_.images.size());
            model_.images.push_back(**std::move(decoded[i]));
        }
    }
    for (Material& m : model_.materials)
        for (TextureUse* use : {&m.baseColorTexture, &m.normalTexture, &m.emissionTexture})
            if (use->image >= 0) use->image = place[std::size_t(use->image)];
}

}  // namespace

void readAssimpMaterials(const aiScene& scene, const std::filesystem::path& path, const LogSink& log, Model& model) {
    MaterialReader(scene, path, log, model).readAll();
}

}  // namespace shoal::io
