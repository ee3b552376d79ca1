#include "tools/lab/hardware_check/drawing/seven_figures.h"

namespace strata::hardware_check {

namespace {

// In turn, by vertex.
constexpr Argb palette[] = {0xff3333ff, 0xff33ff33, 0xffff3333, 0xff33ffff,
                            0xffffff33, 0xffff33ff, 0xff808080, 0xffffffff};

}  // namespace

const std::vector<Figure>& seven_figures() {
    static const std::vector<Figure> figures{
        {Topology::points,
         {{19, 15},
          {56, 29},
          {74, 77},
          {45.694406f, 101.330152f},
          {36, 38.369815f},
          {14, 23},
          {85, 98},
          {31, 40},
          {98, 38},
          {17, 104},
          {78, 65},
          {31.644774f, 49},
          {105, 11.968842f},
          {9, 40},
          {105.962647f, 76.068491f},
          {80, 87}}},
        {Topology::line_loop,
         {{196, 47},
          {194, 19},
          {182, 97},
          {106.186250f, 80},
          {127, 94.581630f},
          {133.597443f, 13.763389f},
          {205, 62},
          {115.543920f, 16},
          {122, 3},
          {117.062706f, 87.735558f},
          {201, 28.664894f},
          {146.114091f, 10},
          {205.356591f, 88},
          {125, 107},
          {190.828953f, 35.510304f},
          {163, 105.956814f}}},
        {Topology::triangles,
         {{265.185925f, 35},
          {249.778838f, 22.523717f},
          {310, 19},
          {243.978231f, 47.650185f},
          {304, 37},
          {232, 102.522615f}}},
        {Topology::quad_strip, {{0, 239}, {0, 120}, {52.5f, 225.4f}, {54.75f, 175.5f}, {105, 239}, {105, 120}}},
        {Topology::triangle_fan,
         {{158.5f, 205},
          {115.545455f, 239},
          {120.318182f, 120},
          {147.045455f, 157.4f},
          {158.5f, 128.5f},
          {166.136364f, 145.5f},
          {204.318182f, 159.1f},
          {209.75f, 239}}},
        {Topology::polygon,
         {{218, 232}, {237.772727f, 142.1f}, {258.772727f, 120}, {302.681818f, 169.3f}, {317, 230.5f}}},
        {Topology::quads, {{0, 350}, {60, 340}, {58.5f, 425.4f}, {12.75f, 407.5f}}}};
    return figures;
}

void draw_figures(pipeline::Surface& surface, const std::vector<Figure>& figures, float x, float y, PolygonMode mode,
                  const pipeline::DrawState& state) {
    for (const Figure& figure : figures) {
        std::vector<ClipVertex> vertices;
        for (const auto& [px, py] : figure.points)
            vertices.push_back(at(x + px, y + py, palette[vertices.size() % std::size(palette)]));
        SplitDraw draw = split_draw(figure.topology, vertices, mode);
        surface.draw(state, std::move(draw.soup), draw.primitive);
    }
}

}  // namespace strata::hardware_check
