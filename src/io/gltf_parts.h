// The parts of a glTF file, each read from a checked document into a Model. All throw GltfError.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <shoal/core/model.h>

#include "io/gltf_document.h"

namespace shoal::io {

// Throws where the file requires an extension that is not read.
void checkExtensions(const GltfDocument& document);

// materials; the images they use are decoded into model.images.
void readGltfMaterials(GltfDocument& document, Model& model);

// meshes; needs the materials.
void readGltfMeshes(GltfDocument& document, Model& model);

// cameras, lights, skins and nodes, parents first; needs the meshes. Returns the place in model.nodes of each of the
// file's nodes.
std::vector<int> readGltfNodes(GltfDocument& document, Model& model);

// animations; needs the nodes.
void readGltfAnimations(GltfDocument& document, Model& model, std::span<const int> placeOfNode);

// A primitive as a file gives it (strips and fans already unrolled) made to keep Model's promises; also used for other
// formats. `fault` says what was repaired, "" for nothing.
std::string finishPrimitive(Primitive& primitive, const Material* material);

}  // namespace shoal::io
