// tools/bench/mesa/context.h - an OpenGL 4.5 core context on llvmpipe without a window.
#pragma once
#include <string>

namespace strata::mesa {

// The context is current on the thread that made it until the object ends. All OpenGL calls of the
// program come from that thread.
class HeadlessContext {
  public:
    // llvmpipe rasterizes on `threads` threads (LP_NUM_THREADS). Throws std::runtime_error where
    // EGL gives no such context or another driver than llvmpipe.
    explicit HeadlessContext(const std::string& driver, int threads);
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    // Driver and version as a run reports them: "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core
    // Profile) Mesa 22.3.6".
    [[nodiscard]] std::string renderer() const;

  private:
    // An EGLDisplay and an EGLContext, which are pointers, so that no other file needs EGL's
    // headers.
    void* display_;
    void* context_ = nullptr;
};

}  // namespace strata::mesa
