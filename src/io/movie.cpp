#include <shoal/io/movie.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <shoal/io/file.h>
#include <shoal/io/image.h>

extern char** environ;

namespace shoal::io {
namespace {

constexpr double kLargestRate = 1000;  // frames a second

void closeFd(int& fd) {
    if (fd >= 0) ::close(std::exchange(fd, -1));
}

// ffmpeg's command line: RGB0 frames on stdin to one H.264 file. Nothing in it depends on the machine or the time.
std::vector<std::string> commandLine(const MovieOptions& options, const std::string& file, const std::string& container,
                                     int width, int height, double fps) {
    return {
        options.program, "-hide_banner", "-nostdin", "-loglevel", "error", "-y",
        // what comes in
        "-f", "rawvideo", "-pixel_format", "rgb0", "-video_size", fmt::format("{}x{}", width, height), "-framerate",
        fmt::format("{}", fps), "-i", "pipe:0",
        // full-range RGB to limited-range BT.709; exact rounding is the same on every processor
        "-vf",
        "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format=yuv420p",
        "-an", "-c:v", "libx264", "-preset", options.preset, "-crf", std::to_string(options.crf), "-threads",
        std::to_string(options.threads), "-color_range", "tv", "-colorspace", "bt709", "-color_primaries", "bt709",
        "-color_trc", "bt709", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", "-movflags",
        "+faststart", "-f", container, file};
}

// The last line that says something.
std::string lastLine(int fd) {
    std::string text;
    char buffer[4096];
    ::lseek(fd, 0, SEEK_SET);
    for (ssize_t n; (n = ::read(fd, buffer, sizeof buffer)) > 0;) text.append(buffer, std::size_t(n));
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
    const std::size_t start = text.find_last_of("\n\r");
    return start == std::string::npos ? text : text.substr(start + 1);
}

// 0 or errno. `in` and `err` become the program's stdin and stderr. It gets a process group of its own: ^C at the
// terminal is for us to handle, and then ffmpeg still has its frames.
int spawn(const std::vector<std::string>& words, int in, int err, pid_t& pid) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    sigset_t none, defaults;
    sigemptyset(&none);
    sigemptyset(&defaults);
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM}) sigaddset(&defaults, signal);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    const int code = posix_spawnp(&pid, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return code;
}

}  // namespace

struct Movie::State {
    AtomicFile file;
    std::string name, program;
    int width, height;
    std::size_t frameCount = 0;
    int in = -1;   // ours: frames go here. A socket, because send() can be told not to raise SIGPIPE
    int err = -1;  // what ffmpeg said
    pid_t pid = -1;

    State(AtomicFile file, std::string name, std::string program, int width, int height)
        : file(std::move(file)), name(std::move(name)), program(std::move(program)), width(width), height(height) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (pid > 0) ::kill(pid, SIGKILL);
        wait();
        closeFd(in);
        closeFd(err);
    }

    // The exit status as waitpid gives it; -1 where it is not known.
    int wait() {
        int status = -1;
        if (pid > 0)
            while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
            }
        pid = -1;
        return status;
    }

    Error failed(int status) const {
        const std::string said = lastLine(err);
        std::string how = "failed";
        if (status != -1 && WIFEXITED(status)) how = fmt::format("exited with {}", WEXITSTATUS(status));
        if (status != -1 && WIFSIGNALED(status)) how = fmt::format("was stopped by signal {}", WTERMSIG(status));
        return badInput(fmt::format("{}: {} {}{}{}", name, program, how, said.empty() ? "" : ": ", said));
    }

    Result<void> send(std::span<const std::uint8_t> bytes) {
        while (!bytes.empty()) {
            const ssize_t n = ::send(in, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) {  // it closed its end: it has ended, or is about to
                closeFd(in);
                return failed(wait());
            }
            bytes = bytes.subspan(std::size_t(n));
        }
        return {};
    }
};

Movie::Movie(std::unique_ptr<State> state) : state_(std::move(state)) {}
Movie::Movie(Movie&&) noexcept = default;
Movie& Movie::operator=(Movie&&) noexcept = default;
Movie::~Movie() = default;

bool isMovieFile(const std::filesystem::path& path) {
    const std::string extension = lowerExtension(path);
    return extension == ".mp4" || extension == ".m4v" || extension == ".mov";
}

namespace {

Result<std::string> containerOf(const std::filesystem::path& path) {
    if (isMovieFile(path)) return std::string(lowerExtension(path) == ".mov" ? "mov" : "mp4");
    return badInput(fmt::format("{}: found the extension \"{}\", expected .mp4, .m4v or .mov", path.string(),
                                path.extension().string()));
}

Result<void> checkSize(const std::string& name, int width, int height) {
    if (width < 2 || height < 2 || width > kImageSideLimit || height > kImageSideLimit)
        return badInput(fmt::format("{}: a movie of {} x {} pixels, expected 2 .. {} a side", name, width, height,
                                    kImageSideLimit));
    if (width % 2 != 0 || height % 2 != 0)
        return badInput(fmt::format("{}: a movie of {} x {} pixels, expected even numbers such as {} x {}", name, width,
                                    height, width & ~1, height & ~1));
    return {};
}

}  // namespace

Result<Movie> Movie::open(const std::filesystem::path& path, int width, int height, double fps,
                          const MovieOptions& options) {
    const std::string name = path.string();
    SHOAL_TRY_ASSIGN(const std::string container, containerOf(path));
    SHOAL_TRY(checkSize(name, width, height));
    if (!(fps > 0 && fps <= kLargestRate))
        return badInput(
            fmt::format("{}: {} frames a second, expected more than 0 and at most {}", name, fps, kLargestRate));
    if (options.crf < 0 || options.crf > 51)
        return badInput(fmt::format("{}: crf {}, expected 0 .. 51", name, options.crf));

    SHOAL_TRY_ASSIGN(AtomicFile file, AtomicFile::open(path));
    auto state = std::make_unique<State>(std::move(file), name, options.program, width, height);
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return internalError(fmt::format("{}: no socket: {}", name, std::generic_category().message(errno)));
    state->in = ends[0];
    state->err = ::memfd_create("shoal-ffmpeg", MFD_CLOEXEC);
    if (state->err < 0) {
        closeFd(ends[1]);
        return internalError(fmt::format("{}: no memory file: {}", name, std::generic_category().message(errno)));
    }
    // An absolute path: a name that starts with '-' or holds a ':' would mean something to ffmpeg.
    std::error_code error;
    const std::filesystem::path target = std::filesystem::absolute(state->file.temporaryPath(), error);
    const std::vector<std::string> words =
        commandLine(options, "file:" + target.string(), container, width, height, fps);
    const int code = spawn(words, ends[1], state->err, state->pid);
    closeFd(ends[1]);
    if (code == ENOENT)
        return badInput(
            fmt::format("{}: movies need the program {}, which was not found (Debian: apt-get install ffmpeg)", name,
                        options.program));
    if (code != 0)
        return badInput(
            fmt::format("{}: cannot start {}: {}", name, options.program, std::generic_category().message(code)));
    return Movie(std::move(state));
}

Result<void> Movie::add(const ByteImage& frame) {
    SHOAL_ASSERT_MSG(state_ != nullptr, "Movie::add() after finish()");
    State& state = *state_;
    if (frame.width != state.width || frame.height != state.height)
        return badInput(fmt::format("{}: frame {} has {} x {} pixels, expected {} x {}", state.name, state.frameCount,
                                    frame.width, frame.height, state.width, state.height));
    if (state.in < 0) return badInput(fmt::format("{}: {} has ended already", state.name, state.program));
    SHOAL_TRY(state.send(frame.pixels));
    ++state.frameCount;
    return {};
}

Result<void> Movie::finish() {
    SHOAL_ASSERT_MSG(state_ != nullptr, "Movie::finish() called twice");
    const std::unique_ptr<State> state = std::move(state_);
    if (state->frameCount == 0) return badInput(fmt::format("{}: a movie without a frame", state->name));
    if (state->in < 0) return badInput(fmt::format("{}: {} has ended already", state->name, state->program));
    closeFd(state->in);
    const int status = state->wait();
    if (status == -1 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) return state->failed(status);
    return state->file.commit();
}

}  // namespace shoal::io
