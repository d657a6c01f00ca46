// What a Device holds, for the sources of this folder.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <memory>
#include <string>

#include <shoal/gl/device.h>
#include <shoal/gl/program.h>

namespace shoal::gl {

// Something that can be made current on a thread: an EGL context or a window's.
class Context {
public:
    virtual ~Context() = default;
    virtual Result<void> makeCurrent() = 0;
    virtual void release() = 0;
    virtual bool isCurrent() const = 0;
};

// Shared by a device and its objects. `device` is null once the device is gone: its context, and with it every name,
// went too.
struct ObjectLedger {
    Device* device = nullptr;
    std::int64_t objectCount = 0;
    std::int64_t bytes = 0;
};

struct Device::State {
    DeviceInfo info;
    Capabilities capabilities;
    LogSink log;
    std::unique_ptr<Context> context;  // null: the host's, which the host keeps current
    std::shared_ptr<ObjectLedger> ledger = std::make_shared<ObjectLedger>();
    std::unique_ptr<ProgramCache> programs;
    std::string shaderDir;
    int debugErrorCount = 0;
    bool debugContext = false;
    bool callbackSet = false;
    GLDEBUGPROC hostCallback = nullptr;  // put back when a host's device goes
    const void* hostCallbackUser = nullptr;

    bool isCurrent() const { return !context || context->isCurrent(); }
    void say(LogLevel level, std::string_view message) const {
        if (log) log(level, message);
    }
};

// Makes `context` current on this thread; whatever context of Shoal's was current is released first, because glvnd
// refuses to change between GLX and EGL otherwise.
Result<void> switchTo(Context& context);
// Forgets `context` if it was the one Shoal made current last on this thread.
void forgetCurrent(Context& context);

// Makes a device's context current for the life of this object, if it is not, and what was current before again after.
class ScopedCurrent {
public:
    explicit ScopedCurrent(const Device::State& state);
    ~ScopedCurrent();
    ScopedCurrent(const ScopedCurrent&) = delete;
    ScopedCurrent& operator=(const ScopedCurrent&) = delete;
    bool ok() const { return ok_; }

private:
    struct Previous;
    std::unique_ptr<Previous> previous_;
    Context* context_ = nullptr;
    bool ok_ = true;
};

// A device for the context that is current: fills the information, sets up messages and programs. `info.name` is given.
Result<std::unique_ptr<Device::State>> adoptCurrentContext(const DeviceOptions& options, std::string name,
                                                           std::unique_ptr<Context> context);
bool isSoftwareRenderer(std::string_view renderer);
// Nothing where the libraries that epoxy opens are present; it would abort the process where they are not.
std::string missingGlLibrary(bool needEgl);

}  // namespace shoal::gl
