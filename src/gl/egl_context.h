// Contexts without a screen: EGL's device platform (one display per device) and Mesa's surfaceless platform.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <shoal/core/result.h>

#include "gl/device_state.h"

namespace shoal::gl {

// One thing EGL may give a context for. Listing them opens nothing.
struct EglCandidate {
    std::string name;           // "gpu0", "cpu", "surfaceless"
    std::string description;    // a device file or EGL's name of the device; may be empty
    void* device = nullptr;     // EGLDeviceEXT; null for the surfaceless platform
    bool saysSoftware = false;  // by EGL_MESA_device_software; the renderer's name decides in the end
};

// Hardware first, then software, then the surfaceless platform. The error says why EGL offers nothing.
Result<std::vector<EglCandidate>> eglCandidates();
// A 4.5 core context of `candidate`, not current yet. The error says which step failed.
Result<std::unique_ptr<Context>> openEglContext(const EglCandidate& candidate, bool debug);

// EGL's current context of this thread, to be put back.
struct EglCurrent {
    void* display = nullptr;
    void* context = nullptr;
    void* draw = nullptr;
    void* read = nullptr;
};
EglCurrent eglCurrent();
void restoreEglCurrent(const EglCurrent& current);

}  // namespace shoal::gl
