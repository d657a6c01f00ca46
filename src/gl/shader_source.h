// Shader texts by name, and the compiler's messages with those names put back.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::gl {

// The text of "module/file": from `shaderDir` (laid out as src/: <dir>/<module>/shaders/<file>) where it has the file,
// else the embedded one. Nothing if neither has it. "file.comp" also finds "file.comp.glsl".
std::optional<std::string> shaderText(std::string_view name, const std::string& shaderDir);

// "vert", "frag", "comp", "geom" for entry points; empty for "x.lib.glsl", "x.io.glsl", "x.shared.h".
std::string_view shaderStage(std::string_view name);

// Turns the places in a compiler's log into "file:line:". Knows Mesa ("0:12(3): error: ..."), NVIDIA ("0(12) : error
// ...") and the reference compiler ("ERROR: 0:12: ..."). A number without a file stays as it is.
std::string nameLogPlaces(std::string_view log, const std::vector<std::string>& files);

// A define line for each pair, put after the #version line of a flattened text, with the line count restored.
std::string withDefines(const std::string& flat, const std::vector<std::pair<std::string, std::string>>& defines);

}  // namespace shoal::gl
