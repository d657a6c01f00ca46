// Whole files in and out. A write never harms what stood there before: it goes beside the old file, then is renamed
// over it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <shoal/core/result.h>

namespace shoal::io {

// The extension of `path` with its dot, in small letters: ".exr" of "out/F.EXR".
std::string lowerExtension(const std::filesystem::path& path);

// The largest file readFile takes.
inline constexpr std::uintmax_t kFileSizeLimit = std::uintmax_t(4) << 30;

// All bytes of a file. Errors: missing, a folder, not a plain file, empty, unreadable, larger than kFileSizeLimit.
Result<std::vector<std::byte>> readFile(const std::filesystem::path& path);

// Writes beside `path` and renames; the old file stays whole when anything fails. Missing parent folders are made.
// Errors: a folder stands there, a parent is not a folder, the folder cannot be written, the disk is full.
Result<void> writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view text);

// For writers that need a path: they write to temporaryPath(), then commit() renames it to the path it stands for.
// Dropped without commit, the temporary file is removed and the old file stays.
class AtomicFile {
public:
    // Makes an empty file with a unique name beside `path`, with the same extension; errors as writeFileAtomically.
    static Result<AtomicFile> open(const std::filesystem::path& path);

    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&& other) noexcept;
    ~AtomicFile();

    const std::filesystem::path& path() const { return path_; }
    const std::filesystem::path& temporaryPath() const { return temporary_; }
    Result<void> commit();

private:
    AtomicFile(std::filesystem::path path, std::filesystem::path temporary);
    void discard() noexcept;
    std::filesystem::path path_, temporary_;  // temporary_ is empty after commit
};

}  // namespace shoal::io
