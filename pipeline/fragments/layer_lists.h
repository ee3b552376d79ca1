// pipeline/fragments/layer_lists.h - the fragments of a tile by the pass of a peel that keeps them: layer after layer, made once from sorted
// columns, so that no pass looks for what it keeps.
//
// Rule     Layer i of a pixel is the first arrival of its i-th distinct key within the peel's range and before its surface. A peel
//          whose passes test LESS against the surface, of keys behind the depths that the pass before has left, keeps layer i in
//          pass i. Whether a pass stands there is asked of the depths, all pixels of them: is_left and is_surface.
// Numbers  16 bytes a fragment of a layer and 20 a pixel.
// Source   execution.md 7.1.
// Tests    tests/pipeline/fragments/layer_lists_test.cpp; tests/peeling/selection_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/fragments/sorted_fragments.h"
#include "rasterizer/base/uninitialized.h"

namespace strata::pipeline {

class LayerLists {
  public:
    // Keys [least, end), and the depths that its passes are tested against: codes of a plane, one a pixel.
    struct Peel {
        std::uint64_t least = 0, end = std::uint64_t{1} << 32;
        const std::uint32_t* surface = nullptr;
        bool is_float = false;  // codes are bits of binary32
    };
    // One fragment a pixel; pixels rise.
    struct Layer {
        std::span<const std::uint32_t> key, place, pixel;
    };
    // A later arrival of a layer's key at its pixel: the first of them has rank 1.
    struct Tied {
        std::uint32_t layer, pixel, rank;
        std::uint64_t word;
    };

    void forget() noexcept { is_built_ = false; }
    // Begins a peel, whose first layer comes next. Lists that do not serve are made anew; false if they would take more than `limit` bytes.
    [[nodiscard]] bool begin(SortedFragments& sorted, const Peel& peel, std::uint64_t limit);
    [[nodiscard]] bool is_of(const Peel& peel) const noexcept {
        return is_built_ && peel.least == least_ && peel.end == end_ && is_plane(surface_, peel.surface);
    }
    // Whether these codes, one a pixel, are those that the pass before has left; before the first pass, the surface's.
    [[nodiscard]] bool is_left(const std::uint32_t* codes) const noexcept {
        return is_built_ && is_plane(left_, codes);
    }

    // Goes on to the next layer, and puts its depths where it has any; behind the last layer it is empty.
    void advance(std::uint32_t* depths);
    // Of the layer that was gone on to last. What is tied of one rank stands in the order of pixels.
    [[nodiscard]] Layer layer() const noexcept;
    [[nodiscard]] std::span<const Tied> tied() const noexcept;
    // Fragments in the windows of its pass, and those of them that pass the depth test.
    [[nodiscard]] std::uint64_t inside() const noexcept { return inside_[counted()]; }
    [[nodiscard]] std::uint64_t passed() const noexcept { return passed_[counted()]; }
    // Whether a fragment has the surface's own code, which a peel leaves behind its last layer. It is in none.
    [[nodiscard]] bool has_any_at_surface() const noexcept { return has_any_at_surface_; }

    [[nodiscard]] std::uint64_t bytes() const noexcept { return is_built_ ? bytes_of(key_.size(), left_.size()) : 0; }

  private:
    struct Part {
        std::uint32_t first, tested,
            end;  // of a column: [first, tested) lies before the surface, [first, end) in the range
    };

    [[nodiscard]] static constexpr std::uint64_t bytes_of(std::uint64_t fragments, std::uint64_t pixels) noexcept {
        return 16 * fragments + 20 * pixels;
    }
    [[nodiscard]] static bool is_plane(const std::vector<std::uint32_t>& plane, const std::uint32_t* codes) noexcept {
        return std::equal(plane.begin(), plane.end(), codes);
    }
    [[nodiscard]] std::size_t layers() const noexcept { return begin_.size() - 1; }
    // Behind the last layer all passes but the first count alike.
    [[nodiscard]] std::size_t counted() const noexcept { return std::min(next_, inside_.size()) - 1; }
    [[nodiscard]] Part part(std::span<const std::uint64_t> words, std::uint32_t surface) const noexcept;
    void count_layers(const SortedFragments& sorted);
    void place_layers(SortedFragments& sorted);
    struct Descent;
    void place_layer(Descent& descent, std::uint32_t layer);
    [[nodiscard]] bool leave_ended(Descent& descent, std::uint32_t layer);

    bool is_built_ = false, is_float_ = false, has_any_at_surface_ = false;
    std::uint64_t least_ = 0, end_ = 0;
    std::size_t next_ = 0;
    std::vector<std::uint32_t> surface_, left_;  // by pixel
    std::vector<Part> parts_;                    // by column
    std::vector<std::uint32_t> begin_;           // of layers, and where one more would begin
    UninitializedVector<std::uint32_t> key_, place_, pixel_;
    std::vector<std::uint32_t> ended_, ended_begin_;  // pixels by how many layers they have
    std::vector<Tied> tied_;                          // by layer
    std::vector<std::uint64_t> inside_, passed_;      // by pass
};

}  // namespace strata::pipeline
