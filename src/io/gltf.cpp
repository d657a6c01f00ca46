// The glTF 2.0 reader. Specification: Khronos Group, "glTF 2.0 Specification" (2021), §3 and the extensions named
// beside the parts that read them. Why not a ready-made loader: docs/decisions/0003-gltf-reader.md.
#include <exception>
#include <new>

#include <fmt/format.h>

#include <shoal/core/parallel.h>
#include <shoal/io/model.h>

#include "io/gltf_parts.h"
#include "io/model_axes.h"

namespace shoal::io {

namespace {

void readGeometry(GltfDocument& document, Model& model) {
    readGltfMeshes(document, model);
    const std::vector<int> placeOfNode = readGltfNodes(document, model);
    readGltfAnimations(document, model, placeOfNode);
}

Model readDocument(GltfDocument& document) {
    Model model;
    checkExtensions(document);
    std::vector<GltfImage> images = readGltfMaterials(document, model);
    // Images take about as long as everything else: both at the same time.
    std::exception_ptr failure;
    parallelFor(images.size() + 1, 1, [&](std::size_t i) {
        try {
            if (i)
                decodeGltfImage(document, images[i - 1]);
            else
                readGeometry(document, model);
        } catch (...) {
            if (i)
                images[i - 1].decoded = internalError(images[i - 1].json.path() + ": cannot be decoded");
            else
                failure = std::current_exception();
        }
    });
    if (failure) std::rethrow_exception(failure);
    takeGltfImages(document, images, model);
    return model;
}

}  // namespace

Result<Model> readGltf(std::span<const std::byte> bytes, const std::filesystem::path& baseDir, const std::string& name,
                       const ModelReadOptions& options) {
    try {
        GltfDocument document(bytes, baseDir, name, options.log);
        Model model = readDocument(document);
        model.name = std::filesystem::path(name).stem().string();
        const Quat upright = options.up == UpAxis::z ? axisAngle({1, 0, 0}, -kPi / 2) : Quat{};
        applyAxes(model, upright, options.scale > 0 ? options.scale : 1);
        if (options.flipWinding) flipWinding(model);
        return model;
    } catch (const GltfError& error) {
        return badInput(fmt::format("{}: {}", name, error.message));
    } catch (const std::bad_alloc&) {
        return badInput(fmt::format("{}: not enough memory", name));
    } catch (const std::exception& error) {
        return internalError(fmt::format("{}: {}", name, error.what()));
    }
}

}  // namespace shoal::io
