// Where messages go. The library never writes to stdout; a device or pipeline is given a sink.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace shoal {

enum class LogLevel { debug, info, warning, error };

// Called from any thread that makes a message; must not throw.
using LogSink = std::function<void(LogLevel, std::string_view message)>;

// Writes "shoal: warning: message" lines to stderr, messages below `least` left out.
LogSink stderrSink(LogLevel least = LogLevel::warning);
// Swallows everything.
LogSink nullSink();

}  // namespace shoal
