// Materials, textures and images of glTF 2.0 (§3.8, §3.9) and the extensions KHR_texture_transform,
// KHR_materials_{unlit,emissive_strength,transmission,ior,pbrSpecularGlossiness}.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <shoal/io/image.h>

#include "io/gltf_parts.h"

namespace shoal::io {

namespace {

constexpr std::string_view kReadExtensions[] = {"KHR_lights_punctual",        "KHR_texture_transform",
                                                "KHR_materials_unlit",        "KHR_materials_emissive_strength",
                                                "KHR_materials_transmission", "KHR_materials_ior",
                                                "KHR_mesh_quantization",      "KHR_materials_pbrSpecularGlossiness"};
// A file that requires one of these still shows right but for the finer points of a material.
constexpr std::string_view kHarmlessExtensions[] = {"KHR_xmp_json_ld",        "KHR_materials_variants",
                                                    "KHR_materials_specular", "KHR_materials_clearcoat",
                                                    "KHR_materials_sheen",    "KHR_materials_volume"};

Wrap wrapOf(const JsonValue& sampler, std::string_view key) {
    switch (sampler.whole(key, 10497)) {
        case 10497:
            return Wrap::repeat;
        case 33648:
            return Wrap::mirror;
        case 33071:
            return Wrap::clamp;
        default:
            sampler.fail(fmt::format("{} {}, expected 10497, 33071 or 33648", key, sampler.whole(key, 0)));
    }
}

class MaterialReader {
public:
    MaterialReader(GltfDocument& document, Model& model)
        : document_(document), model_(model), textures_(document.list("textures")),
          samplers_(document.list("samplers")), images_(document.list("images")) {}

    std::vector<GltfImage> readAll() {
        const JsonValue materials = document_.list("materials");
        for (std::size_t i = 0; i < materials.size(); ++i) readMaterial(materials[i]);
        return usedImages();
    }

private:
    void readMaterial(const JsonValue& json);
    void readMetallicRoughness(const JsonValue& pbr, Material& material);
    void readSpecularGlossiness(const JsonValue& sg, Material& material);
    TextureUse texture(const JsonValue& parent, std::string_view key);
    int modelImage(std::size_t fileImage);
    std::vector<GltfImage> usedImages() const;

    GltfDocument& document_;
    Model& model_;
    JsonValue textures_, samplers_, images_;
    std::vector<JsonValue> used_;  // by place in model.images
    std::map<std::size_t, int> byFileImage_, byView_;
};

// Where an image of the file goes in model.images; one buffer view is decoded once, however many images refer to it.
int MaterialReader::modelImage(std::size_t fileImage) {
    if (const auto found = byFileImage_.find(fileImage); found != byFileImage_.end()) return found->second;
    const JsonValue json = images_[fileImage];
    int place = int(used_.size());
    if (json.find("bufferView")) {
        const auto view = std::size_t(json.index("bufferView", document_.list("bufferViews").size()));
        place = byView_.emplace(view, place).first->second;
    }
    if (place == int(used_.size())) used_.push_back(json);
    byFileImage_.emplace(fileImage, place);
    return place;
}

TextureUse MaterialReader::texture(const JsonValue& parent, std::string_view key) {
    TextureUse use;
    const JsonValue info = parent.object(key);
    if (!info) return use;
    const auto index = std::size_t(info.requireIndex("index", textures_.size()));
    const JsonValue texture = textures_[index];
    const int source = texture.index("source", images_.size());
    if (source < 0) {
        document_.log(LogLevel::warning, fmt::format("{}: has no PNG or JPEG source and is left out", texture.path()));
        return use;
    }
    use.image = modelImage(std::size_t(source));
    if (const int sampler = texture.index("sampler", samplers_.size()); sampler >= 0) {
        const JsonValue json = samplers_[std::size_t(sampler)];
        use.wrapU = wrapOf(json, "wrapS");
        use.wrapV = wrapOf(json, "wrapT");
        use.nearest = json.whole("magFilter", 9729) == 9728;
    }
    std::size_t uvSet = info.whole("texCoord", 0);
    if (const JsonValue transform = info.object("extensions").object("KHR_texture_transform")) {
        const auto offset = transform.reals<2>("offset", {0, 0}), scale = transform.reals<2>("scale", {1, 1});
        use.offset = {offset[0], offset[1]};
        use.scale = {scale[0], scale[1]};
        use.rotation = transform.real("rotation", 0);
        uvSet = transform.whole("texCoord", uvSet);
    }
    if (uvSet > 1) {
        document_.log(LogLevel::warning,
                      fmt::format("{}: texCoord {} is not supported, 0 is used", info.path(), uvSet));
        uvSet = 0;
    }
    use.uvSet = int(uvSet);
    return use;
}

void MaterialReader::readMetallicRoughness(const JsonValue& pbr, Material& material) {
    const auto color = pbr.reals<4>("baseColorFactor", {1, 1, 1, 1});
    material.baseColor = {color[0], color[1], color[2], color[3]};
    material.metallic = std::clamp(pbr.real("metallicFactor", 1), 0.0f, 1.0f);
    material.roughness = std::clamp(pbr.real("roughnessFactor", 1), 0.0f, 1.0f);
    material.baseColorTexture = texture(pbr, "baseColorTexture");
    material.metallicRoughnessTexture = texture(pbr, "metallicRoughnessTexture");
}

// The factors as metal-rough, after the extension's own conversion: metallic solves
// diffuse * oneMinusSpecularStrength / (1 - 0.04) = baseColor * (1 - metallic), specular = lerp(0.04, baseColor,
// metallic).
void MaterialReader::readSpecularGlossiness(const JsonValue& sg, Material& material) {
    constexpr float kDielectric = 0.04f;
    const auto d = sg.reals<4>("diffuseFactor", {1, 1, 1, 1});
    const auto s = sg.reals<3>("specularFactor", {1, 1, 1});
    const Vec3 diffuse{d[0], d[1], d[2]}, specular{s[0], s[1], s[2]};
    const auto brightness = [](Vec3 c) {
        return std::sqrt(0.299f * c.x * c.x + 0.587f * c.y * c.y + 0.114f * c.z * c.z);
    };
    const float strength = 1 - std::clamp(std::max({specular.x, specular.y, specular.z}), 0.0f, 1.0f);
    float metallic = 0;
    if (const float spec = brightness(specular); spec > kDielectric) {
        const float b = brightness(diffuse) * strength / (1 - kDielectric) + spec - 2 * kDielectric;
        const float root = std::max(b * b - 4 * kDielectric * (kDielectric - spec), 0.0f);
        metallic = std::clamp((-b + std::sqrt(root)) / (2 * kDielectric), 0.0f, 1.0f);
    }
    const Vec3 fromDiffuse = diffuse * (strength / (1 - kDielectric) / std::max(1 - metallic, 1e-4f));
    const Vec3 fromSpecular =
        (specular - Vec3{1, 1, 1} * (kDielectric * (1 - metallic))) * (1 / std::max(metallic, 1e-4f));
    const Vec3 base = min(max(lerp(fromDiffuse, fromSpecular, metallic * metallic), {0, 0, 0}), {1, 1, 1});
    material.baseColor = {base.x, base.y, base.z, d[3]};
    material.metallic = metallic;
    material.roughness = std::clamp(1 - sg.real("glossinessFactor", 1), 0.0f, 1.0f);
    material.baseColorTexture = texture(sg, "diffuseTexture");
}

void MaterialReader::readMaterial(const JsonValue& json) {
    Material material;
    material.name = json.text("name");
    const JsonValue extensions = json.object("extensions");
    const JsonValue pbr = json.object("pbrMetallicRoughness");
    const JsonValue sg = extensions.object("KHR_materials_pbrSpecularGlossiness");
    if (sg && !pbr)
        readSpecularGlossiness(sg, material);
    else
        readMetallicRoughness(pbr, material);

    const JsonValue normal = json.object("normalTexture"), occlusion = json.object("occlusionTexture");
    material.normalTexture = texture(json, "normalTexture");
    material.normalScale = normal.real("scale", 1);
    material.occlusionTexture = texture(json, "occlusionTexture");
    material.occlusionStrength = std::clamp(occlusion.real("strength", 1), 0.0f, 1.0f);
    material.emissionTexture = texture(json, "emissiveTexture");
    const auto emission = json.reals<3>("emissiveFactor", {0, 0, 0});
    const float strength = extensions.object("KHR_materials_emissive_strength").real("emissiveStrength", 1);
    material.emission = Vec3{emission[0], emission[1], emission[2]} * std::clamp(strength, 0.0f, 1e9f);

    const std::string& mode = json.text("alphaMode");
    if (mode == "MASK")
        material.alphaMode = AlphaMode::mask;
    else if (mode == "BLEND")
        material.alphaMode = AlphaMode::blend;
    else if (!mode.empty() && mode != "OPAQUE")
        json.fail("alphaMode, expected OPAQUE, MASK or BLEND");
    material.alphaCutoff = json.real("alphaCutoff", 0.5f);
    material.doubleSided = json.boolean("doubleSided", false);
    material.unlit = bool(extensions.find("KHR_materials_unlit"));
    material.transmission =
        std::clamp(extensions.object("KHR_materials_transmission").real("transmissionFactor", 0), 0.0f, 1.0f);
    const float ior = extensions.object("KHR_materials_ior").real("ior", 1.5f);
    material.ior = ior >= 1 ? ior : 1.5f;
    model_.materials.push_back(std::move(material));
}

std::vector<GltfImage> MaterialReader::usedImages() const {
    std::vector<GltfImage> images(used_.size());
    for (std::size_t i = 0; i < used_.size(); ++i) {
        images[i].json = used_[i];
        images[i].bytes = document_.resource(used_[i], images[i].storage);
    }
    return images;
}

}  // namespace

void checkExtensions(const GltfDocument& document) {
    const auto in = [](const auto& names, const std::string& name) {
        return std::find(std::begin(names), std::end(names), name) != std::end(names);
    };
    const JsonValue required = document.list("extensionsRequired"), used = document.list("extensionsUsed");
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string& name = required[i].asText();
        if (in(kReadExtensions, name)) continue;
        if (in(kHarmlessExtensions, name)) {
            document.log(LogLevel::warning, fmt::format("the file needs the extension {}, which is ignored", name));
            continue;
        }
        const char* what = name == "KHR_draco_mesh_compression" ? " (Draco-compressed meshes)"
                           : name == "EXT_meshopt_compression"  ? " (meshopt-compressed buffers)"
                           : name == "KHR_texture_basisu"       ? " (KTX2 textures)"
                           : name == "EXT_texture_webp"         ? " (WebP textures)"
                                                                : "";
        required[i].fail(
            fmt::format("the file needs the extension {}{}, which is not supported", name.substr(0, 80), what));
    }
    for (std::size_t i = 0; i < used.size(); ++i)
        if (!in(kReadExtensions, used[i].asText()))
            document.log(LogLevel::info, fmt::format("extension {} is ignored", used[i].asText().substr(0, 80)));
}

std::vector<GltfImage> readGltfMaterials(GltfDocument& document, Model& model) {
    return MaterialReader(document, model).readAll();
}

void decodeGltfImage(const GltfDocument& document, GltfImage& image) {
    image.decoded = decodeImage(image.bytes, fmt::format("{}: {}", document.name(), image.json.path()));
}

void takeGltfImages(GltfDocument& document, std::span<GltfImage> images, Model& model) {
    for (GltfImage& image : images) {
        Result<ByteImage>& decoded = *image.decoded;
        if (!decoded) {
            std::string message = decoded.error().message;  // begins with the name given above
            if (message.starts_with(document.name() + ": ")) message.erase(0, document.name().size() + 2);
            throw GltfError{message};
        }
        document.charge(image.json, decoded->pixels.size());
        model.images.push_back(*std::move(decoded));
    }
}

}  // namespace shoal::io
