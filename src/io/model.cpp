#include <shoal/io/model.h>

#include <fmt/format.h>

#include <shoal/io/file.h>

#include "io/assimp_model.h"

namespace shoal::io {

namespace {

bool isGltf(const std::string& extension) { return extension == ".gltf" || extension == ".glb"; }

}  // namespace

bool isModelFile(const std::filesystem::path& path) {
    const std::string extension = lowerExtension(path);
    return isGltf(extension) || isAssimpExtension(extension);
}

Result<Model> readModel(const std::filesystem::path& path, const ModelReadOptions& options) {
    const std::string extension = lowerExtension(path);
    if (!isGltf(extension) && !isAssimpExtension(extension))
        return badInput(
            fmt::format("{}: unknown model format \"{}\", expected .gltf, .glb, .obj, .ply, .stl, .fbx, .dae, "
                        ".3ds or another that assimp reads",
                        path.string(), extension));
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, readFile(path));
    if (!isGltf(extension)) return readAssimp(path, bytes, options);
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    return readGltf(bytes, folder, path.string(), options);
}

}  // namespace shoal::io
