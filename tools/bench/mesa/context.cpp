#include "tools/bench/mesa/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace strata::mesa {

namespace {

void require(bool ok, const std::string& what) {
    if (!ok) throw std::runtime_error("no OpenGL context on Mesa's software driver: " + what + " failed");
}

// Mesa reads these when the driver starts; what the caller's shell says must not win over --threads.
void choose(const std::string& driver, int threads) {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", driver == "softpipe" ? "softpipe" : "llvmpipe", 1);
    // SSE 4.1 is the last set before fused multiply-add that llvmpipe still runs on.
    // softpipe reports OpenGL 3.3, but has every call that this program makes.
    if (driver == "softpipe") setenv("MESA_GL_VERSION_OVERRIDE", "4.5", 1);
    if (driver == "softpipe") setenv("MESA_GLSL_VERSION_OVERRIDE", "450", 1);
    if (driver == "llvmpipe_sse") setenv("GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1", 1);
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
}

}  // namespace

HeadlessContext::HeadlessContext(const std::string& driver, int threads) {
    choose(driver, threads);
    display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(display_ != EGL_NO_DISPLAY, "eglGetPlatformDisplay (surfaceless)");
    require(eglInitialize(display_, nullptr, nullptr) == EGL_TRUE, "eglInitialize");
    require(eglBindAPI(EGL_OPENGL_API) == EGL_TRUE, "eglBindAPI");
    // 4.5 is the first version with direct state access and glClipControl, which this program is
    // written in.
    constexpr std::array version{
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version.data());
    require(context_ != EGL_NO_CONTEXT, "eglCreateContext (4.5 core)");
    require(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE, "eglMakeCurrent");
    // Without this check a machine with a GPU driver would be timed as llvmpipe.
    require(renderer().starts_with(driver == "softpipe" ? "softpipe" : "llvmpipe"),
            "the choice of the driver (found " + renderer() + ")");
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

}  // namespace strata::mesa
