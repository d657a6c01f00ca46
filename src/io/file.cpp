#include <shoal/io/file.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>

#include <fmt/format.h>

namespace shoal::io {
namespace {

namespace fs = std::filesystem;

std::string errnoWords(int code) { return std::generic_category().message(code); }

// A file descriptor that closes itself.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return fd_; }
    // False where close reports a failed write (a full disk on a network file system).
    bool close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }

private:
    int fd_;
};

// 0, or errno.
int readAll(int fd, std::span<std::byte> to, std::size_t& got) {
    for (got = 0; got < to.size();) {
        const ssize_t n = ::read(fd, to.data() + got, to.size() - got);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        if (n == 0) break;
        got += std::size_t(n);
    }
    return 0;
}

int writeAll(int fd, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        bytes = bytes.subspan(std::size_t(n));
    }
    return 0;
}

Error cannotWrite(const fs::path& path, const std::string& why) {
    return badInput(fmt::format("{}: cannot be written: {}", path.string(), why));
}

// Makes the folder of `path`; says which of its parents is in the way where one is not a folder.
Result<void> makeParent(const fs::path& path) {
    const fs::path folder = path.parent_path();
    if (folder.empty()) return {};
    std::error_code error;
    fs::create_directories(folder, error);
    if (fs::is_directory(folder)) return {};
    for (fs::path up = folder; !up.empty() && up != up.parent_path(); up = up.parent_path()) {
        std::error_code ignored;
        const fs::file_status status = fs::status(up, ignored);
        if (fs::exists(status) && !fs::is_directory(status))
            return cannotWrite(path, fmt::format("{} is not a folder", up.string()));
    }
    return cannotWrite(path, fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

// What may be replaced: nothing there yet, or a plain file that its owner lets us write.
Result<void> checkTarget(const fs::path& path) {
    if (path.empty()) return badInput("the name of the file to write is empty");
    if (path.filename().empty()) return cannotWrite(path, "it names a folder");
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) return {};
    if (fs::is_directory(status)) return cannotWrite(path, "it is a folder");
    if (!fs::is_regular_file(status)) return cannotWrite(path, "it is not a plain file");
    if (::access(path.c_str(), W_OK) != 0) return cannotWrite(path, errnoWords(errno));
    return {};
}

// Creates the file with O_EXCL under a name that no other writer has, in any process.
Result<fs::path> createBeside(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    for (int attempt = 0; attempt < 1000; ++attempt) {
        const std::string name =
            fmt::format(".{}.{}-{}.tmp{}", path.stem().string(), ::getpid(), counter++, path.extension().string());
        const fs::path candidate = path.parent_path() / name;
        Descriptor file(::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        if (file.get() >= 0) {
            // A replaced file keeps its permissions.
            struct stat old = {};
            if (::stat(path.c_str(), &old) == 0 && ::fchmod(file.get(), old.st_mode & 0777) != 0) {
                // Its owner is somebody else: the new file keeps the usual permissions.
            }
            return candidate;
        }
        if (errno != EEXIST) return cannotWrite(path, errnoWords(errno));
    }
    return cannotWrite(path, "no free name for a temporary file beside it");
}

}  // namespace

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

Result<std::vector<std::byte>> readFile(const fs::path& path) {
    const std::string name = path.string();
    if (name.empty()) return badInput("the name of the file to read is empty");
    // O_NONBLOCK: opening a named pipe must not wait for a writer.
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.get() < 0) {
        if (errno == ENOENT) return badInput(fmt::format("{}: no such file", name));
        return badInput(fmt::format("{}: cannot be read: {}", name, errnoWords(errno)));
    }
    struct stat status = {};
    if (::fstat(file.get(), &status) != 0)
        return badInput(fmt::format("{}: cannot be read: {}", name, errnoWords(errno)));
    if (S_ISDIR(status.st_mode)) return badInput(fmt::format("{}: is a folder, expected a file", name));
    if (!S_ISREG(status.st_mode)) return badInput(fmt::format("{}: is not a plain file", name));
    if (status.st_size == 0) return badInput(fmt::format("{}: the file is empty", name));
    if (std::uintmax_t(status.st_size) > kFileSizeLimit)
        return badInput(
            fmt::format("{}: {} bytes, the limit is {} (4 GiB)", name, std::int64_t(status.st_size), kFileSizeLimit));

    std::vector<std::byte> bytes(std::size_t(status.st_size));
    std::size_t got = 0;
    if (const int code = readAll(file.get(), bytes, got); code != 0)
        return badInput(fmt::format("{}: cannot be read: {}", name, errnoWords(code)));
    if (got != bytes.size())
        return badInput(fmt::format("{}: read {} bytes, expected {}: the file is changing", name, got, bytes.size()));
    return bytes;
}

Result<void> writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
    SHOAL_TRY_ASSIGN(AtomicFile file, AtomicFile::open(path));
    Descriptor to(::open(file.temporaryPath().c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
    if (to.get() < 0) return cannotWrite(path, errnoWords(errno));
    if (const int code = writeAll(to.get(), bytes); code != 0) return cannotWrite(path, errnoWords(code));
    if (!to.close()) return cannotWrite(path, errnoWords(errno));
    return file.commit();
}

Result<void> writeFileAtomically(const fs::path& path, std::string_view text) {
    return writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

AtomicFile::AtomicFile(fs::path path, fs::path temporary) : path_(std::move(path)), temporary_(std::move(temporary)) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
    if (this != &other) {
        discard();
        path_ = std::move(other.path_);
        temporary_ = std::exchange(other.temporary_, {});
    }
    return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    temporary_.clear();
}

Result<AtomicFile> AtomicFile::open(const fs::path& path) {
    // A link stays a link: what it points at is replaced.
    std::error_code error;
    fs::path target = path;
    if (fs::is_symlink(path, error)) {
        target = fs::weakly_canonical(path, error);
        if (error) return cannotWrite(path, error.message());
    }
    SHOAL_TRY(checkTarget(target));
    SHOAL_TRY(makeParent(target));
    SHOAL_TRY_ASSIGN(fs::path temporary, createBeside(target));
    return AtomicFile(std::move(target), std::move(temporary));
}

Result<void> AtomicFile::commit() {
    SHOAL_ASSERT_MSG(!temporary_.empty(), "AtomicFile::commit() called twice");
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) return cannotWrite(path_, errnoWords(errno));
    temporary_.clear();
    return {};
}

}  // namespace shoal::io
