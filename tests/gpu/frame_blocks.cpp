// Blocks that C++ and GLSL share: every member lies where the driver says, and the sizes agree.
#include <epoxy/gl.h>

#include <cstddef>
#include <map>

#include "frame/fullscreen.h"
#include "frame/geometry.shared.h"
#include "frame/light.shared.h"
#include "frame/shadow.shared.h"
#include "frame/skin.shared.h"
#include "frame/view.shared.h"
#include "support/gl_device.h"

namespace shoal::frame {
namespace {

struct Member {
    const char* name;
    std::size_t offset;
};

using FrameBlocks = test::GlTest;

int property(GLuint program, GLenum interface, GLuint index, GLenum name) {
    GLint value = -1;
    glGetProgramResourceiv(program, interface, index, 1, &name, 1, nullptr, &value);
    return value;
}

// Compares a uniform block's size and the offsets of its members; `prefix` is what GL puts before a member's name.
void expectUniformBlock(GLuint program, const char* block, const std::string& prefix, std::size_t size,
                        std::initializer_list<Member> members) {
    const GLuint index = glGetProgramResourceIndex(program, GL_UNIFORM_BLOCK, block);
    ASSERT_NE(index, GL_INVALID_INDEX) << block;
    EXPECT_EQ(property(program, GL_UNIFORM_BLOCK, index, GL_BUFFER_DATA_SIZE), int(size)) << block;
    for (const Member& member : members) {
        const GLuint uniform = glGetProgramResourceIndex(program, GL_UNIFORM, (prefix + member.name).c_str());
        ASSERT_NE(uniform, GL_INVALID_INDEX) << block << "." << member.name;
        EXPECT_EQ(property(program, GL_UNIFORM, uniform, GL_OFFSET), int(member.offset)) << block << "." << member.name;
    }
}

// The same for the elements of a storage block's array, found by the end of their names: "[0].tint".
void expectStorageArray(GLuint program, const std::string& arrayElement, std::size_t stride,
                        std::initializer_list<Member> members) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_BUFFER_VARIABLE, GL_ACTIVE_RESOURCES, &count);
    std::map<std::string, GLuint> found;
    for (GLint i = 0; i < count; ++i) {
        char name[256];
        glGetProgramResourceName(program, GL_BUFFER_VARIABLE, GLuint(i), sizeof name, nullptr, name);
        found[name] = GLuint(i);
    }
    for (const Member& member : members) {
        bool seen = false;
        for (const auto& [name, index] : found) {
            const std::string end = arrayElement + "." + member.name;
            if (name.size() < end.size() || name.compare(name.size() - end.size(), end.size(), end) != 0) continue;
            seen = true;
            EXPECT_EQ(property(program, GL_BUFFER_VARIABLE, index, GL_OFFSET), int(member.offset)) << name;
            EXPECT_EQ(property(program, GL_BUFFER_VARIABLE, index, GL_TOP_LEVEL_ARRAY_STRIDE), int(stride)) << name;
        }
        EXPECT_TRUE(seen) << arrayElement << "." << member.name << " is in no storage block";
    }
}

TEST_F(FrameBlocks, UniformBlocksOfShading) {
    registerFrameShaders();
    auto made = fullscreenProgram(device(), "frame/shade.frag", {});
    ASSERT_TRUE(made) << made.error().message;
    const GLuint program = (*made)->name();
    expectUniformBlock(program, "LightBlock", "LightBlock.", sizeof(LightBlock),
                       {{"toSun", offsetof(LightBlock, toSun)},
                        {"sunIrradiance", offsetof(LightBlock, sunIrradiance)},
                        {"sunDisc", offsetof(LightBlock, sunDisc)},
                        {"irradiance[0]", offsetof(LightBlock, irradiance)},
                        {"environment", offsetof(LightBlock, environment)},
                        {"backgroundLevel", offsetof(LightBlock, backgroundLevel)},
                        {"occlusion", offsetof(LightBlock, occlusion)},
                        {"origin", offsetof(LightBlock, origin)},
                        {"rayY", offsetof(LightBlock, rayY)},
                        {"lightCount", offsetof(LightBlock, lightCount)},
                        {"medium", offsetof(LightBlock, medium)}});
    expectUniformBlock(program, "ShadowBlock", "ShadowBlock.", sizeof(ShadowBlock),
                       {{"sunFromWorld", offsetof(ShadowBlock, sunFromWorld)},
                        {"cascadePlace[0]", offsetof(ShadowBlock, cascadePlace)},
                        {"cascadeEnd", offsetof(ShadowBlock, cascadeEnd)},
                        {"sunShape", offsetof(ShadowBlock, sunShape)},
                        {"spotFromWorld[0]", offsetof(ShadowBlock, spotFromWorld)},
                        {"spotPlace[0]", offsetof(ShadowBlock, spotPlace)},
                        {"spotShape", offsetof(ShadowBlock, spotShape)}});
    expectStorageArray(program, "[0]", sizeof(LocalLight),
                       {{"position", offsetof(LocalLight, position)},
                        {"direction", offsetof(LocalLight, direction)},
                        {"intensity", offsetof(LocalLight, intensity)},
                        {"cone", offsetof(LocalLight, cone)}});
}

TEST_F(FrameBlocks, BlocksOfSurfaces) {
    registerFrameShaders();
    auto made = device().programs().get({{"frame/gbuffer.vert", "frame/gbuffer.frag"}, {}, "surfaces"});
    ASSERT_TRUE(made) << made.error().message;
    const GLuint program = (*made)->name();
    expectUniformBlock(program, "ViewBlock", "", sizeof(ViewBlock),
                       {{"clipFromWorld", offsetof(ViewBlock, clipFromWorld)},
                        {"viewFromClip", offsetof(ViewBlock, viewFromClip)},
                        {"worldFromView", offsetof(ViewBlock, worldFromView)},
                        {"previousClipFromWorld", offsetof(ViewBlock, previousClipFromWorld)},
                        {"eye", offsetof(ViewBlock, eye)},
                        {"size", offsetof(ViewBlock, size)},
                        {"depthRange", offsetof(ViewBlock, depthRange)}});
    expectStorageArray(program, "[0]", sizeof(DrawRecord),
                       {{"worldFromModel[0]", offsetof(DrawRecord, worldFromModel)},
                        {"previousFromModel[0]", offsetof(DrawRecord, previousFromModel)},
                        {"tint", offsetof(DrawRecord, tint)},
                        {"objectId", offsetof(DrawRecord, objectId)}});
    expectStorageArray(program, "[0]", sizeof(MaterialRecord),
                       {{"baseColor", offsetof(MaterialRecord, baseColor)},
                        {"surface", offsetof(MaterialRecord, surface)},
                        {"emission", offsetof(MaterialRecord, emission)}});
}

TEST_F(FrameBlocks, ChunksOfSkinning) {
    registerFrameShaders();
    auto made = device().programs().get({{"frame/skin.comp"}, {}, "skinning"});
    ASSERT_TRUE(made) << made.error().message;
    expectStorageArray((*made)->name(), "[0]", sizeof(SkinChunk),
                       {{"vertexCount", offsetof(SkinChunk, vertexCount)},
                        {"targetVertex", offsetof(SkinChunk, targetVertex)},
                        {"morphStride", offsetof(SkinChunk, morphStride)}});
}

}  // namespace
}  // namespace shoal::frame
