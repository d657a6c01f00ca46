// Names, includes and compiler messages of shaders; no context needed.
#include "gl/shader_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <shoal/gl/device.h>
#include <shoal/gl/program.h>
#include <shoal/gl/shaders.h>

#include "gl/device_state.h"
#include "gl/embedded_shader.h"
#include "support/shader_folder.h"

namespace shoal::gl {
namespace {

using test::ShaderFolder;

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
    return n;
}

TEST(ShaderSource, IncludesAFileOnceAndKeepsItsPlace) {
    const ShaderFolder folder;
    folder.write("t/shaders/a.comp",
                 "#version 450 core\n#include \"t/b.lib.glsl\"\n  #  include \"t/c.lib.glsl\" // twice\r\nlast\n");
    folder.write("t/shaders/b.lib.glsl", "#include \"t/c.lib.glsl\"\nbee\n");
    folder.write("t/shaders/c.lib.glsl", "sea\n");
    const auto flat = flattenShader("t/a.comp", folder.path());
    ASSERT_TRUE(flat) << flat.error().message;
    EXPECT_EQ(flat->files, (std::vector<std::string>{"t/a.comp", "t/b.lib.glsl", "t/c.lib.glsl"}));
    EXPECT_EQ(flat->text,
              "#version 450 core\n#line 100001 1\n#line 200001 2\nsea\n#line 100002 1\nbee\n#line 3 0\n\nlast\n");
}

TEST(ShaderSource, TakesAFileThatIncludesItselfOnce) {
    const ShaderFolder folder;
    folder.write("t/shaders/a.comp", "#version 450 core\n#include \"t/b.lib.glsl\"\n");
    folder.write("t/shaders/b.lib.glsl", "#include \"t/b.lib.glsl\"\n#include \"t/a.comp\"\nbee\n");
    const auto flat = flattenShader("t/a.comp", folder.path());
    ASSERT_TRUE(flat) << flat.error().message;
    EXPECT_EQ(count(flat->text, "bee"), 1u);
    EXPECT_EQ(count(flat->text, "#version"), 1u);
}

TEST(ShaderSource, LeavesIncludesOfCppAlone) {
    const ShaderFolder folder;
    folder.write("t/shaders/x.shared.h", "#ifdef __cplusplus\n#include <cstdint>\n#endif\n");
    const auto flat = flattenShader("t/x.shared.h", folder.path());
    ASSERT_TRUE(flat);
    EXPECT_EQ(flat->text, "#ifdef __cplusplus\n#include <cstdint>\n#endif\n");
}

TEST(ShaderSource, NamesTheLineOfAMissingInclude) {
    const ShaderFolder folder;
    folder.write("t/shaders/a.comp", "#version 450 core\n#include \"t/b.lib.glsl\"\n");
    folder.write("t/shaders/b.lib.glsl", "\n\n#include \"t/gone.lib.glsl\"\n");
    const auto flat = flattenShader("t/a.comp", folder.path());
    ASSERT_FALSE(flat);
    EXPECT_EQ(flat.error().message, "t/b.lib.glsl:3: error: no shader named \"t/gone.lib.glsl\"");
}

TEST(ShaderSource, NamesAMissingShader) {
    const auto flat = flattenShader("nowhere/a.comp");
    ASSERT_FALSE(flat);
    EXPECT_EQ(flat.error().message, "nowhere/a.comp: no such shader is embedded");
}

TEST(ShaderSource, FindsFoldersAtAnyDepthAndLongNames) {
    const ShaderFolder folder;
    folder.write("t/sub/shaders/a.comp", "deep");
    folder.write("t/shaders/b.comp.glsl", "long");
    folder.write("t/shaders/sub/c.comp", "below");
    EXPECT_EQ(shaderText("t/sub/a.comp", folder.path()), "deep");
    EXPECT_EQ(shaderText("t/b.comp", folder.path()), "long");
    EXPECT_EQ(shaderText("t/b.comp.glsl", folder.path()), "long");
    EXPECT_EQ(shaderText("t/sub/c.comp", folder.path()), "below");
    EXPECT_EQ(shaderText("t/d.comp", folder.path()), std::nullopt);
}

TEST(ShaderSource, RegistersTablesOnceAndPrefersTheFolder) {
    static const EmbeddedShader table[] = {{"reg/one.comp", "embedded one", 12},
                                           {"reg/two.lib.glsl", "embedded two", 12}};
    registerShaders(table);
    registerShaders(table);
    registerShaders({});
    const auto names = embeddedShaderNames();
    EXPECT_EQ(std::count(names.begin(), names.end(), "reg/one.comp"), 1);
    EXPECT_EQ(std::count(names.begin(), names.end(), "reg/two.lib.glsl"), 0) << "not an entry point";
    const ShaderFolder folder;
    EXPECT_EQ(shaderText("reg/one.comp", folder.path()), "embedded one") << "what the folder lacks";
    folder.write("reg/shaders/one.comp", "from the folder");
    EXPECT_EQ(shaderText("reg/one.comp", folder.path()), "from the folder");
    EXPECT_EQ(shaderText("reg/one.comp", ""), "embedded one");
}

TEST(ShaderSource, KnowsStages) {
    EXPECT_EQ(shaderStage("frame/shade.comp"), "comp");
    EXPECT_EQ(shaderStage("frame/shade.frag.glsl"), "frag");
    EXPECT_EQ(shaderStage("frame/shade.vert"), "vert");
    for (const char* none : {"frame/x.lib.glsl", "frame/x.io.glsl", "frame/x.shared.h", "comp", ".", ""})
        EXPECT_EQ(shaderStage(none), "") << none;
}

TEST(ShaderSource, PutsNamesIntoEveryCompilersMessages) {
    const std::vector<std::string> files = {"t/a.comp", "t/b.lib.glsl"};
    EXPECT_EQ(nameLogPlaces("0:12(3): error: `K' undeclared\n", files), "t/a.comp:12: error: `K' undeclared");
    EXPECT_EQ(nameLogPlaces("1:100007(3): warning: w\n0:100008(1): error: e\n", files),
              "t/b.lib.glsl:7: warning: w\nt/b.lib.glsl:8: error: e");
    EXPECT_EQ(nameLogPlaces("1(100012) : error C1503: undefined variable \"K\"", files),
              "t/b.lib.glsl:12: error C1503: undefined variable \"K\"");
    EXPECT_EQ(nameLogPlaces("ERROR: 1:100012: 'K' : undeclared identifier", files),
              "t/b.lib.glsl:12: error: 'K' : undeclared identifier");
    EXPECT_EQ(nameLogPlaces("7:3(1): error: e", files), "7:3(1): error: e") << "a number without a file";
    EXPECT_EQ(nameLogPlaces(std::string("no place here \0", 15), files), "no place here");
    EXPECT_EQ(nameLogPlaces("0:", files), "0:");
    EXPECT_EQ(nameLogPlaces("99999999999999999999:1(1): x", files), "99999999999999999999:1(1): x");
}

TEST(ShaderSource, PutsDefinesAfterTheVersion) {
    EXPECT_EQ(withDefines("// head\n#version 450 core\nx\n", {{"A", "1"}, {"B", ""}}),
              "// head\n#version 450 core\n#define A 1\n#define B \n#line 3 0\nx\n");
    EXPECT_EQ(withDefines("#version 450 core", {{"A", "1"}}), "#version 450 core\n#define A 1\n#line 2 0\n");
    EXPECT_EQ(withDefines("#version 450 core\nx\n", {}), "#version 450 core\nx\n");
}

TEST(ShaderSource, AFolderThatIsNoneIsBadInputBeforeAnyDevice) {
    const auto device = Device::create({.device = "auto", .log = {}, .shaderDir = "/nonexistent/shaders"});
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().kind, ErrorKind::badInput);
    EXPECT_EQ(device.error().message,
              "DeviceOptions::shaderDir: \"/nonexistent/shaders\" is not a folder; expected one that is laid "
              "out as shoal's src/");
}

TEST(Renderer, SoftwareIsKnownByItsName) {
    EXPECT_TRUE(isSoftwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
    EXPECT_TRUE(isSoftwareRenderer("softpipe"));
    EXPECT_TRUE(isSoftwareRenderer("Software Rasterizer"));
    EXPECT_FALSE(isSoftwareRenderer("NVIDIA H100 80GB HBM3/PCIe/SSE2"));
    EXPECT_FALSE(isSoftwareRenderer("AMD Radeon RX 6600 (navi23, LLVM 15.0.6, DRM 3.49)"));
}

}  // namespace
}  // namespace shoal::gl
