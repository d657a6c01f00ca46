#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <shoal/core/params.h>

#include "verbs.h"

namespace shoal::app {

int report(const Error& error) {
    std::fprintf(stderr, "shoal: %s\n", error.message.c_str());
    switch (error.kind) {
        case ErrorKind::usage:
            return kUsage;
        case ErrorKind::noDevice:
            return kNoDevice;
        case ErrorKind::cancelled:
            return 130;
        case ErrorKind::badInput:
        case ErrorKind::internal:
            return kBadInput;
    }
    return kBadInput;
}

namespace {

// Reads "A<separator>B" as two integers.
std::optional<std::pair<int, int>> parsePair(const std::string& words, char separator) {
    const std::size_t middle = words.find(separator);
    if (middle == std::string::npos) return {};
    std::pair<int, int> pair;
    const char *begin = words.data(), *mid = begin + middle, *end = begin + words.size();
    const auto a = std::from_chars(begin, mid, pair.first);
    const auto b = std::from_chars(mid + 1, end, pair.second);
    if (a.ec != std::errc() || a.ptr != mid || b.ec != std::errc() || b.ptr != end) return {};
    return pair;
}

}  // namespace

Result<std::unique_ptr<gl::Device>> openDevice(const gl::DeviceOptions& options) {
    auto device = gl::Device::create(options);
    if (device || device.error().kind != ErrorKind::noDevice) return device;
    std::vector<std::string> known = {"auto", "gpu", "cpu"};
    for (const std::string& name : known)
        if (options.device == name) return device;
    for (const gl::DeviceInfo& info : gl::listDevices()) {
        if (options.device == info.name) return device;  // it is there, but cannot be used
        known.push_back(info.name);
    }
    return usageError("--device: " + unknownWord("device", options.device, known) +
                      ", expected what `shoal info --devices` lists");
}

Result<IVec2> parseSize(const std::string& words) {
    const auto pair = parsePair(words, 'x');
    if (!pair || pair->first < 1 || pair->second < 1 || pair->first > 16384 || pair->second > 16384)
        return usageError("--size: found " + words +
                          ", expected WIDTHxHEIGHT with 1 .. 16384 pixels, such as 1280x720");
    return IVec2{pair->first, pair->second};
}

Result<std::pair<int, int>> parseFrames(const std::string& words) {
    const auto pair = parsePair(words, ':');
    if (!pair || pair->first < 0 || pair->second <= pair->first)
        return usageError("--frames: found " + words + ", expected FIRST:END with FIRST below END, such as 0:300");
    return *pair;
}

Result<std::vector<scene::Override>> parseOverrides(const std::vector<std::string>& sets) {
    std::vector<scene::Override> overrides;
    for (const std::string& words : sets) {
        SHOAL_TRY_ASSIGN(scene::Override change, scene::parseOverride(words));
        overrides.push_back(std::move(change));
    }
    return overrides;
}

Result<std::string> scenesFolder() {
    if (const char* given = std::getenv("SHOAL_SCENES")) return std::string(given);
    std::error_code error;
    const std::filesystem::path binary = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path folder = binary.parent_path().parent_path() / "share" / "shoal" / "scenes";
    if (!error && std::filesystem::is_directory(folder, error)) return folder.string();
    return badInput(folder.string() +
                    ": no such folder, expected the shipped scenes there (or name them in SHOAL_SCENES)");
}

}  // namespace shoal::app
