// Caustics and god rays in an engine that is not ours: OpenSceneGraph draws its scene graph into its own textures,
// Shoal is handed those with the camera and the sun, and OpenSceneGraph composes the picture.
//   sample_water_in_openscenegraph [FRAMES [PICTURE.png]]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <epoxy/gl.h>

#include <osg/ClipControl>
#include <osg/Depth>
#include <osg/MatrixTransform>
#include <osg/Texture2D>
#include <osgDB/WriteFile>
#include <osgUtil/SceneView>
#include <osgViewer/Viewer>

#include <shoal/water/water.h>

#include "water_host_shaders.h"
#include "water_osg_scene.h"

namespace {

using namespace shoal;

struct Textures {
    osg::ref_ptr<osg::Texture2D> albedo = makeTexture(GL_RGBA8), normal = makeTexture(GL_RG16),
                                 direct = makeTexture(GL_RGBA16F), ambient = makeTexture(GL_RGBA16F),
                                 inscatter = makeTexture(GL_RGBA16F), viewDepth = makeTexture(GL_R32F),
                                 depth = makeTexture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT);
};

osg::Matrixd matrix(const Mat4& m) { return osg::Matrixd(m.m.data()); }

// After OpenSceneGraph has drawn its textures: Shoal's turn, in the same context.
struct LightInWater : osg::Camera::DrawCallback {
    Textures textures;
    osg::ref_ptr<osg::Group> scene;
    light::View view;
    int frame = 0;
    mutable std::unique_ptr<gl::Device> device;
    mutable std::optional<water::Water> water;
    mutable std::string error;
    Vec3 attenuation = water::resolveOptics({}).value().beamAttenuation();

    gl::TextureView shared(osg::Texture2D& texture, osg::State& state) const {
        texture.apply(state);  // makes it where it is not drawn to
        return {texture.getTextureObject(state.getContextID())->id(), GL_TEXTURE_2D,
                GLenum(texture.getInternalFormat()), kWidth, kHeight};
    }
    Result<void> start() const {
        SHOAL_TRY_ASSIGN(device, gl::Device::fromCurrentContext());
        water::WaterSetup setup;
        setup.waves.windSpeed = 4;
        SHOAL_TRY_ASSIGN(water, water::Water::create(*device, setup));
        return {};
    }
    // The graph from where a light sees it, into Shoal's framebuffer.
    void drawDepth(osg::RenderInfo& info, const frame::NeededView& needed) const {
        osg::ref_ptr<osgUtil::SceneView> lightView = new osgUtil::SceneView;
        lightView->setDefaults(osgUtil::SceneView::NO_SCENEVIEW_LIGHT);
        lightView->setState(info.getState()), lightView->setSceneData(scene),
            lightView->setFrameStamp(info.getState()->getFrameStamp());
        lightView->setComputeNearFarMode(osgUtil::CullVisitor::DO_NOT_COMPUTE_NEAR_FAR);
        lightView->setCullingMode(osg::CullSettings::NO_CULLING);
        lightView->getCamera()->setClearMask(0), lightView->getCamera()->setDrawBuffer(GL_NONE),
            lightView->getCamera()->setReadBuffer(GL_NONE);
        lightView->setViewport(0, 0, needed.view.width, needed.view.height);
        lightView->setProjectionMatrix(matrix(needed.view.clipFromView)),
            lightView->setViewMatrix(matrix(needed.view.viewFromWorld));
        lightView->cull();
        glBindFramebuffer(GL_FRAMEBUFFER, needed.framebuffer);
        const float nothing = 0;
        glClearBufferfv(GL_DEPTH, 0, &nothing);
        if (!needed.peel) lightView->draw();
    }
    void operator()(osg::RenderInfo& info) const override {
        osg::State& state = *info.getState();
        if (!water)
            if (const auto started = start(); !started) return void(error = started.error().message);
        const auto view2d = [&](osg::Texture2D& texture) { return shared(texture, state); };
        const gl::TextureView viewDepth = view2d(*textures.viewDepth);
        frame::Context context;
        context.device = device.get(), context.view = context.previousView = view;
        context.time = float(frame) / 30, context.frameIndex = std::uint32_t(frame);
        light::Sun sun;
        const water::BodyLights lights{&sun, {}, {2, 2.4f, 3}};
        {
            const gl::StateGuard guard;
            water->prepare(context, {}, lights, {{-40, -5.2f, -40}, {40, 0, 40}});
            for (const frame::NeededView& needed : water->neededViews()) drawDepth(info, needed);
            gl::setKnownState();
            water->renderLight(context, {}, lights);
            water->light(context, lights, {viewDepth, view2d(*textures.normal)},
                         {view2d(*textures.direct), view2d(*textures.ambient)});
            water->scatter(context, {}, lights, viewDepth, view2d(*textures.depth), view2d(*textures.inscatter));
        }
        state.dirtyAllModes(), state.dirtyAllAttributes(), state.dirtyAllVertexArrays();  // it believes what was before
    }
};

// Keeps the window's picture.
struct Capture : osg::Camera::DrawCallback {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    void operator()(osg::RenderInfo&) const override {
        image->readPixels(0, 0, kWidth, kHeight, GL_RGB, GL_UNSIGNED_BYTE);
    }
};

int run(int frameCount, const char* picture) {
    osg::ref_ptr<LightInWater> shoalsTurn = new LightInWater;
    shoalsTurn->scene = makeScene();
    const Textures& t = shoalsTurn->textures;
    osg::StateSet* reversed = shoalsTurn->scene->getOrCreateStateSet();  // depth 1 near, 0 far, as Shoal's views
    reversed->setAttributeAndModes(new osg::Depth(osg::Depth::GREATER));
    reversed->setAttributeAndModes(new osg::ClipControl(osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE));
    reversed->setAttributeAndModes(program(kSceneGraphShader, kSurfaceShader));
    osg::ref_ptr<osg::Uniform> worldFromView = new osg::Uniform("worldFromView", osg::Matrixf());
    reversed->addUniform(worldFromView);

    osg::ref_ptr<osg::Camera> surfaces = new osg::Camera;  // into textures, before the window
    surfaces->setRenderOrder(osg::Camera::PRE_RENDER),
        surfaces->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    surfaces->setReferenceFrame(osg::Transform::ABSOLUTE_RF),
        surfaces->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    surfaces->setViewport(0, 0, kWidth, kHeight), surfaces->setClearDepth(0), surfaces->setClearColor({0, 0, 0, 0});
    surfaces->attach(osg::Camera::COLOR_BUFFER0, t.albedo), surfaces->attach(osg::Camera::COLOR_BUFFER1, t.normal);
    surfaces->attach(osg::Camera::COLOR_BUFFER2, t.viewDepth), surfaces->attach(osg::Camera::DEPTH_BUFFER, t.depth);
    surfaces->addChild(shoalsTurn->scene), surfaces->setFinalDrawCallback(shoalsTurn);

    osg::ref_ptr<osg::Geometry> screen = osg::createTexturedQuadGeometry({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    osg::StateSet* compose = screen->getOrCreateStateSet();
    screen->setCullingActive(false), screen->setUseDisplayList(false);  // a list has no gl_VertexID
    compose->setAttributeAndModes(program(kScreenShader, kComposeShader));
    compose->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    int unit = 0;
    const auto input = [&](const char* name, osg::Texture2D* texture) {
        compose->setTextureAttributeAndModes(unit, texture);
        compose->addUniform(new osg::Uniform(name, unit++));
    };
    input("albedo", t.albedo), input("viewDepth", t.viewDepth), input("direct", t.direct);
    input("ambient", t.ambient), input("inscatter", t.inscatter);
    const Vec3 c = shoalsTurn->attenuation;
    const float fov = radians(60), up = std::tan(fov / 2);
    compose->addUniform(new osg::Uniform("attenuation", osg::Vec3(c.x, c.y, c.z)));
    compose->addUniform(new osg::Uniform("tangent", osg::Vec2(up * kWidth / kHeight, up)));

    osgViewer::Viewer viewer;
    viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    viewer.setUpViewInWindow(0, 0, kWidth, kHeight);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(surfaces), root->addChild(screen);
    viewer.setSceneData(root);
    viewer.getCamera()->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    osg::ref_ptr<Capture> capture = new Capture;
    viewer.realize();
    if (!viewer.isRealized())
        return std::fprintf(stderr, "sample_water_in_openscenegraph: no window could be opened\n"), 1;
    for (int frame = 0; !viewer.done() && (frameCount == 0 || frame < frameCount); ++frame) {
        const float turn = 0.1f * std::sin(float(frame) / 30);
        shoalsTurn->frame = frame;
        shoalsTurn->view =
            light::makeView(light::cameraLookingAt({5 * std::sin(turn), -3, 5}, {0, -2.6f, -2}, fov), kWidth, kHeight);
        surfaces->setViewMatrix(matrix(shoalsTurn->view.viewFromWorld)),
            surfaces->setProjectionMatrix(matrix(shoalsTurn->view.clipFromView));
        worldFromView->set(osg::Matrixf(matrix(shoalsTurn->view.worldFromView)));
        if (frame + 1 == frameCount && picture) viewer.getCamera()->setFinalDrawCallback(capture);
        viewer.frame();
        if (!shoalsTurn->error.empty())
            return std::fprintf(stderr, "sample_water_in_openscenegraph: %s\n", shoalsTurn->error.c_str()), 1;
    }
    viewer.getCamera()->getGraphicsContext()->makeCurrent();  // Shoal's objects go while their context is there
    shoalsTurn->water.reset(), shoalsTurn->device.reset();
    return picture && !osgDB::writeImageFile(*capture->image, picture) ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) { return run(argc > 1 ? std::atoi(argv[1]) : 0, argc > 2 ? argv[2] : nullptr); }
