// Caustics and god rays in an engine that is not ours: OpenSceneGraph draws its scene graph into its own textures, Shoal
// is handed those with the camera and the sun, and OpenSceneGraph composes the picture.
//   sample_water_in_openscenegraph [FRAMES [PICTURE.png]]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <epoxy/gl.h>

#include <osg/ClipControl>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osg/Texture2D>
#include <osgDB/WriteFile>
#include <osgUtil/SceneView>
#include <osgViewer/Viewer>

#include <shoal/water/water.h>

namespace {

using namespace shoal;
constexpr int kWidth = 960, kHeight = 540;

const char* kVertex = R"(#version 450 compatibility
out vec3 normal; out vec4 color; out float viewDepth;
uniform mat4 worldFromView;
void main() {
    normal = mat3(worldFromView) * (gl_NormalMatrix * gl_Normal);
    color = gl_Color;
    viewDepth = -(gl_ModelViewMatrix * gl_Vertex).z;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";
const char* kSurface = R"(#version 450 compatibility
in vec3 normal; in vec4 color; in float viewDepth;
layout(location = 0) out vec4 outAlbedo; layout(location = 1) out vec2 outNormal; layout(location = 2) out float outViewDepth;
void main() {
    vec3 n = normalize(normal);
    n /= abs(n.x) + abs(n.y) + abs(n.z);   // octahedral [Cigolle et al. 2014]
    vec2 signs = vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    outNormal = 0.5 + 0.5 * (n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * signs);
    outAlbedo = color;
    outViewDepth = viewDepth;
})";
const char* kScreen = R"(#version 450 compatibility
void main() { gl_Position = vec4(gl_Vertex.xy, 0.5, 1.0); })";
const char* kCompose = R"(#version 450 compatibility
uniform sampler2D albedo, viewDepth, direct, ambient, inscatter;
uniform vec3 attenuation; uniform vec2 tangent;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float z = texelFetch(viewDepth, at, 0).x;
    vec2 ray = (gl_FragCoord.xy / vec2(textureSize(viewDepth, 0)) * 2.0 - 1.0) * tangent;
    vec3 lit = texelFetch(albedo, at, 0).rgb * (texelFetch(direct, at, 0).rgb / 3.14159265 + texelFetch(ambient, at, 0).rgb);
    vec3 radiance = lit * exp(-attenuation * z * length(vec3(ray, 1.0))) * (z > 0.0 ? 1.0 : 0.0) + texelFetch(inscatter, at, 0).rgb;
    gl_FragColor = vec4(pow(1.0 - exp(-1.2 * radiance), vec3(1.0 / 2.2)), 1.0);
})";

osg::ref_ptr<osg::Program> program(const char* vertex, const char* fragment) {
    osg::ref_ptr<osg::Program> p = new osg::Program;
    p->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    p->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return p;
}

osg::ref_ptr<osg::Group> makeScene() {
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    const auto add = [&](osg::Shape* shape, osg::Vec4 color) {
        osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
        drawable->setColor(color);
        scene->addChild(drawable);
    };
    add(new osg::Box({0, -5.1f, 0}, 80, 0.2f, 80), {0.6f, 0.55f, 0.42f, 1});
    add(new osg::Sphere({0, -4, -2}, 1), {0.5f, 0.12f, 0.1f, 1});
    add(new osg::Box({2.6f, -3.4f, -3}, 0.8f, 3.2f, 0.8f), {0.45f, 0.45f, 0.42f, 1});
    add(new osg::Box({-2.6f, -3.4f, -4}, 0.8f, 3.2f, 0.8f), {0.45f, 0.45f, 0.42f, 1});
    add(new osg::Sphere({1, -2, -0.5f}, 0.3f), {0.8f, 0.5f, 0.05f, 1});
    return scene;
}

osg::ref_ptr<osg::Texture2D> makeTexture(GLint format, GLenum source, GLenum type) {
    osg::ref_ptr<osg::Texture2D> t = new osg::Texture2D;
    t->setTextureSize(kWidth, kHeight), t->setInternalFormat(format), t->setSourceFormat(source), t->setSourceType(type);
    t->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST), t->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    return t;
}

struct Textures {
    osg::ref_ptr<osg::Texture2D> albedo = makeTexture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE), normal = makeTexture(GL_RG16, GL_RG, GL_UNSIGNED_SHORT),
                                 viewDepth = makeTexture(GL_R32F, GL_RED, GL_FLOAT), depth = makeTexture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT),
                                 direct = makeTexture(GL_RGBA16F, GL_RGBA, GL_FLOAT), ambient = makeTexture(GL_RGBA16F, GL_RGBA, GL_FLOAT),
                                 inscatter = makeTexture(GL_RGBA16F, GL_RGBA, GL_FLOAT);
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
        texture.apply(state);   // makes it where it is not drawn to
        return {texture.getTextureObject(state.getContextID())->id(), GL_TEXTURE_2D, GLenum(texture.getInternalFormat()), kWidth, kHeight};
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
        lightView->setState(info.getState()), lightView->setSceneData(scene), lightView->setFrameStamp(info.getState()->getFrameStamp());
        lightView->setComputeNearFarMode(osgUtil::CullVisitor::DO_NOT_COMPUTE_NEAR_FAR);
        lightView->setCullingMode(osg::CullSettings::NO_CULLING);
        lightView->getCamera()->setClearMask(0);
        lightView->setViewport(0, 0, needed.view.width, needed.view.height);
        lightView->setProjectionMatrix(matrix(needed.view.clipFromView)), lightView->setViewMatrix(matrix(needed.view.viewFromWorld));
        lightView->cull();
        glBindFramebuffer(GL_FRAMEBUFFER, needed.framebuffer);
        const float nothing = 0;
        glClearBufferfv(GL_DEPTH, 0, &nothing);
        if (!needed.peel) lightView->draw();
    }
    void operator()(osg::RenderInfo& info) const override {
        osg::State& state = *info.getState();
        if (!water)
            if (const auto started = start(); !started) error = started.error().message;
        if (!water) return;
        const gl::TextureView viewDepth = shared(*textures.viewDepth, state), normal = shared(*textures.normal, state), depth = shared(*textures.depth, state);
        const gl::TextureView direct = shared(*textures.direct, state), ambient = shared(*textures.ambient, state), inscatter = shared(*textures.inscatter, state);
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
            water->light(context, lights, {viewDepth, normal}, {direct, ambient});
            water->scatter(context, {}, lights, viewDepth, depth, inscatter);
        }
        state.reset();   // what OpenSceneGraph believes about GL is from before
    }
};

int run(int frameCount, const char* picture) {
    osg::ref_ptr<LightInWater> shoalsTurn = new LightInWater;
    shoalsTurn->scene = makeScene();
    const Textures& t = shoalsTurn->textures;
    osg::StateSet* reversed = shoalsTurn->scene->getOrCreateStateSet();   // depth 1 near, 0 far, as Shoal's views
    reversed->setAttributeAndModes(new osg::Depth(osg::Depth::GREATER));
    reversed->setAttributeAndModes(new osg::ClipControl(osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE));
    reversed->setAttributeAndModes(program(kVertex, kSurface));
    osg::ref_ptr<osg::Uniform> worldFromView = new osg::Uniform("worldFromView", osg::Matrixf());
    reversed->addUniform(worldFromView);

    osg::ref_ptr<osg::Camera> surfaces = new osg::Camera;   // into textures, before the window
    surfaces->setRenderOrder(osg::Camera::PRE_RENDER), surfaces->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    surfaces->setReferenceFrame(osg::Transform::ABSOLUTE_RF), surfaces->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    surfaces->setViewport(0, 0, kWidth, kHeight), surfaces->setClearDepth(0), surfaces->setClearColor({0, 0, 0, 0});
    surfaces->attach(osg::Camera::COLOR_BUFFER0, t.albedo), surfaces->attach(osg::Camera::COLOR_BUFFER1, t.normal);
    surfaces->attach(osg::Camera::COLOR_BUFFER2, t.viewDepth), surfaces->attach(osg::Camera::DEPTH_BUFFER, t.depth);
    surfaces->addChild(shoalsTurn->scene), surfaces->setFinalDrawCallback(shoalsTurn);

    osg::ref_ptr<osg::Geometry> screen = osg::createTexturedQuadGeometry({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    osg::StateSet* compose = screen->getOrCreateStateSet();
    screen->setCullingActive(false);
    compose->setAttributeAndModes(program(kScreen, kCompose));
    compose->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    const std::pair<const char*, osg::Texture2D*> inputs[] = {{"albedo", t.albedo}, {"viewDepth", t.viewDepth}, {"direct", t.direct}, {"ambient", t.ambient}, {"inscatter", t.inscatter}};
    for (int unit = 0; unit < 5; ++unit) compose->setTextureAttributeAndModes(unit, inputs[unit].second), compose->addUniform(new osg::Uniform(inputs[unit].first, unit));
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
    osg::ref_ptr<osg::Image> image = new osg::Image;
    viewer.realize();
    if (!viewer.isRealized()) return std::fprintf(stderr, "sample_water_in_openscenegraph: no window could be opened\n"), 1;
    for (int frame = 0; !viewer.done() && (frameCount == 0 || frame < frameCount); ++frame) {
        const float turn = 0.1f * std::sin(float(frame) / 30);
        shoalsTurn->frame = frame;
        shoalsTurn->view = light::makeView(light::cameraLookingAt({5 * std::sin(turn), -3, 5}, {0, -2.6f, -2}, fov), kWidth, kHeight);
        surfaces->setViewMatrix(matrix(shoalsTurn->view.viewFromWorld)), surfaces->setProjectionMatrix(matrix(shoalsTurn->view.clipFromView));
        worldFromView->set(osg::Matrixf(matrix(shoalsTurn->view.worldFromView)));
        if (frame + 1 == frameCount && picture) image->allocateImage(kWidth, kHeight, 1, GL_RGB, GL_UNSIGNED_BYTE), viewer.getCamera()->attach(osg::Camera::COLOR_BUFFER, image);
        viewer.frame();
        if (!shoalsTurn->error.empty()) return std::fprintf(stderr, "sample_water_in_openscenegraph: %s\n", shoalsTurn->error.c_str()), 1;
    }
    return picture && !osgDB::writeImageFile(*image, picture) ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) { return run(argc > 1 ? std::atoi(argv[1]) : 0, argc > 2 ? argv[2] : nullptr); }
