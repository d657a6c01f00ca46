// Frames to an mp4 (H.264) through the ffmpeg program.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <shoal/core/image.h>
#include <shoal/core/result.h>

namespace shoal::io {

// Whether Movie writes files of this extension (case ignored): .mp4, .m4v, .mov.
bool isMovieFile(const std::filesystem::path& path);

struct MovieOptions {
    int crf = 18;                    // x264 quality, 0 (lossless) .. 51
    std::string preset = "medium";   // of x264: ultrafast .. veryslow
    int threads = 2;                 // of the encoder; the file's bits depend on it, hence fixed
    std::string program = "ffmpeg";  // name looked up in PATH, or a path
};

// The same frames and options give the same bytes. yuv420p, BT.709, limited range, fast start. One thread at a time.
class Movie {
public:
    // Sizes are in pixels and even (yuv420p halves the colour planes); fps in (0, 1000]. Errors: odd or zero size,
    // ffmpeg not found, a path that does not end in .mp4, .m4v or .mov, an unwritable folder.
    static Result<Movie> open(const std::filesystem::path& path, int width, int height, double fps,
                              const MovieOptions& options = {});

    Movie(Movie&&) noexcept;
    Movie& operator=(Movie&&) noexcept;
    ~Movie();  // without finish(): stops ffmpeg and removes what it wrote; an older movie stays

    // Alpha is ignored. Errors: another size than the movie's; ffmpeg's last words when it failed.
    Result<void> add(const ByteImage& frame);
    // Waits for ffmpeg and puts the movie in its place. An error when there was no frame.
    Result<void> finish();

private:
    struct State;
    explicit Movie(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::io
