// Small glTF files and an environment with one thing each to get right, made anew for every test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shoal::test {

// Every file that writeModel can make: "skinned.glb", ...
std::vector<std::string> modelNames();
// Writes one of them, and the pictures it names, into the folder. Throws std::runtime_error.
void writeModel(const std::filesystem::path& folder, const std::string& name);

}  // namespace shoal::test
