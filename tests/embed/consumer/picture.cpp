// Draws a picture the way an embedding program does: a device, the pipeline, a scene; only installed headers.
#include <cstdio>
#include <fstream>
#include <set>

#include <shoal/gl/device.h>
#include <shoal/io/image.h>
#include <shoal/pipeline/pipeline.h>

namespace {

shoal::Result<std::size_t> drawAndCountColors(const char* scene, const char* file) {
    SHOAL_TRY_ASSIGN(const auto device, shoal::gl::Device::create());
    SHOAL_TRY_ASSIGN(const auto pipeline, shoal::pipeline::Pipeline::create(*device));
    SHOAL_TRY(pipeline->open(scene));
    shoal::pipeline::FrameRequest request;
    request.width = 160;
    request.height = 90;
    SHOAL_TRY(pipeline->render(request));
    SHOAL_TRY_ASSIGN(const shoal::ByteImage picture, pipeline->readDisplay());
    SHOAL_TRY(shoal::io::writePng(file, picture));
    std::set<unsigned> colors;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
        colors.insert(picture.pixels[i] << 16u | picture.pixels[i + 1] << 8u | picture.pixels[i + 2]);
    return colors.size();
}

}  // namespace

int main() {
    std::ofstream("scene.toml") << "[[shape]]\nkind = \"plane\"\n[[shape]]\nkind = \"sphere\"\n";
    const auto colors = drawAndCountColors("scene.toml", "picture.png");
    if (!colors) {
        std::fprintf(stderr, "%s\n", colors.error().message.c_str());
        return 1;
    }
    std::printf("picture.png has %zu colours\n", *colors);
    return *colors > 100 ? 0 : 1;
}
