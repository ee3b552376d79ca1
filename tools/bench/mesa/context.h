// tools/bench/mesa/context.h - an OpenGL 4.5 core context on llvmpipe without a window.
#pragma once
#include <string>

namespace strata::mesa {

// Current on this thread until it ends. `threads` rasterize (LP_NUM_THREADS); std::runtime_error if there is no such
// context.
class HeadlessContext {
  public:
    explicit HeadlessContext(int threads);
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    [[nodiscard]] std::string renderer() const;  // "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6"

  private:
    void* display_;
    void* context_ = nullptr;
};

}  // namespace strata::mesa
