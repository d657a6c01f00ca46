// A temporary folder laid out as src/ for SHOAL_SHADER_DIR, removed again.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace shoal::test {

class ShaderFolder {
public:
    ShaderFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "shoal_shaders_XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("cannot make " + name);
        path_ = name;
    }
    ~ShaderFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ShaderFolder(const ShaderFolder&) = delete;
    ShaderFolder& operator=(const ShaderFolder&) = delete;

    void write(const std::string& file, std::string_view text) const {
        const auto path = path_ / file;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << text;
    }
    std::string path() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

}  // namespace shoal::test
