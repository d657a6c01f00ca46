#include "bench/peers/web_caustics.h"

#include <epoxy/gl.h>

#include <cmath>
#include <cstring>

#include <shoal/gl/shaders.h>

#include "gl/embedded_shader.h"

namespace shoal::bench {

namespace {

constexpr const char* kVertex = R"(#version 450 core
#include "water/optics.lib.glsl"
#include "water/waves.io.glsl"
layout(location = 0) in vec2 place;   // metres
layout(location = 0) uniform vec3 patchSize;   // period, depth, index
layout(location = 0) out vec3 before;
layout(location = 1) out vec3 after;

vec3 onFloor(vec3 from, vec3 direction) { return from + direction * ((from.y + patchSize.y) / -direction.y); }

void main() {
    vec3 wave = waveSlopeAt(place);
    vec3 light = vec3(0.0, -1.0, 0.0);
    before = onFloor(vec3(place.x, 0.0, place.y), light);
    vec3 bent = refractedDirection(light, normalize(vec3(-wave.y, 1.0, -wave.z)), patchSize.z);
    after = onFloor(vec3(place.x, wave.x, place.y), bent);
    gl_Position = vec4(after.xz / patchSize.x * 2.0 - 1.0, 0.5, 1.0);
}
)";

// The product of two lengths is the area of a rectangle; a triangle that is sheared or thin has less. Ratios beyond
// 1000 (a triangle seen from its edge) are cut, or one pixel decides the mean.
constexpr const char* kFragment = R"(#version 450 core
layout(location = 0) in vec3 before;
layout(location = 1) in vec3 after;
layout(location = 0) out float irradiance;

void main() {
    float oldArea = length(dFdx(before)) * length(dFdy(before));
    float newArea = length(dFdx(after)) * length(dFdy(after));
    irradiance = min(oldArea / max(newArea, 1e-20), 1000.0);
}
)";

void registerPeerShaders() {
    static const gl::EmbeddedShader shaders[] = {
        {"bench/web_caustics.frag", kFragment, unsigned(std::strlen(kFragment))},
        {"bench/web_caustics.vert", kVertex, unsigned(std::strlen(kVertex))}};
    gl::registerShaders(shaders);
}

}  // namespace

Result<WebCaustics> WebCaustics::create(gl::Device& device, const WebFormula& formula, const WebPatch& patch) {
    registerPeerShaders();
    WebCaustics web;
    web.formula_ = formula;
    web.patch_ = patch;
    SHOAL_TRY_ASSIGN(web.program_, device.programs().get(
                                       {{"bench/web_caustics.vert", "bench/web_caustics.frag"}, {}, "web caustics"}));
    const float cell = patch.periodM / float(formula.meshSide);
    const int margin = int(std::ceil(patch.marginM / cell)), side = formula.meshSide + 2 * margin + 1;
    std::vector<Vec2> points;
    std::vector<std::uint32_t> indices;
    for (int z = 0; z < side; ++z)
        for (int x = 0; x < side; ++x) {
            points.push_back({float(x - margin) * cell, float(z - margin) * cell});
            if (x + 1 == side || z + 1 == side) continue;
            const auto at = [&](int dx, int dz) { return std::uint32_t((z + dz) * side + x + dx); };
            for (const std::uint32_t i : {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)})
                indices.push_back(i);
        }
    web.points_ = gl::Buffer::of<Vec2>(device, points, "web caustics mesh");
    web.indices_ = gl::Buffer::of<std::uint32_t>(device, indices, "web caustics mesh");
    const gl::VertexAttribute place{.location = 0, .buffer = 0, .componentCount = 2};
    web.mesh_ = gl::VertexArray::create(device, std::span(&place, 1), "web caustics");
    web.mesh_.setBuffer(0, web.points_.view(), int(sizeof(Vec2)));
    web.mesh_.setIndices(web.indices_.view());
    web.indexCount_ = int(indices.size());
    gl::TextureDesc desc;
    desc.format = GL_R32F;
    desc.width = desc.height = formula.mapSide;
    desc.label = "web caustics";
    web.map_ = gl::Texture::create(device, desc);
    if (!web.points_ || !web.indices_ || !web.map_)
        return internalError("no memory for the web formulas' mesh and map");
    const gl::Framebuffer::Attachment color[] = {{web.map_.view()}};
    SHOAL_TRY_ASSIGN(web.target_, gl::Framebuffer::create(device, color, {}, "web caustics"));
    return web;
}

void WebCaustics::render(const water::GpuWaves& waves) const {
    gl::setKnownState();
    const GLfloat dark[4] = {0, 0, 0, 0};
    glClearNamedFramebufferfv(target_.name(), GL_COLOR, 0, dark);
    target_.bind();
    if (formula_.additive) {
        glEnable(GL_BLEND);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(GL_ONE, GL_ONE);
    }
    waves.bind();
    program_->set(0, Vec3{patch_.periodM, patch_.depth, patch_.index});
    program_->use();
    mesh_.bind();
    glDrawElements(GL_TRIANGLES, indexCount_, GL_UNSIGNED_INT, nullptr);
    glDisable(GL_BLEND);
}

std::vector<double> WebCaustics::bins(int side) const {
    const int map = formula_.mapSide, ratio = map / side;
    SHOAL_ASSERT_MSG(ratio * side == map, "bins must divide the map");
    std::vector<float> texels(std::size_t(map) * std::size_t(map));
    map_.read(GL_RED, GL_FLOAT, std::as_writable_bytes(std::span(texels)));
    std::vector<double> sums(std::size_t(side) * std::size_t(side), 0.0);
    for (int z = 0; z < map; ++z)
        for (int x = 0; x < map; ++x)
            sums[std::size_t(z / ratio) * std::size_t(side) + std::size_t(x / ratio)] +=
                double(texels[std::size_t(z) * std::size_t(map) + std::size_t(x)]) / (double(ratio) * ratio);
    return sums;
}

}  // namespace shoal::bench
