#include <shoal/core/log.h>
#include <cstdio>

namespace shoal {

LogSink stderrSink(LogLevel least) {
    return [least](LogLevel level, std::string_view message) {
        if (level < least) return;
        constexpr const char* kNames[] = {"debug", "info", "warning", "error"};
        // One call a line: stdio locks the stream, so lines of several threads do not mix.
        std::fprintf(stderr, "shoal: %s: %.*s\n", kNames[int(level)], int(message.size()), message.data());
    };
}

LogSink nullSink() {
    return [](LogLevel, std::string_view) {};
}

}  // namespace shoal
