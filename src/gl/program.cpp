#include <shoal/gl/program.h>

#include <fmt/format.h>

#include <map>
#include <span>

#include <shoal/core/hash.h>

#include "gl/device_state.h"
#include "gl/shader_source.h"

namespace shoal::gl {
namespace {

GLenum stageEnum(std::string_view stage) {
    if (stage == "vert") return GL_VERTEX_SHADER;
    if (stage == "frag") return GL_FRAGMENT_SHADER;
    if (stage == "geom") return GL_GEOMETRY_SHADER;
    return GL_COMPUTE_SHADER;
}

std::string labelOf(const ProgramDesc& desc) {
    if (!desc.label.empty()) return desc.label;
    return desc.stages.empty() ? "" : desc.stages.front();
}

std::string keyOf(const ProgramDesc& desc) {
    std::string key;
    for (const std::string& stage : desc.stages) key += stage + '\n';
    for (const auto& [name, value] : desc.defines) key += name + '=' + value + '\n';
    return key;
}

// One stage's flattened text with the defines in.
struct StageSource {
    std::string name;
    FlatSource flat;
};
struct Sources {
    std::vector<StageSource> stages;
    std::uint64_t hash = kFnvStart;
};

Result<Sources> readSources(const ProgramDesc& desc, const std::string& shaderDir) {
    Sources sources;
    for (const std::string& name : desc.stages) {
        if (shaderStage(name).empty())
            return internalError(fmt::format("{}: not a program stage; expected .vert, .frag, .comp or .geom", name));
        SHOAL_TRY_ASSIGN(FlatSource flat, flattenShader(name, shaderDir));
        flat.text = withDefines(flat.text, desc.defines);
        sources.hash = fnv1a(std::as_bytes(std::span(flat.text)), sources.hash);
        sources.stages.push_back({name, std::move(flat)});
    }
    return sources;
}

std::string shaderLog(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 0)), '\0');
    if (length > 0) glGetShaderInfoLog(shader, length, nullptr, log.data());
    return log;
}

std::string programLog(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 0)), '\0');
    if (length > 0) glGetProgramInfoLog(program, length, nullptr, log.data());
    return log;
}

Result<GLuint> compile(const StageSource& source) {
    const GLuint shader = glCreateShader(stageEnum(shaderStage(source.name)));
    const char* text = source.flat.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    std::string log = nameLogPlaces(shaderLog(shader), source.flat.files);
    glDeleteShader(shader);
    if (log.empty()) log = source.name + ": does not compile; the driver says nothing";
    return internalError(std::move(log));
}

// A linked program's name.
Result<GLuint> build(const Sources& sources, const ProgramDesc& desc) {
    const GLuint program = glCreateProgram();
    std::vector<GLuint> shaders;
    auto cleanUp = [&] {
        for (GLuint shader : shaders) glDetachShader(program, shader), glDeleteShader(shader);
    };
    for (const StageSource& stage : sources.stages) {
        auto shader = compile(stage);
        if (!shader) {
            cleanUp();
            glDeleteProgram(program);
            return std::move(shader).error();
        }
        glAttachShader(program, *shader);
        shaders.push_back(*shader);
    }
    const std::string label = labelOf(desc);
    glObjectLabel(GL_PROGRAM, program, GLsizei(label.size()), label.data());
    glLinkProgram(program);
    cleanUp();
    GLint ok = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok) return program;
    // A link message speaks of several stages; the first one's files are the better guess for its places.
    const std::string log = nameLogPlaces(programLog(program), sources.stages.front().flat.files);
    glDeleteProgram(program);
    std::string names;
    for (const StageSource& stage : sources.stages) names += (names.empty() ? "" : " + ") + stage.name;
    return internalError(fmt::format("{}: does not link: {}", names, log.empty() ? "the driver says nothing" : log));
}

int groupCount(int invocationCount, int localSize) { return (invocationCount + localSize - 1) / localSize; }

}  // namespace

void Program::use() const { glUseProgram(name_); }

void Program::dispatch(int x, int y, int z) const {
    SHOAL_ASSERT_MSG(x >= 0 && y >= 0 && z >= 0, fmt::format("{}: dispatch of {} x {} x {}", labelOf(desc_), x, y, z));
    use();
    if (x == 0 || y == 0 || z == 0) return;
    glDispatchCompute(GLuint(groupCount(x, localSize_[0])), GLuint(groupCount(y, localSize_[1])),
                      GLuint(groupCount(z, localSize_[2])));
}

void Program::set(int location, int value) const { glProgramUniform1i(name_, location, value); }
void Program::set(int location, std::uint32_t value) const { glProgramUniform1ui(name_, location, value); }
void Program::set(int location, float value) const { glProgramUniform1f(name_, location, value); }
void Program::set(int location, Vec2 value) const { glProgramUniform2f(name_, location, value.x, value.y); }
void Program::set(int location, Vec3 value) const { glProgramUniform3f(name_, location, value.x, value.y, value.z); }
void Program::set(int location, Vec4 value) const {
    glProgramUniform4f(name_, location, value.x, value.y, value.z, value.w);
}
void Program::set(int location, const Mat4& value) const {
    glProgramUniformMatrix4fv(name_, location, 1, GL_FALSE, value.m.data());
}

struct ProgramCache::State {
    struct Entry {
        Program program;
        std::uint64_t triedHash = 0;  // of the sources last built, well or badly
        std::string sourceError;      // of the last reading that failed, so that it is logged once
    };
    Device& device;
    std::shared_ptr<ObjectLedger> ledger;
    std::string shaderDir;
    std::map<std::string, std::unique_ptr<Entry>> entries;

    // Puts a new name into `program`, the old one away.
    static void install(Program& program, GLuint name) {
        if (program.name_) glDeleteProgram(program.name_);
        program.name_ = name;
        GLint size[3] = {1, 1, 1};
        if (program.desc_.stages.size() == 1 && shaderStage(program.desc_.stages[0]) == "comp")
            glGetProgramiv(name, GL_COMPUTE_WORK_GROUP_SIZE, size);
        for (int i = 0; i < 3; ++i) program.localSize_[i] = size[i];
    }

    bool reload(Entry& entry);
};

ProgramCache::ProgramCache(Device& device, std::string shaderDir)
    : state_(new State{device, device.state().ledger, std::move(shaderDir), {}}) {}

ProgramCache::~ProgramCache() {
    const ScopedCurrent current(state_->device.state());
    for (auto& [key, entry] : state_->entries) {
        if (current.ok()) glDeleteProgram(entry->program.name_);
        --state_->ledger->objectCount;
    }
}

Result<const Program*> ProgramCache::get(const ProgramDesc& desc) {
    const std::string key = keyOf(desc);
    if (const auto found = state_->entries.find(key); found != state_->entries.end()) return &found->second->program;
    SHOAL_ASSERT_MSG(!desc.stages.empty(), "a program needs at least one stage");
    SHOAL_ASSERT_MSG(state_->device.state().isCurrent(),
                     "the device is not current on this thread: call makeCurrent()");
    SHOAL_TRY_ASSIGN(const Sources sources, readSources(desc, state_->shaderDir));
    SHOAL_TRY_ASSIGN(const GLuint name, build(sources, desc));
    auto entry = std::make_unique<State::Entry>();
    entry->program.desc_ = desc;
    entry->triedHash = sources.hash;
    State::install(entry->program, name);
    ++state_->ledger->objectCount;
    return &state_->entries.emplace(key, std::move(entry)).first->second->program;
}

bool ProgramCache::State::reload(Entry& entry) {
    const ProgramDesc& desc = entry.program.desc_;
    auto fail = [&](const std::string& message) {
        device.log(LogLevel::error, fmt::format("{}: keeps its last good version: {}", labelOf(desc), message));
        return false;
    };
    const auto sources = readSources(desc, shaderDir);
    if (!sources) {
        if (entry.sourceError == sources.error().message) return false;
        entry.sourceError = sources.error().message;
        return fail(entry.sourceError);
    }
    entry.sourceError.clear();
    if (sources->hash == entry.triedHash) return false;
    entry.triedHash = sources->hash;
    const auto name = build(*sources, desc);
    if (!name) return fail(name.error().message);
    install(entry.program, *name);
    device.log(LogLevel::info, fmt::format("{}: rebuilt", labelOf(desc)));
    return true;
}

int ProgramCache::reload() {
    if (state_->shaderDir.empty()) return 0;
    int rebuiltCount = 0;
    for (auto& [key, entry] : state_->entries) rebuiltCount += state_->reload(*entry) ? 1 : 0;
    return rebuiltCount;
}

std::size_t ProgramCache::size() const { return state_->entries.size(); }

}  // namespace shoal::gl
