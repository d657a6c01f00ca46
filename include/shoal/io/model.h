// Models in: glTF 2.0 (.gltf, .glb) through our own reader, everything else (OBJ, PLY, STL, FBX, Collada, 3DS, ...)
// through assimp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <shoal/core/log.h>
#include <shoal/core/model.h>
#include <shoal/core/result.h>

namespace shoal::io {

// Which axis of the file points up. automatic: what the file says, else what its format prescribes (glTF, OBJ, PLY: y).
enum class UpAxis { automatic, y, z };

struct ModelReadOptions {
    UpAxis up = UpAxis::automatic;
    float scale = 0;           // metres a file unit; 0: the file's own unit, metres where it names none
    bool flipWinding = false;  // turns every triangle and normal over: for files whose surfaces face inwards
    LogSink log;               // told what was left out or repaired; may be empty
};

// What the decoded model may take in memory, all arrays and images together.
inline constexpr std::size_t kModelByteLimit = std::size_t(1) << 31;

// Reads a model by the extension of `path`. What Model promises holds for the result: indices are valid, normals are
// unit length, weights sum to 1, key times increase.
// - Only nodes of the default scene show something; the others keep their place in the tree, with mesh = -1.
// - glTF without normals gets flat ones, other formats smooth ones that keep edges sharper than 40 degrees. Tangents
//   are made where a material has a normal map and the file has no tangents.
// - Model::images has only images that a material uses.
// - Another up axis or unit becomes one extra root node named "axes and unit".
// Errors: one line with the file, the place in it, what was found and what was expected.
Result<Model> readModel(const std::filesystem::path& path, const ModelReadOptions& options = {});

// The same from a .gltf or .glb in memory. `name` stands in messages. Files it refers to are looked up relative to
// `baseDir`; with an empty baseDir they are errors.
Result<Model> readGltf(std::span<const std::byte> bytes, const std::filesystem::path& baseDir, const std::string& name,
                       const ModelReadOptions& options = {});

// Whether readModel knows the extension of `path` (case ignored).
bool isModelFile(const std::filesystem::path& path);

}  // namespace shoal::io
