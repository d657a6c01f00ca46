// Caustics and god rays in somebody else's renderer: a plain GLFW and OpenGL program with its own shaders, depth and
// camera draws boxes on a sea floor; Shoal is handed depth, normals, view and sun and hands back light.
//   sample_water_in_gl_loop [FRAMES [PICTURE.png]]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <epoxy/gl.h>
#include <GLFW/glfw3.h>

#include <shoal/io/image.h>
#include <shoal/water/water.h>

#include "water_host_shaders.h"

namespace {

using namespace shoal;
constexpr int kWidth = 960, kHeight = 540;

// ---- the host's renderer: unit cubes, moved and scaled ----

struct Box {
    Vec3 center, half, color;
};
const Box kBoxes[] = {
    {{0, -5.1f, 0}, {40, 0.1f, 40}, {0.55f, 0.5f, 0.4f}},
    {{0, -4.2f, -2}, {0.8f, 0.8f, 0.8f}, {0.5f, 0.12f, 0.1f}},
    {{2.4f, -3.5f, -3}, {0.4f, 1.5f, 0.4f}, {0.45f, 0.45f, 0.42f}},
    {{-2.6f, -3.5f, -4}, {0.4f, 1.5f, 0.4f}, {0.45f, 0.45f, 0.42f}},
    {{-0.2f, -1.9f, -3.6f}, {3.2f, 0.2f, 0.7f}, {0.45f, 0.45f, 0.42f}},
};

const char* kNothing = "#version 450 core\nvoid main() {}";

GLuint makeProgram(const char* vertex, const char* fragment) {
    const GLuint program = glCreateProgram();
    for (const auto& [stage, text] : {std::pair{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}}) {
        const GLuint shader = glCreateShader(GLenum(stage));
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    return program;
}

gl::TextureView makeTexture(GLenum format) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, 1, format, kWidth, kHeight);
    return {name, GL_TEXTURE_2D, format, kWidth, kHeight};
}

void drawBoxes(GLuint program, const light::View& view) {
    glUseProgram(program);
    const Mat4 clipFromWorld = view.clipFromWorld();
    glUniformMatrix4fv(0, 1, GL_FALSE, &clipFromWorld.m[0]);
    const Mat4& v = view.viewFromWorld;
    glUniform4f(4, -v(2, 0), -v(2, 1), -v(2, 2), -v(2, 3));
    for (const Box& box : kBoxes) {
        glUniform3fv(1, 1, &box.center.x), glUniform3fv(2, 1, &box.half.x), glUniform3fv(3, 1, &box.color.x);
        glDrawArrays(GL_TRIANGLES, 0, 36);
    }
}

int fail(const Error& error) {
    std::fprintf(stderr, "sample_water_in_gl_loop: %s\n", error.message.c_str());
    return 1;
}

// ---- the loop, and what Shoal is told in it ----

int run(GLFWwindow* window, int frameCount, const char* picture) {
    auto device =
        gl::Device::fromCurrentContext({.device = "auto", .log = stderrSink(), .debug = false, .shaderDir = {}});
    if (!device) return fail(device.error());
    water::WaterSetup setup;
    setup.optics.medium = "jerlov-IB";
    setup.waves.kind = "ocean", setup.waves.windSpeed = 4;
    auto water = water::Water::create(**device, setup);
    if (!water) return fail(water.error());
    const water::WaterParams params;
    light::Sun sun;
    sun.toSun = normalize(Vec3{0.3f, 1, 0.2f});
    const water::BodyLights lights{&sun, {}, {2, 2.4f, 3}};
    Bounds bounds;
    for (const Box& box : kBoxes) bounds.add(box.center - box.half), bounds.add(box.center + box.half);

    const GLuint surfaces = makeProgram(kCubeShader, kSurfaceShader), depthOnly = makeProgram(kCubeShader, kNothing);
    const GLuint compose = makeProgram(kScreenShader, kComposeShader);
    const gl::TextureView albedo = makeTexture(GL_RGBA8), normal = makeTexture(GL_RG16),
                          viewDepth = makeTexture(GL_R32F), depth = makeTexture(GL_DEPTH_COMPONENT32F),
                          direct = makeTexture(GL_RGBA16F), ambient = makeTexture(GL_RGBA16F),
                          inscatter = makeTexture(GL_RGBA16F);
    GLuint gbuffer = 0, vertices = 0;
    glCreateVertexArrays(1, &vertices);
    glCreateFramebuffers(1, &gbuffer);
    const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    for (int i = 0; i < 3; ++i)
        glNamedFramebufferTexture(gbuffer, buffers[i], (i == 0 ? albedo : i == 1 ? normal : viewDepth).name, 0);
    glNamedFramebufferTexture(gbuffer, GL_DEPTH_ATTACHMENT, depth.name, 0);
    glNamedFramebufferDrawBuffers(gbuffer, 3, buffers);

    // The views that Shoal makes have reversed z in [0, 1]; this host draws its own the same way.
    const auto begin = [&](GLuint framebuffer, int width, int height) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glViewport(0, 0, width, height);
        glBindVertexArray(vertices);
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST), glDepthFunc(GL_GREATER), glDepthMask(GL_TRUE), glClearDepth(0),
            glClearColor(0, 0, 0, 0);
        glClear(framebuffer == gbuffer ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT : GL_DEPTH_BUFFER_BIT);
    };
    frame::Context context;
    context.device = device->get();
    for (int frame = 0; !glfwWindowShouldClose(window) && (frameCount == 0 || frame < frameCount); ++frame) {
        glfwPollEvents();
        context.time = float(frame) / 30, context.frameIndex = std::uint32_t(frame);
        const float turn = 0.1f * std::sin(context.time);
        const float fov = radians(60);
        context.view =
            light::makeView(light::cameraLookingAt({5 * std::sin(turn), -3, 5}, {0, -2.6f, -2}, fov), kWidth, kHeight);
        begin(gbuffer, kWidth, kHeight);
        drawBoxes(surfaces, context.view);

        water->prepare(context, params, lights, bounds);
        for (const frame::NeededView& needed : water->neededViews()) {
            begin(needed.framebuffer, needed.view.width, needed.view.height);
            if (!needed.peel) drawBoxes(depthOnly, needed.view);
        }
        {
            const gl::StateGuard guard;  // the host finds its state as it left it
            gl::setKnownState();
            water->renderLight(context, params, lights);
            water->light(context, lights, {viewDepth, normal}, {direct, ambient});
            water->scatter(context, params, lights, viewDepth, depth, inscatter);
        }
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glViewport(0, 0, kWidth, kHeight);
        glDisable(GL_DEPTH_TEST);
        glUseProgram(compose);
        const Vec3 c = water->body().optics.beamAttenuation();
        glUniform3fv(glGetUniformLocation(compose, "attenuation"), 1, &c.x);
        glUniform2f(glGetUniformLocation(compose, "tangent"), std::tan(fov / 2) * kWidth / kHeight, std::tan(fov / 2));
        int unit = 0;
        for (const char* input : {"albedo", "viewDepth", "direct", "ambient", "inscatter"})
            glUniform1i(glGetUniformLocation(compose, input), unit++);
        const GLuint inputs[] = {albedo.name, viewDepth.name, direct.name, ambient.name, inscatter.name};
        glBindTextures(0, 5, inputs);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        if (frame + 1 == frameCount && picture) {
            ByteImage image(kWidth, kHeight);
            std::vector<std::uint8_t> rows(image.pixels.size());
            glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
            for (int y = 0; y < kHeight; ++y)  // the top row first
                std::copy_n(&rows[std::size_t(kHeight - 1 - y) * kWidth * 4], kWidth * 4,
                            &image.pixels[std::size_t(y) * kWidth * 4]);
            if (const auto written = io::writePng(picture, image); !written) return fail(written.error());
        }
        glfwSwapBuffers(window);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    GLFWwindow* window = nullptr;
    if (glfwInit()) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4), glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
        window = glfwCreateWindow(kWidth, kHeight, "Light in water in a GL loop", nullptr, nullptr);
    }
    if (!window) {
        std::fprintf(stderr, "sample_water_in_gl_loop: no window with OpenGL 4.5 could be opened\n");
        return 1;
    }
    glfwMakeContextCurrent(window);
    const int exit = run(window, argc > 1 ? std::atoi(argv[1]) : 0, argc > 2 ? argv[2] : nullptr);
    glfwTerminate();
    return exit;
}
