// The GPU's copy of models and their instances: uploaded once, posed and skinned once a frame, drawn into any view.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <shoal/core/model.h>
#include <shoal/core/pose.h>
#include <shoal/frame/context.h>

namespace shoal::frame {

using ModelId = int;
using InstanceId = int;

struct InstanceDesc {
    ModelId model = -1;
    Mat4 worldFromModel;
    int clip = -1;        // -1: the nodes' own transforms
    float speed = 1;      // clip seconds per scene second
    float startTime = 0;  // clip seconds at scene time 0
    bool loop = true;
    bool castsShadow = true;
    bool visible = true;
    std::uint32_t objectId = 0;  // 0: its index + 1
    std::vector<std::string>
        hiddenNodes;        // names; meshes of these nodes are not drawn (`*` at the end matches any rest)
    Vec4 tint{1, 1, 1, 1};  // times the base colour
};

struct GeometryStats {
    std::int64_t drawnTriangles = 0, draws = 0, instances = 0, skinnedVertices = 0;
};

class Geometry {
public:
    static Result<Geometry> create(gl::Device& device);
    Geometry(Geometry&&) noexcept;
    Geometry& operator=(Geometry&&) noexcept;
    ~Geometry();

    // Uploads meshes, materials and textures (mip chains made). The model may be dropped afterwards.
    Result<ModelId> addModel(const Model& model);
    Result<InstanceId> addInstance(const InstanceDesc& desc);
    void setTransform(InstanceId instance, const Mat4& worldFromModel);
    void setVisible(InstanceId instance, bool visible);
    void clear();  // all models and instances
    // Models added from now on keep a second, coarser set of triangles that contexts marked `draft` may draw.
    void setDraftsWanted(bool wanted);

    // Poses and skins every instance at context.time (and keeps the frame before for motion). Once a frame, before any
    // draw; a second call for the same frameIndex does nothing.
    void update(const Context& context);

    // Draws opaque and masked surfaces into the G-buffer (bound and cleared by the caller).
    void drawSurfaces(const Context& context, const GBuffer& target);
    // Draws what casts shadow into a depth-only view.
    void drawDepth(const Context& context, const NeededView& view);
    // Draws blended and transmitting surfaces back to front into the bound forward framebuffer; lighting blocks and
    // textures are bound by the caller (Lighting::bind).
    void drawTransparent(const Context& context, gl::TextureView opaqueCopy, gl::TextureView viewDepth);
    bool hasTransparent() const;

    // World bounds of everything visible after update(); shadows and default cameras are fitted to it.
    Bounds bounds() const;
    // World bounds of one visible instance, after update().
    Bounds bounds(InstanceId instance) const;
    // Whether anything that `view` sees moved in this update.
    bool changed(const light::View& view) const;
    const GeometryStats& stats() const;  // of the last drawSurfaces

    struct State;

private:
    explicit Geometry(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::frame
