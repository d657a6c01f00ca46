// Model formats other than glTF, through assimp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <shoal/io/model.h>

namespace shoal::io {

// `extension` in lower case with its dot: ".obj".
bool isAssimpExtension(const std::string& extension);

// `bytes` is the file's content, for checks; materials and images are looked up beside `path`.
Result<Model> readAssimp(const std::filesystem::path& path, std::span<const std::byte> bytes,
                         const ModelReadOptions& options);

}  // namespace shoal::io
