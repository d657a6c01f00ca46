// Scene files out: the text a person wrote, with some values changed.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <shoal/scene/scene.h>

namespace shoal::scene {

// `text` of the scene file `from` with `changes` made, for a file `to` that may lie in another folder: names of files
// that are there are written relative to it (or absolute where it is on another root). Keeps comments and order where
// the changed keys stand in plain statements; else the whole scene is written anew. Either way what parseScene makes of
// the result is what it makes of `text` with `changes`. Errors as parseScene.
Result<std::string> changedSceneText(std::string_view text, const std::filesystem::path& from,
                                     const std::filesystem::path& to, std::span<const Override> changes);

// A scene of model files, all standing at the origin on a ground, each playing its first clip.
std::string sceneTextForModels(std::span<const std::filesystem::path> files);

// `value` as TOML text: quoted and escaped.
std::string quotedToml(std::string_view value);

}  // namespace shoal::scene
