// shoal compare
#include <cmath>
#include <cstdio>

#include <shoal/core/compare.h>
#include <shoal/core/params.h>
#include <shoal/io/image.h>

#include "verbs.h"

namespace shoal::app {

namespace {

Result<Image> readLayer(const std::string& file, const std::string& name) {
    SHOAL_TRY_ASSIGN(std::vector<Layer> layers, io::readLayers(file));
    std::vector<std::string> known;
    for (Layer& layer : layers) {
        if (layer.name == name) return std::move(layer.image);
        known.push_back(layer.name);
    }
    return usageError("--layer: " + file + ": " + unknownWord("layer", name, known));
}

// PNG and JPEG are compared by their stored values, EXR and HDR by their radiance.
Result<Image> readForCompare(const std::string& file, const std::string& layer) {
    if (!layer.empty()) return readLayer(file, layer);
    const auto format = io::imageFormatOf(std::filesystem::path(file));
    if (format && (*format == io::ImageFormat::exr || *format == io::ImageFormat::hdr)) return io::readImage(file);
    SHOAL_TRY_ASSIGN(const ByteImage bytes, io::readByteImage(file));
    Image image(bytes.width, bytes.height, 4);
    for (std::size_t i = 0; i < bytes.pixels.size(); ++i) image.pixels[i] = float(bytes.pixels[i]) / 255.0f;
    return image;
}

Image firstChannels(const Image& from, int channelCount) {
    Image to(from.width, from.height, channelCount);
    for (int y = 0; y < from.height; ++y)
        for (int x = 0; x < from.width; ++x) std::copy_n(from.at(x, y), channelCount, to.at(x, y));
    return to;
}

Result<void> writeDifference(const CompareOptions& o, const Image& a, const Image& b) {
    Image difference = differenceImage(firstChannels(a, std::min(a.channelCount, 3)),
                                       firstChannels(b, std::min(b.channelCount, 3)), float(o.gain));
    const auto format = io::imageFormatOf(std::filesystem::path(o.differenceFile));
    if (format == io::ImageFormat::exr)
        return io::writeExr(o.differenceFile, std::vector<Layer>{{"", std::move(difference)}}, {});
    ByteImage bytes(difference.width, difference.height);
    for (int y = 0; y < difference.height; ++y)
        for (int x = 0; x < difference.width; ++x)
            for (int c = 0; c < 4; ++c) {
                const float value = c == 3 ? 1.0f : difference.at(x, y)[std::min(c, difference.channelCount - 1)];
                bytes.pixels[(std::size_t(y) * std::size_t(bytes.width) + std::size_t(x)) * 4 + std::size_t(c)] =
                    std::uint8_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
            }
    return io::writeByteImage(o.differenceFile, bytes);
}

Result<int> run(const CompareOptions& o) {
    SHOAL_TRY_ASSIGN(Image a, readForCompare(o.a, o.layer));
    SHOAL_TRY_ASSIGN(Image b, readForCompare(o.b, o.layer));
    // RGB against RGBA: the colours are what both have.
    const int channels = std::min(a.channelCount, b.channelCount);
    if (a.channelCount != b.channelCount && channels == 3) a = firstChannels(a, 3), b = firstChannels(b, 3);
    auto compared = shoal::compare(a, b);
    if (!compared) return badInput(o.a + " and " + o.b + ": " + compared.error().message);
    const Comparison& c = *compared;
    std::printf(
        "rmse %.8g\npsnr %.4f dB\nssim %.6f\nlargest %.8g at (%d, %d)\nmean %.8g and %.8g\ndiffering pixels %zu of "
        "%zu\n",
        c.rmse, c.psnr, c.ssim, c.largest, c.largestX, c.largestY, c.meanA, c.meanB, c.differingPixels,
        std::size_t(a.width) * std::size_t(a.height));
    if (!o.differenceFile.empty()) SHOAL_TRY(writeDifference(o, a, b));
    int exit = kDone;
    const auto fail = [&](const char* what, double found, const char* relation, double limit) {
        std::printf("FAILED: %s %.8g is %s %.8g\n", what, found, relation, limit);
        exit = kComparisonFailed;
    };
    if (c.nonFinite > 0) fail("values that are not finite:", double(c.nonFinite), "above", 0);
    if (o.maxRmse && !(c.rmse <= *o.maxRmse)) fail("rmse", c.rmse, "above", *o.maxRmse);
    if (o.minPsnr && !(c.psnr >= *o.minPsnr)) fail("psnr", c.psnr, "below", *o.minPsnr);
    if (o.minSsim && !(c.ssim >= *o.minSsim)) fail("ssim", c.ssim, "below", *o.minSsim);
    if (o.maxError && !(c.largest <= *o.maxError)) fail("largest difference", c.largest, "above", *o.maxError);
    return exit;
}

}  // namespace

int compare(const CompareOptions& options) {
    const Result<int> exit = run(options);
    return exit ? *exit : report(exit.error());
}

}  // namespace shoal::app
