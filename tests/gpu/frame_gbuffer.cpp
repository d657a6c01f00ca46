// The G-buffer of known surfaces: exact albedo, normal, material, identity, depth and motion.
#include <gtest/gtest.h>

#include <shoal/frame/geometry.h>
#include <shoal/frame/targets.h>

#include "frame/glsl_math.h"
#include "support/frame_scene.h"
#include "support/gl_device.h"

namespace shoal::frame {
namespace {

using test::contextOf;
using test::modelOf;
using test::quad;

constexpr int kWidth = 160, kHeight = 90;

class FrameGBuffer : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        gl::setKnownState();
        auto geometry = Geometry::create(device());
        ASSERT_TRUE(geometry) << geometry.error().message;
        geometry_.emplace(*std::move(geometry));
        auto targets = Targets::create(device(), kWidth, kHeight);
        ASSERT_TRUE(targets) << targets.error().message;
        targets_.emplace(*std::move(targets));
    }
    void TearDown() override {
        geometry_.reset();
        targets_.reset();
        GlTest::TearDown();
    }

    InstanceId add(const Model& model, InstanceDesc desc = {}) {
        const auto id = geometry_->addModel(model);
        EXPECT_TRUE(id);
        desc.model = *id;
        const auto instance = geometry_->addInstance(desc);
        EXPECT_TRUE(instance);
        return *instance;
    }

    void draw(const Context& context) {
        geometry_->update(context);
        targets_->beginSurfaces();
        geometry_->drawSurfaces(context, targets_->gbuffer());
        targets_->finishSurfaces(context);
    }

    // What the G-buffer holds at a pixel; y counts from the bottom.
    struct Pixel {
        Vec3 albedo, normal, emission;
        float occlusion, roughness, metallic, f0, depth, viewDepth;
        Vec2 motion;
        std::uint32_t flags, objectId;
    };
    Pixel at(int x, int y) {
        const GBuffer& g = targets_->gbuffer();
        const std::size_t i = std::size_t(y) * std::size_t(g.width) + std::size_t(x);
        const auto albedo = test::readFloats(g.albedo, GL_RGBA, 4);
        const auto normal = test::readFloats(g.normal, GL_RG, 2);
        const auto material = test::readFloats(g.material, GL_RGBA, 4);
        const auto emission = test::readFloats(g.emission, GL_RGB, 3);
        const auto motion = test::readFloats(g.motion, GL_RG, 2);
        const auto depth = test::readFloats(g.depth, GL_DEPTH_COMPONENT, 1);
        const auto viewDepth = test::readFloats(g.viewDepth, GL_RED, 1);
        std::vector<std::uint32_t> ids(depth.size());
        glGetTextureImage(g.objectId.name, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, GLsizei(ids.size() * 4), ids.data());
        const glsl::vec3 a = glsl::decodeAlbedo({albedo[4 * i], albedo[4 * i + 1], albedo[4 * i + 2]});
        const glsl::vec3 n = glsl::decodeNormal({normal[2 * i], normal[2 * i + 1]});
        Pixel p;
        p.albedo = {a.x, a.y, a.z};
        p.occlusion = albedo[4 * i + 3];
        p.normal = {n.x, n.y, n.z};
        p.roughness = material[4 * i], p.metallic = material[4 * i + 1], p.f0 = glsl::decodeF0(material[4 * i + 2]);
        p.flags = glsl::decodeFlags(material[4 * i + 3]);
        p.emission = {emission[3 * i], emission[3 * i + 1], emission[3 * i + 2]};
        p.motion = {motion[2 * i], motion[2 * i + 1]};
        p.depth = depth[i], p.viewDepth = viewDepth[i];
        p.objectId = ids[i];
        return p;
    }

    static light::View looking(Vec3 eye, Vec3 at) {
        return makeView(light::cameraLookingAt(eye, at, radians(60)), kWidth, kHeight);
    }
    // Where a world point lands, pixels from the bottom left corner.
    static Vec2 pixelOf(const light::View& view, Vec3 world) {
        const Vec3 ndc = transformPoint(view.clipFromWorld(), world);
        return {(ndc.x * 0.5f + 0.5f) * float(view.width), (ndc.y * 0.5f + 0.5f) * float(view.height)};
    }

    std::optional<Geometry> geometry_;
    std::optional<Targets> targets_;
};

// 20 m wide and high, facing +z, through the origin.
Primitive wall() { return quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}); }

Material paint() {
    Material m;
    m.baseColor = {0.5f, 0.25f, 0.04f, 1};
    m.metallic = 0.2f, m.roughness = 0.6f;
    m.emission = {0, 2, 0.5f};
    m.ior = 1.5f;
    return m;
}

TEST_F(FrameGBuffer, HoldsAKnownQuadExactly) {
    InstanceDesc desc;
    desc.objectId = 4000000000u;
    add(modelOf({wall()}, {paint()}), desc);
    draw(contextOf(device(), looking({0, 0, 5}, {0, 0, 0})));
    const Pixel p = at(kWidth / 2, kHeight / 2);
    const float step = 1.0f / 255;  // of 8 bits, on the square root
    EXPECT_NEAR(std::sqrt(p.albedo.x), std::sqrt(0.5f), step);
    EXPECT_NEAR(std::sqrt(p.albedo.y), std::sqrt(0.25f), step);
    EXPECT_NEAR(std::sqrt(p.albedo.z), std::sqrt(0.04f), step);
    EXPECT_EQ(p.occlusion, 1);
    EXPECT_NEAR(length(p.normal - Vec3{0, 0, 1}), 0, 1e-4);
    EXPECT_NEAR(p.roughness, 0.6f, step);
    EXPECT_NEAR(p.metallic, 0.2f, step);
    EXPECT_NEAR(p.f0, 0.04f, 0.16f * step);
    EXPECT_EQ(p.flags, 0u);
    EXPECT_NEAR(p.emission.x, 0, 1e-6);
    EXPECT_NEAR(p.emission.y, 2, 2 / 64.0f);     // 6 bits of mantissa
    EXPECT_NEAR(p.emission.z, 0.5f, 0.5f / 32);  // 5 bits
    EXPECT_EQ(p.objectId, 4000000000u);
    EXPECT_NEAR(p.viewDepth, 5, 5e-6);
    EXPECT_EQ(p.motion, (Vec2{0, 0}));
}

TEST_F(FrameGBuffer, LeavesNothingWhereNothingIs) {
    add(modelOf({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}));
    draw(contextOf(device(), looking({0, 0, 5}, {0, 0, 0})));
    const Pixel p = at(1, 1);
    EXPECT_EQ(p.objectId, 0u);
    EXPECT_EQ(p.depth, 0);
    EXPECT_EQ(p.viewDepth, 0);
    EXPECT_EQ(at(kWidth / 2, kHeight / 2).objectId, 1u);
}

// A floor 1.5 m below an eye that looks along it: view depth follows from similar triangles at every pixel.
TEST_F(FrameGBuffer, ViewDepthOfAFloorIsAnalytic) {
    add(modelOf({quad({-2000, 0, 2000}, {4000, 0, 0}, {0, 0, -4000})}));
    const light::View view = looking({0, 1.5f, 0}, {0, 1.5f, -1});
    draw(contextOf(device(), view));
    const auto depth = test::readFloats(targets_->gbuffer().viewDepth, GL_RED, 1);
    const float tangent = std::tan(radians(30));
    for (int y = 0; y < kHeight / 2; ++y) {
        const float below = tangent * (1 - 2 * (float(y) + 0.5f) / kHeight);  // slope of the pixel's ray
        const float expected = 1.5f / below;
        EXPECT_NEAR(depth[std::size_t(y * kWidth + kWidth / 3)], expected, 2e-4f * expected) << "row " << y;
    }
    EXPECT_EQ(depth[std::size_t((kHeight - 1) * kWidth)], 0);
}

TEST_F(FrameGBuffer, OrthographicDepthAndScale) {
    add(modelOf({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}));
    light::Camera camera = light::cameraLookingAt({0, 0, 7}, {0, 0, 0}, radians(50));
    camera.projection = light::Camera::Projection::orthographic;
    camera.heightM = 4;
    camera.farZ = 100;
    draw(contextOf(device(), makeView(camera, kWidth, kHeight)));
    EXPECT_NEAR(at(kWidth / 2, kHeight / 2).viewDepth, 7, 1e-4);
    // 2 m of 4 m: half of the picture's height, in rows and in columns.
    const auto depth = test::readFloats(targets_->gbuffer().viewDepth, GL_RED, 1);
    int columns = 0, rows = 0;
    for (int x = 0; x < kWidth; ++x) columns += depth[std::size_t(kHeight / 2 * kWidth + x)] > 0;
    for (int y = 0; y < kHeight; ++y) rows += depth[std::size_t(y * kWidth + kWidth / 2)] > 0;
    EXPECT_NEAR(columns, kHeight / 2, 1);
    EXPECT_NEAR(rows, kHeight / 2, 1);
}

TEST_F(FrameGBuffer, MotionOfAMovingEyeIsAnalytic) {
    add(modelOf({wall()}));
    Context context = contextOf(device(), looking({0.3f, 0.1f, 5}, {0.2f, 0, 0}));
    context.previousView = looking({0, 0, 5.2f}, {0, 0.1f, 0});
    context.jitterPx = {0.3f, -0.4f};  // motion has none
    draw(context);
    for (const Vec3 world : {Vec3{0, 0, 0}, Vec3{1.5f, -0.8f, 0}, Vec3{-2, 1, 0}}) {
        const Vec2 now = pixelOf(context.view, world), before = pixelOf(context.previousView, world);
        const Pixel p = at(int(now.x), int(now.y));
        // The pixel's centre is another point of the wall, up to half a pixel away, whose motion differs a little.
        EXPECT_NEAR(p.motion.x, now.x - before.x, 0.05f);
        EXPECT_NEAR(p.motion.y, now.y - before.y, 0.05f);
        EXPECT_GT(std::abs(p.motion.x), 0.5f);
    }
}

TEST_F(FrameGBuffer, MotionOfAMovingObjectIsAnalyticAndEndsWithTheMove) {
    const InstanceId id = add(modelOf({wall()}));
    const light::View view = looking({0, 0, 5}, {0, 0, 0});
    draw(contextOf(device(), view, 0));
    EXPECT_EQ(at(80, 45).motion, (Vec2{0, 0}));
    geometry_->setTransform(id, translation({0.25f, -0.125f, 0}));
    draw(contextOf(device(), view, 1));
    const float pixelsPerMetre = float(kHeight) / (2 * 5 * std::tan(radians(30)));
    EXPECT_NEAR(at(80, 45).motion.x, 0.25f * pixelsPerMetre, 0.01f);
    EXPECT_NEAR(at(80, 45).motion.y, -0.125f * pixelsPerMetre, 0.01f);
    EXPECT_TRUE(geometry_->changed(view));
    draw(contextOf(device(), view, 1));  // the same frame once more: nothing moves on
    EXPECT_NEAR(at(80, 45).motion.x, 0.25f * pixelsPerMetre, 0.01f);
    draw(contextOf(device(), view, 2));
    EXPECT_EQ(at(80, 45).motion, (Vec2{0, 0}));
    EXPECT_FALSE(geometry_->changed(view));
}

TEST_F(FrameGBuffer, MirroredInstanceIsNotCulled) {
    add(modelOf({wall()}), {.worldFromModel = scaling({-1, 1, 1}), .hiddenNodes = {}});
    draw(contextOf(device(), looking({0, 0, 5}, {0, 0, 0})));
    EXPECT_EQ(at(80, 45).objectId, 1u);
    EXPECT_NEAR(length(at(80, 45).normal - Vec3{0, 0, 1}), 0, 1e-4);
    // Seen from behind it is gone, as an unmirrored one is.
    draw(contextOf(device(), looking({0, 0, -5}, {0, 0, 0}), 1));
    EXPECT_EQ(at(80, 45).objectId, 0u);
}

TEST_F(FrameGBuffer, DoubleSidedSurfaceTurnsItsNormalToTheEye) {
    Material m = paint();
    m.doubleSided = true;
    add(modelOf({wall()}, {m}));
    draw(contextOf(device(), looking({0, 0, -5}, {0, 0, 0})));
    EXPECT_EQ(at(80, 45).objectId, 1u);
    EXPECT_NEAR(length(at(80, 45).normal - Vec3{0, 0, -1}), 0, 1e-4);
}

TEST_F(FrameGBuffer, NormalsAreRightUnderUnevenScale) {
    // A plane tilted by 45 degrees, stretched to twice its height: its normal follows the inverse transpose.
    add(modelOf({quad({-9, -9, 9}, {18, 0, 0}, {0, 18, -18})}),
        {.worldFromModel = scaling({1, 2, 1}), .hiddenNodes = {}});
    draw(contextOf(device(), looking({0, 3, 9}, {0, 0, 0})));
    EXPECT_NEAR(length(at(80, 45).normal - normalize(Vec3{0, 0.5f, 1})), 0, 1e-4);
}

// The alpha of the texture is 0 on the left, 255 on the right, half way in between it crosses the cutoff.
TEST_F(FrameGBuffer, MaskCutsWhereAlphaCrossesTheCutoff) {
    Model model = modelOf({quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0})}, {paint()});
    ByteImage ramp(256, 1);
    for (int x = 0; x < 256; ++x) {
        for (int c = 0; c < 3; ++c) ramp.pixels[std::size_t(4 * x + c)] = 255;
        ramp.pixels[std::size_t(4 * x + 3)] = std::uint8_t(x);
    }
    model.images.push_back(ramp);
    Material& m = model.materials[0];
    m.alphaMode = AlphaMode::mask;
    m.alphaCutoff = 0.25f;
    m.baseColorTexture.image = 0;
    m.baseColorTexture.wrapU = m.baseColorTexture.wrapV = Wrap::clamp;
    add(model);
    const light::View view = looking({0, 0, 5}, {0, 0, 0});
    draw(contextOf(device(), view));
    std::vector<std::uint32_t> ids(kWidth * kHeight);
    glGetTextureImage(targets_->gbuffer().objectId.name, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, GLsizei(ids.size() * 4),
                      ids.data());
    const float edge = pixelOf(view, {-4 + 8 * (0.25f * 255 + 0.5f) / 256, 0, 0}).x;
    for (int x = 0; x < kWidth; ++x) {
        if (std::abs(float(x) + 0.5f - edge) < 1) continue;
        const float world = (float(x) + 0.5f - kWidth / 2.0f) / (pixelOf(view, {1, 0, 0}).x - kWidth / 2.0f);
        if (std::abs(world) > 3.9f) continue;
        EXPECT_EQ(ids[std::size_t(45 * kWidth + x)], float(x) + 0.5f > edge ? 1u : 0u) << "column " << x;
    }
}

TEST_F(FrameGBuffer, TexturesMapWithTheFirstRowOnTop) {
    Model model = modelOf({wall()}, {Material{}});
    // glTF: v = 0 is the top row. The quad's v grows upwards, so the top row is at its bottom.
    ByteImage image(2, 2);
    const std::uint8_t texels[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}};
    for (int i = 0; i < 4; ++i) {
        std::copy(std::begin(texels[i]), std::end(texels[i]), image.pixels.begin() + 4 * i);
        image.pixels[std::size_t(4 * i + 3)] = 255;
    }
    model.images.push_back(image);
    model.materials[0].baseColorTexture.image = 0;
    model.materials[0].baseColorTexture.nearest = true;
    add(model);
    draw(contextOf(device(), looking({0, 0, 25}, {0, 0, 0})));
    EXPECT_EQ(at(70, 35).albedo, (Vec3{1, 0, 0}));
    EXPECT_EQ(at(90, 35).albedo, (Vec3{0, 1, 0}));
    EXPECT_EQ(at(70, 55).albedo, (Vec3{0, 0, 1}));
    EXPECT_EQ(at(90, 55).albedo, (Vec3{1, 1, 1}));
}

TEST_F(FrameGBuffer, NormalMapTiltsTowardsTangentAndBitangent) {
    Model model = modelOf({wall()}, {Material{}});
    ByteImage image(1, 1);
    // (0.6, 0, 0.8) in the tangent frame.
    image.pixels = {std::uint8_t(128 + 76), 128, std::uint8_t(128 + 102), 255};
    model.images.push_back(image);
    model.materials[0].normalTexture.image = 0;
    model.meshes[0].primitives[0].tangents.assign(4, Vec4{1, 0, 0, 1});
    add(model);
    draw(contextOf(device(), looking({0, 0, 5}, {0, 0, 0})));
    EXPECT_NEAR(length(at(80, 45).normal - Vec3{0.6f, 0, 0.8f}), 0, 0.01f);
}

TEST_F(FrameGBuffer, UnlitSurfaceIsItsOwnRadiance) {
    Material m = paint();
    m.unlit = true;
    add(modelOf({wall()}, {m}));
    draw(contextOf(device(), looking({0, 0, 5}, {0, 0, 0})));
    const Pixel p = at(80, 45);
    EXPECT_EQ(p.flags, kFlagUnlit);
    EXPECT_NEAR(p.emission.x, 0.5f, 0.5f / 64);
    EXPECT_NEAR(p.emission.y, 0.25f, 0.25f / 64);
}

TEST_F(FrameGBuffer, TintAndVertexColourMultiply) {
    Model model = modelOf({wall()}, {Material{}});
    model.meshes[0].primitives[0].colors.assign(4, Vec4{0.5f, 1, 0.25f, 1});
    InstanceDesc desc;
    desc.tint = {0.5f, 0.5f, 1, 1};
    add(model, desc);
    draw(contextOf(device(), looking({0, 0, 5}, {0, 0, 0})));
    const Pixel p = at(80, 45);
    EXPECT_NEAR(p.albedo.x, 0.25f, 0.005f);
    EXPECT_NEAR(p.albedo.y, 0.5f, 0.005f);
    EXPECT_NEAR(p.albedo.z, 0.25f, 0.005f);
}

TEST_F(FrameGBuffer, HiddenNodesAndInvisibleInstancesAreNotDrawn) {
    const light::View view = looking({0, 0, 5}, {0, 0, 0});
    const InstanceId shown = add(modelOf({wall()}));
    InstanceDesc hidden;
    hidden.worldFromModel = translation({0, 0, 1});
    hidden.hiddenNodes = {"no*"};
    add(modelOf({wall()}), hidden);
    draw(contextOf(device(), view, 0));
    EXPECT_EQ(at(80, 45).objectId, 1u);
    geometry_->setVisible(shown, false);
    draw(contextOf(device(), view, 1));
    EXPECT_EQ(at(80, 45).objectId, 0u);
    EXPECT_TRUE(geometry_->changed(view));
    EXPECT_TRUE(geometry_->bounds().empty());
    geometry_->setVisible(shown, true);
    draw(contextOf(device(), view, 2));
    EXPECT_EQ(at(80, 45).objectId, 1u);
}

TEST_F(FrameGBuffer, NothingIsAllocatedAfterTheFirstFrame) {
    const InstanceId id = add(modelOf({wall(), test::box({-1, -1, 1}, {1, 1, 2})}, {paint(), paint()}));
    const light::View view = looking({0, 0, 5}, {0, 0, 0});
    draw(contextOf(device(), view, 0));
    const std::int64_t bytes = device().liveBytes(), objects = device().liveObjectCount();
    for (std::uint32_t frame = 1; frame < 20; ++frame) {
        geometry_->setTransform(id, translation({0.01f * float(frame), 0, 0}));
        draw(contextOf(device(), view, frame));
    }
    EXPECT_EQ(device().liveBytes(), bytes);
    EXPECT_EQ(device().liveObjectCount(), objects);
}

TEST_F(FrameGBuffer, ClearForgetsEverythingAndTakesNewModels) {
    add(modelOf({wall()}, {paint()}));
    const light::View view = looking({0, 0, 5}, {0, 0, 0});
    draw(contextOf(device(), view, 0));
    geometry_->clear();
    draw(contextOf(device(), view, 1));
    EXPECT_EQ(at(80, 45).objectId, 0u);
    Material blue;
    blue.baseColor = {0, 0, 1, 1};
    add(modelOf({wall()}, {blue}));
    draw(contextOf(device(), view, 2));
    EXPECT_EQ(at(80, 45).objectId, 1u);
    EXPECT_EQ(at(80, 45).albedo, (Vec3{0, 0, 1}));
}

TEST_F(FrameGBuffer, RefusesWhatCannotBe) {
    EXPECT_FALSE(Targets::create(device(), 0, 10));
    EXPECT_FALSE(Targets::create(device(), 10, 1 << 20));
    const auto id = geometry_->addModel(modelOf({wall()}));
    ASSERT_TRUE(id);
    InstanceDesc desc;
    desc.model = *id;
    desc.clip = 3;
    EXPECT_FALSE(geometry_->addInstance(desc));
    desc.clip = -1;
    desc.worldFromModel.m[12] = NAN;
    EXPECT_FALSE(geometry_->addInstance(desc));
}

}  // namespace
}  // namespace shoal::frame
