// The program under test: two panes of glass, far and near, drawn over black.
#pragma once
#include <vector>

inline constexpr int width = 64, height = 48;

// A pane is a triangle in clip space with one colour: red, green, blue and alpha, not premultiplied.
struct Pane {
    float corners[9];
    float color[4];
};
inline constexpr Pane panes[] = {{{-0.9f, -0.8f, 0.5f, 0.7f, -0.8f, 0.5f, -0.9f, 0.9f, 0.5f}, {1, 0.5f, 0, 0.5f}},
                                 {{-0.7f, -0.9f, 0, 0.9f, -0.6f, 0, 0.1f, 0.8f, 0}, {0, 0.25f, 1, 0.75f}}};

// 8-bit red, green, blue and alpha, the top row first.
std::vector<unsigned char> draw_panes();
