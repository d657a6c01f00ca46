// Passes over every pixel of a target: one triangle at depth 0 (shaders/fullscreen.vert).
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <shoal/gl/objects.h>
#include <shoal/gl/program.h>

namespace shoal::frame {

// Which pixels a pass is for. surfaces and background need a framebuffer with the G-buffer's depth.
enum class Where { everywhere, surfaces, background };

class Fullscreen {
public:
    static Fullscreen create(gl::Device& device);
    // Draws into the bound framebuffer. Leaves blending, depth writes, culling, scissor and stencil off, depth test as
    // `where` needs it; blend state is the caller's when `blend`.
    void draw(const gl::Program& program, Where where = Where::everywhere, bool blend = false) const;

private:
    gl::VertexArray nothing_;
};

// What a program variant is compiled with: names[i] where bit i of `variant` is set.
std::vector<std::pair<std::string, std::string>> definesOf(int variant, std::span<const char* const> names);
// The program of fullscreen.vert and a fragment shader "frame/x.frag".
Result<const gl::Program*> fullscreenProgram(gl::Device& device, const std::string& fragment,
                                             std::vector<std::pair<std::string, std::string>> defines = {});

// A texture without mips, sampled nearest, for a pass to draw into; empty where there is no memory (the device logs
// it).
gl::Texture makeTarget(gl::Device& device, gl::Enum format, int width, int height, const char* label, int levels = 1);

// Makes what shoal::frame embeds known to shoal::gl; every create() of this module calls it.
void registerFrameShaders();

}  // namespace shoal::frame
