#include "tools/port/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace strata::port {

namespace {

void require(bool ok, const std::string& what) {
    if (!ok) throw std::runtime_error("no OpenGL context: " + what + " failed");
}

bool is_software(const std::string& driver) { return driver != "hardware"; }

// Mesa reads these when the driver starts; what the caller's shell says must not win over --threads.
void choose(const std::string& driver, int threads) {
    if (!is_software(driver)) return;
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", driver == "softpipe" ? "softpipe" : "llvmpipe", 1);
    // SSE 4.1 is the last set before fused multiply-add that llvmpipe still runs on.
    if (driver == "llvmpipe_sse") setenv("GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1", 1);
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
}

// A GPU's own platform where there is one: Mesa's surfaceless one, else the first device that EGL lists.
EGLDisplay display_of(const std::string& driver) {
    const EGLDisplay surfaceless = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (surfaceless != EGL_NO_DISPLAY || is_software(driver)) return surfaceless;
    const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    EGLDeviceEXT device = nullptr;
    EGLint count = 0;
    if (query_devices == nullptr || query_devices(1, &device, &count) == EGL_FALSE || count == 0) return EGL_NO_DISPLAY;
    return eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
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
    // Without this check a machine with a GPU driver would be taken for Mesa's, and one without for a GPU.
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
