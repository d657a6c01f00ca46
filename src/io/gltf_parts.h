// The parts of a glTF file, each read from a checked document into a Model. All throw GltfError.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <shoal/core/model.h>
#include <shoal/core/result.h>

#include "io/gltf_document.h"

namespace shoal::io {

// Throws where the file requires an extension that is not read.
void checkExtensions(const GltfDocument& document);

// An image that a material uses, not decoded yet.
struct GltfImage {
    JsonValue json;
    std::span<const std::byte> bytes;
    std::vector<std::byte> storage;  // of bytes, where they are not the document's
    std::optional<Result<ByteImage>> decoded;
};

// materials; returns what is to become model.images.
std::vector<GltfImage> readGltfMaterials(GltfDocument& document, Model& model);
// Fills `decoded`; may run beside anything else that reads the document.
void decodeGltfImage(const GltfDocument& document, GltfImage& image);
// Moves the decoded images into model.images.
void takeGltfImages(GltfDocument& document, std::span<GltfImage> images, Model& model);

// meshes; needs the materials.
void readGltfMeshes(GltfDocument& document, Model& model);

// cameras, lights, skins and nodes, parents first; needs the meshes. Returns the place in model.nodes of each of the
// file's nodes.
std::vector<int> readGltfNodes(GltfDocument& document, Model& model);

// animations; needs the nodes.
void readGltfAnimations(GltfDocument& document, Model& model, std::span<const int> placeOfNode);

// A primitive as a file gives it (strips and fans already unrolled) made to keep Model's promises; also used for other
// formats. The text says what was repaired, "" for nothing.
std::string finishPrimitive(Primitive& primitive, const Material* material);

}  // namespace shoal::io
