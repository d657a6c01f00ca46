// What the sample in OpenSceneGraph draws, in that engine's own terms: shapes under water, programs, textures.
#pragma once

#include <osg/Geometry>
#include <osg/Program>
#include <osg/ShapeDrawable>
#include <osg/Texture2D>

inline constexpr int kWidth = 960, kHeight = 540;

inline osg::ref_ptr<osg::Program> program(const char* vertex, const char* fragment) {
    osg::ref_ptr<osg::Program> p = new osg::Program;
    p->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    p->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return p;
}

inline osg::ref_ptr<osg::Group> makeScene() {
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
    return scene;
}

inline osg::ref_ptr<osg::Texture2D> makeTexture(GLint format, GLenum source = GL_RGBA) {
    osg::ref_ptr<osg::Texture2D> t = new osg::Texture2D;
    t->setTextureSize(kWidth, kHeight), t->setInternalFormat(format);
    t->setSourceFormat(source), t->setSourceType(GL_FLOAT);
    t->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    t->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    return t;
}
