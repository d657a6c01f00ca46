#include <shoal/gl/device.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include <shoal/gl/shaders.h>

#include "gl/device_state.h"
#include "gl/egl_context.h"
#include "gl/embedded_shader.h"

namespace shoal::gl {
namespace {

thread_local Context* currentContext = nullptr;  // what switchTo() made current last on this thread

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return out;
}

std::string glString(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

bool hasExtension(std::string_view wanted) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i))) == wanted) return true;
    return false;
}

Capabilities readCapabilities() {
    Capabilities c;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &c.maxTextureSize);
    glGetIntegerv(GL_MAX_SAMPLES, &c.maxSamples);
    GLint64 block = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
    c.maxStorageBlockBytes = block;
    glGetIntegerv(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, &c.maxComputeSharedBytes);
    c.anisotropicFiltering =
        hasExtension("GL_ARB_texture_filter_anisotropic") || hasExtension("GL_EXT_texture_filter_anisotropic");
    if (c.anisotropicFiltering) glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &c.maxAnisotropy);
    return c;
}

void APIENTRY onDebugMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                             const void* user) {
    auto& state = *const_cast<Device::State*>(static_cast<const Device::State*>(user));
    const bool isError = type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH;
    if (isError) ++state.debugErrorCount;
    const LogLevel level = isError                                ? LogLevel::error
                           : severity == GL_DEBUG_SEVERITY_MEDIUM ? LogLevel::warning
                                                                  : LogLevel::debug;
    std::string_view message(text, length >= 0 ? std::size_t(length) : std::string_view(text).size());
    while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back()))) message.remove_suffix(1);
    state.say(level, fmt::format("OpenGL: {}", message));
}

void listenToMessages(Device::State& state) {
    if (!state.context) {  // a host's own callback is put back when the device goes
        void* function = nullptr;
        void* user = nullptr;
        glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &function);
        glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &user);
        state.hostCallback = reinterpret_cast<GLDEBUGPROC>(function);
        state.hostCallbackUser = user;
    }
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(&onDebugMessage, &state);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
    state.callbackSet = true;
}

// The directory to read shaders from: option, else environment, else none.
Result<std::string> chooseShaderDir(const DeviceOptions& options) {
    std::string dir = options.shaderDir;
    const char* origin = "DeviceOptions::shaderDir";
    if (dir.empty()) {
        const char* value = std::getenv("SHOAL_SHADER_DIR");
        dir = value ? value : "";
        origin = "SHOAL_SHADER_DIR";
    }
    std::error_code error;
    if (!dir.empty() && !std::filesystem::is_directory(dir, error))
        return badInput(
            fmt::format("{}: \"{}\" is not a folder; expected one that is laid out as shoal's src/", origin, dir));
    return dir;
}

struct Attempt {
    std::unique_ptr<Device::State> state;
    std::string problem;
};

// Opens `candidate` and makes it current.
Attempt open(const EglCandidate& candidate, const DeviceOptions& options) {
    auto context = openEglContext(candidate, options.debug);
    if (!context) return {nullptr, context.error().message};
    if (auto current = switchTo(**context); !current) return {nullptr, current.error().message};
    auto state = adoptCurrentContext(options, candidate.name, *std::move(context));
    if (!state) return {nullptr, state.error().message};
    return {*std::move(state), ""};
}

enum class Want { any, gpu, cpu, byName };

Want wanted(const std::string& device) {
    if (device == "auto" || device.empty()) return Want::any;
    if (device == "gpu") return Want::gpu;
    if (device == "cpu") return Want::cpu;
    return Want::byName;
}

// The candidates worth opening for a request, best first, so that usually only one context is ever made.
std::vector<EglCandidate> worthTrying(const std::vector<EglCandidate>& all, const std::string& device) {
    std::vector<EglCandidate> out = all;
    const Want want = wanted(device);
    if (want == Want::cpu)
        std::stable_partition(out.begin(), out.end(), [](const EglCandidate& c) { return c.saysSoftware; });
    if (want == Want::gpu) std::erase_if(out, [](const EglCandidate& c) { return c.saysSoftware; });
    if (want == Want::byName) {
        const std::string name = lower(device);
        const auto exact = std::find_if(all.begin(), all.end(), [&](const EglCandidate& c) { return c.name == name; });
        if (exact != all.end()) return {*exact};
    }
    return out;
}

// Why an opened device is not what was asked for; empty if it is.
std::string mismatch(const DeviceInfo& info, const std::string& device) {
    switch (wanted(device)) {
        case Want::any:
            return {};
        case Want::gpu:
            return info.software ? info.renderer + " is software" : "";
        case Want::cpu:
            return info.software ? "" : info.renderer + " is not software";
        case Want::byName:
            break;
    }
    if (info.name == lower(device) || lower(info.renderer).find(lower(device)) != std::string::npos) return {};
    return "is " + info.renderer;
}

}  // namespace

bool isSoftwareRenderer(std::string_view renderer) {
    const std::string name = lower(renderer);
    for (const char* part : {"llvmpipe", "softpipe", "swrast", "software rasterizer"})
        if (name.find(part) != std::string::npos) return true;
    return false;
}

Result<void> switchTo(Context& context) {
    if (context.isCurrent()) {
        currentContext = &context;
        return {};
    }
    if (currentContext && currentContext != &context) currentContext->release();
    currentContext = nullptr;
    SHOAL_TRY(context.makeCurrent());
    currentContext = &context;
    return {};
}

void forgetCurrent(Context& context) {
    if (currentContext == &context) currentContext = nullptr;
}

struct ScopedCurrent::Previous {
    Context* ours = nullptr;
    EglCurrent egl;
};

ScopedCurrent::ScopedCurrent(const Device::State& state) {
    if (state.isCurrent()) return;
    context_ = state.context.get();
    previous_ = std::make_unique<Previous>(Previous{currentContext, eglCurrent()});
    ok_ = bool(switchTo(*context_));
}

ScopedCurrent::~ScopedCurrent() {
    if (!previous_) return;
    context_->release();
    forgetCurrent(*context_);
    if (previous_->egl.context) restoreEglCurrent(previous_->egl);
    if (previous_->ours && !previous_->ours->isCurrent()) (void)previous_->ours->makeCurrent();
    if (previous_->ours && previous_->ours->isCurrent()) currentContext = previous_->ours;
}

Result<std::unique_ptr<Device::State>> adoptCurrentContext(const DeviceOptions& options, std::string name,
                                                           std::unique_ptr<Context> context) {
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < 45)
        return noDevice(fmt::format("found {} {}.{}, expected OpenGL 4.5 core",
                                    epoxy_is_desktop_gl() ? "OpenGL" : "OpenGL ES", version / 10, version % 10));
    auto state = std::make_unique<Device::State>();
    state->context = std::move(context);
    SHOAL_TRY_ASSIGN(state->shaderDir, chooseShaderDir(options));
    state->info.name = std::move(name);
    state->info.renderer = glString(GL_RENDERER);
    state->info.vendor = glString(GL_VENDOR);
    state->info.version = glString(GL_VERSION);
    state->info.software = isSoftwareRenderer(state->info.renderer);
    state->capabilities = readCapabilities();
    state->log = options.log;
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    state->debugContext = (flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0;
    if (options.debug && state->debugContext) listenToMessages(*state);
    registerShaders(embeddedShaders());
    return state;
}

Device::Device(std::unique_ptr<State> state) : state_(std::move(state)) {
    state_->ledger->device = this;
    state_->programs = std::make_unique<ProgramCache>(*this, state_->shaderDir);
}

std::unique_ptr<Device> Device::adopt(std::unique_ptr<State> state) {
    return std::unique_ptr<Device>(new Device(std::move(state)));
}

Device::~Device() {
    {
        const ScopedCurrent current(*state_);
        state_->programs.reset();
        if (state_->callbackSet && current.ok()) glDebugMessageCallback(state_->hostCallback, state_->hostCallbackUser);
    }
    state_->ledger->device = nullptr;
    if (state_->ledger->objectCount > 0)
        state_->say(LogLevel::warning,
                    fmt::format("{} OpenGL objects ({} bytes) outlive their device \"{}\"", state_->ledger->objectCount,
                                state_->ledger->bytes, state_->info.name));
}

Result<std::unique_ptr<Device>> Device::create(const DeviceOptions& options) {
    SHOAL_TRY(chooseShaderDir(options));  // a wrong folder is not a missing device
    auto all = eglCandidates();
    if (!all) return noDevice(fmt::format("no OpenGL 4.5 device: {}", all.error().message));
    std::string tried;
    std::unique_ptr<State> reserve;  // "auto": software that was found where hardware was expected
    for (const EglCandidate& candidate : worthTrying(*all, options.device)) {
        if (reserve && !candidate.saysSoftware && !candidate.device) continue;
        Attempt attempt = open(candidate, options);
        if (attempt.state) attempt.problem = mismatch(attempt.state->info, options.device);
        if (attempt.problem.empty()) {
            const bool hopeForMore = wanted(options.device) == Want::any && attempt.state->info.software &&
                                     !candidate.saysSoftware && candidate.device;
            if (!hopeForMore) return adopt(std::move(attempt.state));
            if (!reserve) reserve = std::move(attempt.state);
            continue;
        }
        const std::string where = candidate.description.empty() ? "" : " (" + candidate.description + ")";
        tried += (tried.empty() ? "" : "; ") + candidate.name + where + ": " + attempt.problem;
    }
    if (reserve) {
        SHOAL_TRY(switchTo(*reserve->context));
        return adopt(std::move(reserve));
    }
    if (tried.empty()) tried = "EGL lists no such device";
    return noDevice(fmt::format("no usable OpenGL 4.5 device for \"{}\"; tried {}", options.device, tried));
}

Result<std::unique_ptr<Device>> Device::fromCurrentContext(const DeviceOptions& options) {
    if (std::string problem = missingGlLibrary(false); !problem.empty()) return noDevice(problem);
    if (!glGetString(GL_VERSION))
        return noDevice("no OpenGL context is current on this thread; make the host's current first");
    SHOAL_TRY_ASSIGN(auto state, adoptCurrentContext(options, "host", nullptr));
    return adopt(std::move(state));
}

Result<void> Device::makeCurrent() {
    if (!state_->context) return {};
    return switchTo(*state_->context);
}

const DeviceInfo& Device::info() const { return state_->info; }
const Capabilities& Device::capabilities() const { return state_->capabilities; }
void Device::log(LogLevel level, std::string_view message) const { state_->say(level, message); }
ProgramCache& Device::programs() { return *state_->programs; }
std::int64_t Device::liveObjectCount() const { return state_->ledger->objectCount; }
std::int64_t Device::liveBytes() const { return state_->ledger->bytes; }

int Device::debugErrorCount() const {
    // Without a debug context no messages come; the error flag still tells. A host's flag is the host's to read.
    if (!state_->callbackSet && state_->context && state_->isCurrent())
        while (glGetError() != GL_NO_ERROR) ++state_->debugErrorCount;
    return state_->debugErrorCount;
}

std::vector<DeviceInfo> listDevices() {
    std::vector<DeviceInfo> out;
    auto all = eglCandidates();
    if (!all) return {{.name = "none", .renderer = "", .vendor = "", .version = "", .problem = all.error().message}};
    const EglCurrent before = eglCurrent();
    Context* const ours = currentContext;
    for (const EglCandidate& candidate : *all) {
        if (!candidate.device && !out.empty()) continue;  // surfaceless gives one of those already listed
        Attempt attempt = open(candidate, {});
        if (attempt.state)
            out.push_back(attempt.state->info);
        else
            out.push_back({.name = candidate.name,
                           .renderer = candidate.description,
                           .vendor = "",
                           .version = "",
                           .software = candidate.saysSoftware,
                           .problem = attempt.problem});
    }
    restoreEglCurrent(before);
    if (ours) (void)switchTo(*ours);
    return out;
}

}  // namespace shoal::gl
