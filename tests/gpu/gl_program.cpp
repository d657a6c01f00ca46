// Programs: compiling, errors with file and line, defines, uniforms, dispatch sizes, reload.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <shoal/gl/program.h>

#include "support/gl_device.h"
#include "support/shader_folder.h"

namespace shoal::gl {
namespace {

// Writes f(i) of t/f.lib.glsl for every i below the buffer's length, and the uniform.
constexpr const char* kComp = R"(#version 450 core
#include "t/f.lib.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Values { uint values[]; };
layout(location = 0) uniform uint offset;
void main() {
    if (gl_GlobalInvocationID.x < values.length())
        values[gl_GlobalInvocationID.x] = f(gl_GlobalInvocationID.x) + offset;
}
)";

class GlProgram : public test::GlTest {
protected:
    void SetUp() override {
        folder.write("t/shaders/a.comp", kComp);
        folder.write("t/shaders/f.lib.glsl", "uint f(uint i) { return i * FACTOR; }\n");
        open(folder.path());
    }
    ProgramDesc desc(const std::string& factor) { return {{"t/a.comp"}, {{"FACTOR", factor}}, "test program"}; }

    std::vector<std::uint32_t> run(const Program& program, int count) {
        Buffer values = Buffer::create(device(), std::size_t(count) * 4, "values");
        values.clear(~0u);
        values.bindStorage(0);
        program.dispatch(count);
        std::vector<std::uint32_t> out(static_cast<std::size_t>(count));
        values.read(0, std::as_writable_bytes(std::span(out)));
        return out;
    }

    test::ShaderFolder folder;
};

TEST_F(GlProgram, RunsOverEveryInvocation) {
    const auto program = device().programs().get(desc("3u"));
    ASSERT_TRUE(program) << program.error().message;
    EXPECT_EQ((*program)->localSize(0), 64);
    EXPECT_EQ((*program)->localSize(1), 1);
    (*program)->set(0, 5u);
    for (int count : {1, 64, 65, 1000}) {
        const auto got = run(**program, count);
        for (int i = 0; i < count; ++i)
            ASSERT_EQ(got[std::size_t(i)], std::uint32_t(i) * 3 + 5) << i << " of " << count;
    }
}

TEST_F(GlProgram, IsBuiltOncePerDefines) {
    const auto a = device().programs().get(desc("3u")), b = device().programs().get(desc("3u")),
               c = device().programs().get(desc("4u"));
    ASSERT_TRUE(a && b && c);
    EXPECT_EQ(*a, *b);
    EXPECT_NE(*a, *c);
    EXPECT_EQ(device().programs().size(), 2u);
}

TEST_F(GlProgram, ErrorsNameFileAndLine) {
    expectedErrorCount = -1;
    folder.write("t/shaders/f.lib.glsl", "// one\n// two\nuint f(uint i) {\n    return i * undeclaredThing;\n}\n");
    const auto program = device().programs().get(desc("3u"));
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().kind, ErrorKind::internal);
    EXPECT_EQ(program.error().message.rfind("t/f.lib.glsl:4: error", 0), 0u) << program.error().message;
    EXPECT_NE(program.error().message.find("undeclaredThing"), std::string::npos) << program.error().message;
}

TEST_F(GlProgram, ErrorsAfterAnIncludeNameTheIncluder) {
    expectedErrorCount = -1;
    std::string text = kComp;
    text.replace(text.find("+ offset"), 8, "+ offsat");
    folder.write("t/shaders/a.comp", text);
    const auto program = device().programs().get(desc("3u"));
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().message.rfind("t/a.comp:8: error", 0), 0u) << program.error().message;
}

TEST_F(GlProgram, LinkErrorsNameTheStages) {
    expectedErrorCount = -1;
    folder.write(
        "t/shaders/a.vert",
        "#version 450 core\nlayout(location = 0) out vec4 v;\nvoid main() { v = vec4(1); gl_Position = v; }\n");
    folder.write("t/shaders/a.frag",
                 "#version 450 core\nlayout(location = 0) in mat4 v;\nlayout(location = 0) out vec4 c;\n"
                 "void main() { c = v[0]; }\n");
    const auto program = device().programs().get({{"t/a.vert", "t/a.frag"}, {}, "mismatch"});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().message.rfind("t/a.vert + t/a.frag: does not link: ", 0), 0u) << program.error().message;
}

TEST_F(GlProgram, ANameThatIsNoStageIsAnError) {
    const auto program = device().programs().get({{"t/f.lib.glsl"}, {}, ""});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().message, "t/f.lib.glsl: not a program stage; expected .vert, .frag, .comp or .geom");
}

TEST_F(GlProgram, ReloadKeepsTheLastGoodVersion) {
    expectedErrorCount = -1;
    const auto program = device().programs().get(desc("3u"));
    ASSERT_TRUE(program) << program.error().message;
    EXPECT_EQ(device().programs().reload(), 0) << "nothing changed";
    folder.write("t/shaders/f.lib.glsl", "uint f(uint i) { return i + FACTOR; }\n");
    EXPECT_EQ(device().programs().reload(), 1);
    EXPECT_EQ(run(**program, 10)[9], 12u);

    folder.write("t/shaders/f.lib.glsl", "uint f(uint i) { return broken; }\n");
    EXPECT_EQ(device().programs().reload(), 0);
    EXPECT_TRUE(messages.contains("test program: keeps its last good version: t/f.lib.glsl:1: error"))
        << messages.all();
    const std::size_t messageCount = messages.lines.size();
    EXPECT_EQ(device().programs().reload(), 0);
    EXPECT_EQ(messages.lines.size(), messageCount) << "the same failure is reported once";
    EXPECT_EQ(run(**program, 10)[9], 12u);

    folder.write("t/shaders/f.lib.glsl", "#include \"t/gone.lib.glsl\"\n");
    EXPECT_EQ(device().programs().reload(), 0);
    EXPECT_TRUE(messages.contains("t/f.lib.glsl:1: error: no shader named")) << messages.all();

    folder.write("t/shaders/f.lib.glsl", "uint f(uint i) { return i * 2u; }\n");
    EXPECT_EQ(device().programs().reload(), 1);
    EXPECT_EQ(run(**program, 10)[9], 18u);
}

TEST_F(GlProgram, SetsEveryKindOfUniform) {
    folder.write("t/shaders/u.comp", R"(#version 450 core
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Values { float values[]; };
layout(location = 0) uniform int i;
layout(location = 1) uniform uint u;
layout(location = 2) uniform float f;
layout(location = 3) uniform vec2 v2;
layout(location = 4) uniform vec3 v3;
layout(location = 5) uniform vec4 v4;
layout(location = 6) uniform mat4 m;
void main() {
    values[0] = float(i); values[1] = float(u); values[2] = f; values[3] = v2.y; values[4] = v3.z; values[5] = v4.w;
    values[6] = m[3][1];   // column 3, row 1
}
)");
    const auto program = device().programs().get({{"t/u.comp"}, {}, ""});
    ASSERT_TRUE(program) << program.error().message;
    const Program& p = **program;
    Mat4 m;
    m(1, 3) = 7;
    p.set(0, -1), p.set(1, 2u), p.set(2, 3.0f), p.set(3, Vec2{0, 4}), p.set(4, Vec3{0, 0, 5}),
        p.set(5, Vec4{0, 0, 0, 6}), p.set(6, m);
    Buffer values = Buffer::create(device(), 28, "values");
    values.bindStorage(0);
    p.dispatch(1);
    std::vector<float> got(7);
    values.read(0, std::as_writable_bytes(std::span(got)));
    EXPECT_EQ(got, (std::vector<float>{-1, 2, 3, 4, 5, 6, 7}));
}

}  // namespace
}  // namespace shoal::gl
