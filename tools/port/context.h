// tools/port/context.h - an OpenGL 3.3 context without a window: on Mesa's software drivers, or on a GPU's.
#pragma once
#include <string>
#include <vector>

namespace strata::port {

// llvmpipe, llvmpipe_sse (without fused multiply-add), softpipe, and hardware: whatever else EGL finds.
[[nodiscard]] const std::vector<std::string>& driver_names();

// compatible: with what OpenGL 3.0 deprecated, the alpha test for instance.
enum class ContextKind { core, compatible };

// The context is current on the thread that made it until the object ends. All OpenGL calls of the
// program come from that thread.
class HeadlessContext {
  public:
    // A software driver rasterizes on `threads` threads (LP_NUM_THREADS). Throws std::runtime_error where EGL gives no
    // such context or another driver.
    explicit HeadlessContext(const std::string& driver, int threads, ContextKind kind = ContextKind::core);
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

}  // namespace strata::port
