// Programs from embedded GLSL: #include flattening with real file names and lines in errors, defines, hot reload.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <shoal/core/math.h>
#include <shoal/core/result.h>
#include <shoal/gl/objects.h>

namespace shoal::gl {

// Names are "module/file.stage": "frame/shade.comp". The stage is the ending: vert, frag, comp, geom.
struct ProgramDesc {
    std::vector<std::string> stages;  // {"frame/gbuffer.vert", "frame/gbuffer.frag"} or one .comp
    std::vector<std::pair<std::string, std::string>> defines;  // put after #version
    std::string label;
};

// A linked program owned by the cache. Stays valid as long as the device; reload() swaps what is inside.
class Program {
public:
    std::uint32_t name() const { return name_; }
    void use() const;
    // Runs enough groups of the program's local size to cover x, y, z invocations. Calls use() itself.
    void dispatch(int x, int y = 1, int z = 1) const;
    int localSize(int axis) const { return localSize_[axis]; }
    // Sets a plain uniform by location (explicit layout locations in the shaders); for small per-draw values.
    void set(int location, int value) const;
    void set(int location, std::uint32_t value) const;
    void set(int location, float value) const;
    void set(int location, Vec2 value) const;
    void set(int location, Vec3 value) const;
    void set(int location, Vec4 value) const;
    void set(int location, const Mat4& value) const;

private:
    friend class ProgramCache;
    ProgramDesc desc_;
    std::uint32_t name_ = 0;
    int localSize_[3] = {1, 1, 1};
};

class ProgramCache {
public:
    // The program of `desc`, built at first asking. The error has the compiler's text with "frame/x.lib.glsl:12:" in
    // front.
    Result<const Program*> get(const ProgramDesc& desc);
    // Rebuilds what was built from files that changed in SHOAL_SHADER_DIR; a program that fails keeps its last good
    // version and its error is logged. Returns how many were rebuilt.
    int reload();
    std::size_t size() const;

    explicit ProgramCache(Device& device, std::string shaderDir);
    ~ProgramCache();

private:
    struct State;
    std::unique_ptr<State> state_;
};

// The source after flattening, for tests and tools: text with #line directives, and the file names that their numbers
// stand for (line L of file F is "#line F*100000+L F": some compilers lose the second number). A file is included once.
// `shaderDir` is laid out as src/ is; what it lacks is taken from the embedded texts.
struct FlatSource {
    std::string text;
    std::vector<std::string> files;
};
Result<FlatSource> flattenShader(const std::string& name, const std::string& shaderDir = "");
// Names of all embedded entry points (vert, frag, comp), for tests that link them all.
std::vector<std::string> embeddedShaderNames();

}  // namespace shoal::gl
