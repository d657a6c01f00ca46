// Frames to files: stills, numbered frames, films, AOVs and camera poses.
#include <optional>

#include <shoal/io/file.h>
#include <shoal/io/image.h>
#include <shoal/io/movie.h>
#include <shoal/io/poses.h>
#include <shoal/pipeline/pipeline.h>

namespace shoal::pipeline {

namespace {

Result<void> checkOutput(const std::string& output, const OutputOptions& options) {
    const std::string extension = io::lowerExtension(output);
    const bool known = io::isMovieFile(output) || extension == ".png" || extension == ".jpg" || extension == ".jpeg" ||
                       extension == ".exr";
    if (!known) return usageError("-o " + output + ": found \"" + extension + "\", expected .png, .jpg, .exr or .mp4");
    if (!options.aovs.empty() && extension != ".exr")
        return usageError("--aov: " + output + " holds one picture, expected an .exr for AOV layers");
    if (options.transparent && extension != ".png" && extension != ".exr")
        return usageError("--transparent: " + extension + " has no transparency, expected .png or .exr");
    return {};
}

Result<void> writeExrFrame(Pipeline& pipeline, const std::string& path) {
    SHOAL_TRY_ASSIGN(Image radiance, pipeline.readRadiance());
    std::vector<Layer> layers;
    layers.push_back({"", std::move(radiance)});
    SHOAL_TRY_ASSIGN(std::vector<Layer> aovs, pipeline.readAovs());
    for (Layer& layer : aovs) layers.push_back(std::move(layer));
    return io::writeExr(path, layers, {});
}

Result<void> writeFrame(Pipeline& pipeline, const std::string& path, const OutputOptions& options) {
    const std::string extension = io::lowerExtension(path);
    if (extension == ".exr") return writeExrFrame(pipeline, path);
    SHOAL_TRY_ASSIGN(const ByteImage picture, pipeline.readDisplay());
    if (extension == ".png") return io::writePng(path, picture, options.transparent);
    return io::writeJpeg(path, picture, options.jpegQuality);
}

}  // namespace

Result<std::vector<std::string>> renderToFile(Pipeline& pipeline, FrameRequest request, const std::string& output,
                                              const OutputOptions& options) {
    SHOAL_TRY(checkOutput(output, options));
    if (!options.isStill && options.endFrame <= options.firstFrame)
        return usageError("--frames: found " + std::to_string(options.firstFrame) + ":" +
                          std::to_string(options.endFrame) + ", expected a first frame below the end");
    // Poses are written last: a place that takes none must be told before there are pictures.
    if (!options.posesFile.empty()) SHOAL_TRY(io::AtomicFile::open(options.posesFile));
    std::optional<io::Movie> movie;
    if (io::isMovieFile(output)) {
        SHOAL_TRY_ASSIGN(movie, io::Movie::open(output, request.width, request.height, double(options.fps), {}));
    }
    pipeline.setAovs(options.aovs);
    std::vector<std::string> written;
    std::vector<io::CameraPose> poses;
    const int first = options.isStill ? 0 : options.firstFrame, end = options.isStill ? 1 : options.endFrame;
    for (int i = first; i < end; ++i) {
        request.frameIndex = std::uint32_t(i - first);
        if (!options.isStill) request.time = options.startTime + float(double(i) / double(options.fps));
        request.timeStep = 1.0f / options.fps;
        SHOAL_TRY(pipeline.render(request));
        if (movie) {
            SHOAL_TRY_ASSIGN(const ByteImage picture, pipeline.readDisplay());
            SHOAL_TRY(movie->add(picture));
        } else {
            std::string path = output;
            if (!options.isStill) {
                SHOAL_TRY_ASSIGN(const std::filesystem::path numbered, io::framePath(output, i));
                path = numbered.string();
            }
            SHOAL_TRY(writeFrame(pipeline, path, options));
            written.push_back(path);
        }
        const Mat4 worldFromView = pipeline.view().worldFromView;
        poses.push_back(
            {request.time, {worldFromView(0, 3), worldFromView(1, 3), worldFromView(2, 3)}, quatOf(worldFromView)});
        if (options.progress && !options.progress(std::uint64_t(i - first + 1), std::uint64_t(end - first)))
            return Error{ErrorKind::cancelled, "stopped after frame " + std::to_string(i)};
    }
    if (movie) {
        SHOAL_TRY(movie->finish());
        written.push_back(output);
    }
    if (!options.posesFile.empty()) {
        SHOAL_TRY(io::writePoses(options.posesFile, poses));
        written.push_back(options.posesFile);
    }
    return written;
}

}  // namespace shoal::pipeline
