// An OpenGL 4.5 core context made usable: created without a screen (EGL), or taken over from a host that has one.
// Everything of shoal::gl belongs to one Device and is used on the thread where its context is current.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <shoal/core/log.h>
#include <shoal/core/result.h>

namespace shoal::gl {

struct DeviceInfo {
    std::string name;       // what --device takes: "gpu0", "cpu"
    std::string renderer;   // GL_RENDERER
    std::string vendor;     // GL_VENDOR
    std::string version;    // GL_VERSION
    bool software = false;  // llvmpipe, softpipe, swrast
    std::string problem;    // why it cannot be used; empty where it can
};

struct DeviceOptions {
    // "auto": a GPU if EGL offers one, else llvmpipe; "gpu": only a GPU; "cpu": only a software renderer; else a name
    // that listDevices() gives, or a part of a renderer's name.
    std::string device = "auto";
    LogSink log;         // empty: nothing is logged
    bool debug = false;  // KHR_debug context with synchronous messages to `log`
    // Where program sources are read from instead of the embedded ones ("" : environment SHOAL_SHADER_DIR, else
    // embedded).
    std::string shaderDir;
};

struct Capabilities {
    int maxTextureSize = 0;
    int maxSamples = 0;
    std::int64_t maxStorageBlockBytes = 0;
    int maxComputeSharedBytes = 0;
    bool anisotropicFiltering = false;
    float maxAnisotropy = 1;
};

class ProgramCache;

class Device {
public:
    // Makes a context of its own, without a window, and makes it current on this thread.
    static Result<std::unique_ptr<Device>> create(const DeviceOptions& options = {});
    // Uses the context that is current on this thread (the host's). The host keeps it alive and current.
    static Result<std::unique_ptr<Device>> fromCurrentContext(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    // Makes this device's own context current on this thread; nothing to do for a host's.
    Result<void> makeCurrent();

    const DeviceInfo& info() const;
    const Capabilities& capabilities() const;
    bool software() const { return info().software; }
    void log(LogLevel level, std::string_view message) const;
    ProgramCache& programs();

    // Error-severity KHR_debug messages since the device was made; tests fail when it is not 0.
    int debugErrorCount() const;
    // GL object names that shoal::gl objects of this device hold now, and the bytes of their storage (texel and buffer
    // bytes as asked for; a driver may round up).
    std::int64_t liveObjectCount() const;
    std::int64_t liveBytes() const;

    struct State;
    State& state() { return *state_; }
    static std::unique_ptr<Device> adopt(std::unique_ptr<State> state);  // for Window

private:
    explicit Device(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// What can draw on this machine: every EGL device that gives a GL 4.5 core context, and those that do not with the
// reason.
std::vector<DeviceInfo> listDevices();

// Puts the context into the state that Shoal's passes start from. The pipeline calls it at the start of a frame: Shoal
// never relies on a host's state.
// - Clip control lower left and zero to one (reversed z: depth function GREATER, cleared to 0, depth range 0 to 1).
// - Off: depth and stencil test, blending, culling, scissor, logic op, dither, sRGB conversion of framebuffers, depth
//   clamp, polygon offset and smoothing, primitive restart, rasterizer discard, clip distances, sample masks and alpha
//   to coverage. On: multisample, seamless cube maps. Masks all on, polygons filled, front faces counter-clockwise.
// - Pixel transfer tightly packed, without pixel buffers; no sampler objects on texture units 0 to 31; no program,
//   program pipeline, vertex array or indirect buffers.
// Not set: viewport, framebuffer, textures, images, buffers. Each pass sets its own.
void setKnownState();

// Saves the state that Shoal leaves dirty, restores it on destruction. For hosts; listed in docs/embedding.md: all that
// setKnownState() sets, viewports, scissors and depth ranges 0 to 15, blending and colour masks of draw buffers 0 to 7,
// framebuffers, texture units 0 to 31 (every target, and the sampler), image units 0 to 7, uniform and storage buffer
// bindings 0 to 15 and the plain bindings of both. Cannot be saved, so must not be active: conditional rendering and
// transform feedback.
class StateGuard {
public:
    StateGuard();
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

private:
    struct Saved;
    std::unique_ptr<Saved> saved_;
};

}  // namespace shoal::gl
