// The parts of the assimp reader that stand in files of their own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <shoal/core/log.h>
#include <shoal/core/model.h>

struct aiScene;

namespace shoal::io {

// What a PLY's, OFF's or binary STL's header says that its size cannot hold; "" where nothing is wrong. `extension` in
// lower case with its dot.
std::string headerFault(const std::string& extension, std::span<const std::byte> bytes);

// Materials, and the images they use: embedded ones or those found beside `path`. What cannot be found or decoded is
// left out with a warning.
void readAssimpMaterials(const aiScene& scene, const std::filesystem::path& path, const LogSink& log, Model& model);

}  // namespace shoal::io
