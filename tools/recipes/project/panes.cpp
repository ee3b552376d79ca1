#include "panes.h"

#include <cmath>
#include <cstdlib>

namespace {

// Twice the signed area of (a, b, p); above 0 on the left of the edge.
double side(const float* a, const float* b, double x, double y) {
    return (double{b[0]} - a[0]) * (y - a[1]) - (double{b[1]} - a[1]) * (x - a[0]);
}

bool covers(const Pane& pane, double x, double y) {
    const float *a = pane.corners, *b = a + 3, *c = a + 6;
    return side(a, b, x, y) > 0 && side(b, c, x, y) > 0 && side(c, a, x, y) > 0;
}

}  // namespace

std::vector<unsigned char> draw_panes() {
    // A deliberate mistake, for the test that must detect it.
    const bool blends_wrongly = std::getenv("PANES_BLEND_WRONGLY") != nullptr;
    std::vector<unsigned char> pixels(4 * width * height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            unsigned char* pixel = &pixels[static_cast<std::size_t>(4 * (y * width + x))];
            pixel[3] = 255;
            for (const Pane& pane : panes) {
                if (!covers(pane, (x + 0.5) / width * 2 - 1, 1 - (y + 0.5) / height * 2)) continue;
                const float alpha = pane.color[3], through = blends_wrongly ? 1 : 1 - alpha;
                for (int c = 0; c < 3; ++c)
                    pixel[c] = static_cast<unsigned char>(std::fmin(
                        255, std::floor(255 * pane.color[c] * alpha + static_cast<float>(pixel[c]) * through + 0.5f)));
            }
        }
    return pixels;
}
