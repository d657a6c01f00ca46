#include "gl/egl_context.h"

#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace shoal::gl {
namespace {

constexpr int kMaxDevices = 64;
constexpr EGLint kEglRendererExt = 0x335F;  // EGL_EXT_device_query_name; not in epoxy's header yet

// Whole-word search in a list separated by spaces.
bool hasWord(const char* list, std::string_view word) {
    std::string_view rest = list ? list : "";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == word) return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

std::string eglErrorName() {
    const EGLint code = eglGetError();
    switch (code) {
        case EGL_SUCCESS:
            return "no EGL error";
        case EGL_NOT_INITIALIZED:
            return "EGL_NOT_INITIALIZED";
        case EGL_BAD_ACCESS:
            return "EGL_BAD_ACCESS";
        case EGL_BAD_ALLOC:
            return "EGL_BAD_ALLOC";
        case EGL_BAD_ATTRIBUTE:
            return "EGL_BAD_ATTRIBUTE";
        case EGL_BAD_CONFIG:
            return "EGL_BAD_CONFIG";
        case EGL_BAD_CONTEXT:
            return "EGL_BAD_CONTEXT";
        case EGL_BAD_DISPLAY:
            return "EGL_BAD_DISPLAY";
        case EGL_BAD_MATCH:
            return "EGL_BAD_MATCH";
        case EGL_BAD_PARAMETER:
            return "EGL_BAD_PARAMETER";
        default:
            return fmt::format("EGL error 0x{:04x}", code);
    }
}

// The display is never terminated: EGL hands the same one to everybody who asks for this device, a host or a second
// Device too, and eglTerminate would take their contexts away.
class EglContext final : public Context {
public:
    EglContext(EGLDisplay display, EGLContext context, EGLSurface surface)
        : display_(display), context_(context), surface_(surface) {}
    ~EglContext() override {
        release();
        forgetCurrent(*this);
        eglDestroyContext(display_, context_);
        if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    }
    Result<void> makeCurrent() override {
        eglBindAPI(EGL_OPENGL_API);
        if (!eglMakeCurrent(display_, surface_, surface_, context_))
            return internalError("eglMakeCurrent failed: " + eglErrorName() +
                                 " (a context of GLX that is current on this thread must be released first)");
        return {};
    }
    void release() override {
        if (isCurrent()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    bool isCurrent() const override { return eglGetCurrentContext() == context_; }

private:
    EGLDisplay display_;
    EGLContext context_;
    EGLSurface surface_;
};

std::string describe(EGLDeviceEXT device, const char* extensions) {
    const char* text = nullptr;
    if (hasWord(extensions, "EGL_EXT_device_drm")) text = eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT);
    if (!text && hasWord(extensions, "EGL_EXT_device_query_name"))
        text = eglQueryDeviceStringEXT(device, kEglRendererExt);
    return text ? text : "";
}

// A configuration, and a 1 x 1 surface for drivers that cannot do without one.
struct Needs {
    EGLConfig config = nullptr;
    EGLSurface surface = EGL_NO_SURFACE;
};
Result<Needs> configAndSurface(EGLDisplay display, const char* extensions) {
    Needs needs;
    const bool surfaceless = hasWord(extensions, "EGL_KHR_surfaceless_context");
    if (surfaceless && hasWord(extensions, "EGL_KHR_no_config_context")) return needs;
    const EGLint wanted[] = {EGL_SURFACE_TYPE, surfaceless ? 0 : EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &needs.config, 1, &count) || count < 1)
        return noDevice("EGL has no configuration for OpenGL");
    if (!surfaceless) {
        const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        needs.surface = eglCreatePbufferSurface(display, needs.config, size);
        if (needs.surface == EGL_NO_SURFACE) return noDevice("eglCreatePbufferSurface failed: " + eglErrorName());
    }
    return needs;
}

}  // namespace

std::string missingGlLibrary(bool needEgl) {
    // The handles stay open: epoxy opens the same libraries a moment later.
    if (needEgl && !dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL))
        return "libEGL.so.1 cannot be opened (Debian: libegl1)";
    if (!dlopen("libOpenGL.so.0", RTLD_LAZY | RTLD_LOCAL) && !dlopen("libGL.so.1", RTLD_LAZY | RTLD_LOCAL))
        return "neither libOpenGL.so.0 nor libGL.so.1 can be opened (Debian: libopengl0)";
    return {};
}

Result<std::vector<EglCandidate>> eglCandidates() {
    if (std::string problem = missingGlLibrary(true); !problem.empty()) return noDevice(problem);
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<EglCandidate> found;
    const bool canList =
        hasWord(extensions, "EGL_EXT_device_enumeration") || hasWord(extensions, "EGL_EXT_device_base");
    if (canList && hasWord(extensions, "EGL_EXT_platform_device")) {
        EGLDeviceEXT devices[kMaxDevices];
        EGLint count = 0;
        if (!eglQueryDevicesEXT(kMaxDevices, devices, &count)) count = 0;
        for (EGLint i = 0; i < count; ++i) {
            const char* has = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
            found.push_back({"", describe(devices[i], has), devices[i], hasWord(has, "EGL_MESA_device_software")});
        }
    }
    std::stable_partition(found.begin(), found.end(), [](const EglCandidate& c) { return !c.saysSoftware; });
    int gpuCount = 0, cpuCount = 0;
    for (EglCandidate& c : found) {
        if (!c.saysSoftware)
            c.name = fmt::format("gpu{}", gpuCount++);
        else
            c.name = cpuCount++ == 0 ? "cpu" : fmt::format("cpu{}", cpuCount - 1);
    }
    if (hasWord(extensions, "EGL_MESA_platform_surfaceless")) found.push_back({"surfaceless", "", nullptr, false});
    if (found.empty()) return noDevice("EGL lists no devices and has no surfaceless platform (Debian: libegl-mesa0)");
    return found;
}

Result<std::unique_ptr<Context>> openEglContext(const EglCandidate& candidate, bool debug) {
    const EGLenum platform = candidate.device ? EGL_PLATFORM_DEVICE_EXT : EGL_PLATFORM_SURFACELESS_MESA;
    // Not eglGetPlatformDisplay: epoxy looks up which EGL version a display has before it knows that entry point, and
    // aborts.
    const EGLDisplay display = eglGetPlatformDisplayEXT(
        platform, candidate.device ? candidate.device : reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
    if (display == EGL_NO_DISPLAY) return noDevice("eglGetPlatformDisplayEXT failed: " + eglErrorName());
    EGLint major = 0, minor = 0;
    if (!eglInitialize(display, &major, &minor)) return noDevice("eglInitialize failed: " + eglErrorName());
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    if (!eglBindAPI(EGL_OPENGL_API)) return noDevice("EGL gives no desktop OpenGL: " + eglErrorName());
    const bool attributes = major > 1 || minor >= 5 || hasWord(extensions, "EGL_KHR_create_context");
    if (!attributes) return noDevice(fmt::format("EGL {}.{} cannot be asked for a version of OpenGL", major, minor));
    SHOAL_TRY_ASSIGN(const Needs needs, configAndSurface(display, extensions));

    // The KHR names have the values of EGL 1.5; the debug bit exists in both.
    EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                       4,
                       EGL_CONTEXT_MINOR_VERSION_KHR,
                       5,
                       EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                       EGL_CONTEXT_FLAGS_KHR,
                       EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR,
                       EGL_NONE};
    if (!debug) wanted[6] = EGL_NONE;
    const EGLContext context = eglCreateContext(display, needs.config, EGL_NO_CONTEXT, wanted);
    if (context == EGL_NO_CONTEXT) {
        const std::string why = eglErrorName();
        if (needs.surface != EGL_NO_SURFACE) eglDestroySurface(display, needs.surface);
        return noDevice("no OpenGL 4.5 core context: " + why);
    }
    return std::unique_ptr<Context>(std::make_unique<EglContext>(display, context, needs.surface));
}

EglCurrent eglCurrent() {
    return {eglGetCurrentDisplay(), eglGetCurrentContext(), eglGetCurrentSurface(EGL_DRAW),
            eglGetCurrentSurface(EGL_READ)};
}

void restoreEglCurrent(const EglCurrent& current) {
    if (current.context == EGL_NO_CONTEXT) return;
    eglMakeCurrent(current.display, current.draw, current.read, current.context);
}

}  // namespace shoal::gl
