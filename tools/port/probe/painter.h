// tools/port/probe/painter.h - draws the scenes of a kit into the bound framebuffer.
#pragma once
#include "tools/port/probe/kit.h"

namespace strata::port {

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
