#include "tools/port/gl/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <array>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string_view>

namespace strata::port {

namespace {

void require(bool ok, const std::string& what) {
    if (!ok) throw std::runtime_error("no OpenGL context: " + what + " failed");
}

bool is_software(const std::string& driver) { return driver != "hardware"; }

// Mesa reads these variables when the driver starts; the caller's environment must not override --threads.
void choose(const std::string& driver, int threads) {
    if (!is_software(driver)) return;
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", driver == "softpipe" ? "softpipe" : "llvmpipe", 1);
    // SSE 4.1 is the last instruction set before fused multiply-add that llvmpipe supports.
    if (driver == "llvmpipe_sse") setenv("GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1", 1);
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
}

// EGL's first device that is not Mesa's software one. Proprietary drivers have no other way to draw without a window.
EGLDisplay first_gpu() {
    const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto query_text =
        reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices == nullptr || query_text == nullptr ||
        query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE)
        return EGL_NO_DISPLAY;
    for (const EGLDeviceEXT device : std::span{devices}.first(static_cast<std::size_t>(count))) {
        const char* const extensions = query_text(device, EGL_EXTENSIONS);
        if (extensions != nullptr &&
            std::string_view{extensions}.find("EGL_MESA_device_software") != std::string_view::npos)
            continue;
        return eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    }
    return EGL_NO_DISPLAY;
}

// Mesa's surfaceless platform draws on the CPU if requested (choose()), otherwise on a GPU that Mesa supports.
EGLDisplay display_of(const std::string& driver) {
    const EGLDisplay gpu = is_software(driver) ? EGL_NO_DISPLAY : first_gpu();
    return gpu != EGL_NO_DISPLAY ? gpu
                                 : eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

}  // namespace

const std::vector<std::string>& driver_names() {
    static const std::vector<std::string> names{"llvmpipe", "llvmpipe_sse", "softpipe", "hardware"};
    return names;
}

HeadlessContext::HeadlessContext(const std::string& driver, int threads, ContextKind kind) {
    choose(driver, threads);
    display_ = display_of(driver);
    require(display_ != EGL_NO_DISPLAY, "eglGetPlatformDisplay");
    require(eglInitialize(display_, nullptr, nullptr) == EGL_TRUE, "eglInitialize");
    require(eglBindAPI(EGL_OPENGL_API) == EGL_TRUE, "eglBindAPI");
    const bool is_core = kind == ContextKind::core;
    const std::array version{
        EGL_CONTEXT_MAJOR_VERSION,
        3,
        EGL_CONTEXT_MINOR_VERSION,
        3,
        EGL_CONTEXT_OPENGL_PROFILE_MASK,
        is_core ? EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT : EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
        EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version.data());
    require(context_ != EGL_NO_CONTEXT, is_core ? "eglCreateContext (3.3 core)" : "eglCreateContext (3.3 compatible)");
    require(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE, "eglMakeCurrent");
    // Without this check a GPU's driver could be used instead of Mesa's software driver, or the reverse.
    const std::string found = renderer();
    const bool found_software = found.starts_with("softpipe") || found.starts_with("llvmpipe");
    require(is_software(driver) ? found.starts_with(driver == "softpipe" ? "softpipe" : "llvmpipe") : !found_software,
            "the choice of the driver " + driver + " (found " + found + ")");
}

HeadlessContext::~HeadlessContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

std::string HeadlessContext::renderer() const {
    const auto text = [](GLenum name) { return std::string{reinterpret_cast<const char*>(glGetString(name))}; };
    return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

}  // namespace strata::port
