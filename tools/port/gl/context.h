// tools/port/gl/context.h - an OpenGL 3.3 context without a window, on a software driver of Mesa or on a GPU.
#pragma once
#include <string>
#include <vector>

namespace strata::port {

// llvmpipe, llvmpipe_sse (without fused multiply-add), softpipe, and hardware: any other driver that EGL finds.
[[nodiscard]] const std::vector<std::string>& driver_names();

// compatible: includes features deprecated by OpenGL 3.0, for instance the alpha test.
enum class ContextKind { core, compatible };

// The context is current on the thread that created it until the object is destroyed. All OpenGL calls of the program
// come from that thread.
class HeadlessContext {
  public:
    // A software driver rasterizes on `threads` threads (LP_NUM_THREADS). Throws std::runtime_error if EGL provides no
    // such context or another driver.
    explicit HeadlessContext(const std::string& driver, int threads, ContextKind kind = ContextKind::core);
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    // Driver and version for reports: "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6".
    [[nodiscard]] std::string renderer() const;

  private:
    // An EGLDisplay and an EGLContext, which are pointers, so that no other file includes EGL's headers.
    void* display_;
    void* context_ = nullptr;
};

}  // namespace strata::port
