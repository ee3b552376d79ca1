// tools/oracle/program/drawing/surfaces.h - all surfaces of a scene at every pixel, opaque ones and those that they
// hide too: what a port may draw that keeps other opaque surfaces.
//
// Rule     The scene is drawn with all its materials transparent and kept apart by material. Pixels are those of the
//          given lists, in their order.
// Tests    tests/tools/oracle/program/drawing_test.cpp
#pragma once
#include <string>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/program/lists.h"

namespace strata::oracle::program {

struct SceneSurfaces {
    Lists opaque{};  // all opaque fragments of a pixel, near to far; `submission` counts all surfaces of the pixel
    std::vector<std::vector<ListFragment>> layers{};  // all transparent ones, hidden ones too, near to far
    Color background{};
    [[nodiscard]] bool has_opaque() const noexcept { return !opaque.fragments.empty(); }
};

// `alike`: lists of the same scene. Empty if all surfaces are transparent.
[[nodiscard]] SceneSurfaces surfaces_of(const peeling::FrameRequest& input, const Lists& alike);

// "it comes out so if ...": the opaque surface behind the nearest one that gives the colour of the pixel, with the
// layers before it; "" if none does.
[[nodiscard]] std::string shown_surface(const peeling::FrameRequest& input, int x, int y, const Color& seen);

}  // namespace strata::oracle::program
