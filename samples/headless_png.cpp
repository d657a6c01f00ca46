// A picture without a window or a screen: opens a scene or model, draws it once and saves it.
//   sample_headless_png SCENE_OR_MODEL FILE.png
#include <cstdio>

#include <shoal/gl/device.h>
#include <shoal/io/image.h>
#include <shoal/pipeline/pipeline.h>

namespace {

shoal::Result<void> draw(const char* scene, const char* file) {
    SHOAL_TRY_ASSIGN(const auto device, shoal::gl::Device::create());
    SHOAL_TRY_ASSIGN(const auto pipeline, shoal::pipeline::Pipeline::create(*device));
    SHOAL_TRY(pipeline->open(scene));
    SHOAL_TRY(pipeline->render({}));
    SHOAL_TRY_ASSIGN(const shoal::ByteImage picture, pipeline->readDisplay());
    return shoal::io::writePng(file, picture);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: sample_headless_png SCENE_OR_MODEL FILE.png\n");
        return 2;
    }
    const shoal::Result<void> drawn = draw(argv[1], argv[2]);
    if (!drawn) std::fprintf(stderr, "sample_headless_png: %s\n", drawn.error().message.c_str());
    return drawn ? 0 : 1;
}
