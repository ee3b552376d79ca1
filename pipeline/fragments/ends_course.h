// pipeline/fragments/ends_course.h - where a peel from both ends stands in the sorted columns of a tile, so that its next pass looks for no
// bound.
//
// Rule     A pass leaves (-z, z) of what lies between its ends, which is the range of the next one: the window is then what lay between. Whether a
//          pass stands there is asked of its bounds, all pixels of them.
// Source   execution.md 7.1.
// Tests    tests/pipeline/region/peel_ends_test.cpp; tests/peeling/selection_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace strata::pipeline {

class EndsCourse {
  public:
    // Planes of one word a pixel: -z and z of a range, binary32, and a surface's depths.
    struct Bounds {
        const std::uint32_t *near = nullptr, *far = nullptr, *surface = nullptr;
    };
    // Numbers [first, last) of a column.
    struct Window {
        std::uint32_t column, first, last;
    };

    void forget() noexcept { surface_.clear(); }
    // Whether a pass with these bounds goes on from the one before, which kept the windows that are empty, or did not.
    [[nodiscard]] bool is_at(const Bounds& bounds, std::size_t pixels, bool keeps_empty) const noexcept {
        const auto is_plane = [pixels](const std::vector<std::uint32_t>& plane, const std::uint32_t* words) {
            return plane.size() == pixels && std::equal(plane.begin(), plane.end(), words);
        };
        return keeps_empty == keeps_empty_ && is_plane(surface_, bounds.surface) && is_plane(near_, bounds.near) &&
               is_plane(far_, bounds.far);
    }
    // Begins a pass: `cleared` is what it leaves in pixels with nothing between, before its surface.
    void begin(const Bounds& cleared, std::size_t pixels, bool keeps_empty) {
        std::swap(windows_, left_);
        left_.clear();
        keeps_empty_ = keeps_empty;
        near_.assign(cleared.near, cleared.near + pixels);
        far_.assign(cleared.far, cleared.far + pixels);
        surface_.assign(cleared.surface, cleared.surface + pixels);
    }
    // Of a pass that goes on.
    [[nodiscard]] const std::vector<Window>& windows() const noexcept { return windows_; }
    // What the pass leaves of a column: its next window, and the range that says so.
    void leave(const Window& window, std::uint32_t pixel, std::uint32_t near, std::uint32_t far) {
        left_.push_back(window);
        near_[pixel] = near;
        far_[pixel] = far;
    }
    void leave_empty(const Window& window) {
        if (keeps_empty_) left_.push_back(window);
    }

  private:
    bool keeps_empty_ = false;
    std::vector<Window> windows_, left_;
    std::vector<std::uint32_t> near_, far_, surface_;  // by pixel
};

}  // namespace strata::pipeline
