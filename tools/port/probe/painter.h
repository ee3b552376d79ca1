// tools/port/probe/painter.h - draws the test scenes of the device probe (a kit: tools/lab/probe) by OpenGL into the
// bound framebuffer, whose pixels are the device's answer.
//
// Rule     Sets all state that an item names (viewport, depth, blending, alpha test, stencil) before each draw, and
//          leaves it set. Nothing is corrected: the device's own rounding is what the probe asks for.
#pragma once
#include "tools/port/probe/kit.h"

namespace strata::port {

// True if a draw of the item discards fragments by their alpha: a core profile has no alpha test, so that a shader
// does.
[[nodiscard]] bool has_alpha_test(const KitItem& item);

// Owns the program and the buffers; the context must still be current when it is destroyed.
class Painter {
  public:
    Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;
    ~Painter();

    // Clears, then draws the whole item.
    void draw(const KitItem& item) const;

  private:
    static void draw(const KitDraw& one);

    Handle program_, query_ = make_query();
    GLuint layout_ = 0, buffer_ = 0;
};

}  // namespace strata::port
