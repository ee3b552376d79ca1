// peeling/programs/fragment_lists.cpp - builds the lists in two steps: the coverage bounds every list's length, then
// fragments are stored at their pixel's offset. So a pixel's list is contiguous and in submission order without
// sorting.
#include "peeling/programs/fragment_lists.h"

#include <bit>

#include "peeling/programs/fixed_passes/pixel_lists.h"
#include "peeling/programs/programs.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

constexpr rasterizer::FragmentNeeds list_needs{
    .shader_z = true, .code = true, .exact_code = true, .color = true, .texcoord = false, .facing = false};

// Stores fragments in their pixels' lists in submission order; batches number their pixels from `first` of the range.
class Filing {
  public:
    Filing(const Region& region, FragmentLists& fragment_lists, std::uint32_t first = 0)
        : first_{first},
          opaque_{region.storage(region.opaque_depth()).depth(0) + fragment_lists.pixels.first + first},
          by_shader_z_{region.frame().key == DepthKey::shader_z},
          far_{rasterizer::max_code(depth_format(region.storage(region.opaque_depth()).format()))},
          fragment_lists_{fragment_lists} {}

    void operator()(const FragmentBatch& in, const Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const std::uint32_t pixel = first_ + in.pixel[i];
            if (out.alive[i] == 0) continue;
            if (!is_visible(in, i)) {
                fragment_lists_.at_opaque[pixel] += lies_on_surface(in, i) ? 1 : 0;
                continue;
            }
            fragment_lists_.fragments[fragment_lists_.end[pixel]++] = {
                by_shader_z_ ? ordered_code(in.shader_z[i]) : in.code[i],
                in.exact_code[i],
                in.primitive[i],
                {in.color[0][i], in.color[1][i], in.color[2][i], in.color[3][i]}};
        }
    }

  private:
    // The algorithm's key must be less than the surface's; for a float key the target contains the float's bits
    // (peeling/reference/algorithms.md 0.1).
    [[nodiscard]] bool is_visible(const FragmentBatch& in, std::size_t i) const {
        const std::uint32_t opaque = opaque_[in.pixel[i]];
        return by_shader_z_ ? in.shader_z[i] < std::bit_cast<float>(opaque) : in.code[i] < opaque;
    }

    // A surface's depth is less than the far end, because LESS let it pass.
    [[nodiscard]] bool lies_on_surface(const FragmentBatch& in, std::size_t i) const {
        const std::uint32_t opaque = opaque_[in.pixel[i]];
        return opaque != far_ && (by_shader_z_ ? in.shader_z[i] == std::bit_cast<float>(opaque) : in.code[i] == opaque);
    }

    std::uint32_t first_;
    const std::uint32_t* opaque_;  // of pixel `first_` of the range
    bool by_shader_z_;
    std::uint32_t far_;  // the code of a pixel without an opaque surface
    FragmentLists& fragment_lists_;
};

}  // namespace

// A range is part of one row or whole rows (next_range), so it is a rectangle.
rasterizer::Rect rect_of(const PixelRange& pixels, const rasterizer::Rect& region) noexcept {
    const int width = region.width();
    const int first = static_cast<int>(pixels.first), size = static_cast<int>(pixels.size());
    const int x = region.x0 + first % width, y = region.y0 + first / width;
    return size < width ? rasterizer::Rect{x, y, x + size, y + 1} : rasterizer::Rect{x, y, x + width, y + size / width};
}

std::vector<std::uint32_t> coverage_of(Region& region) {
    std::vector<std::uint32_t> coverage(region.elements(), 0);
    RegionShortcuts{region}.count_coverage(coverage);
    return coverage;
}

// Advances pixel by pixel while the fragments fit. Beyond the first row the range ends only at the end of a row: `last`
// moves there, or within the row in which the range began.
PixelRange next_range(std::span<const std::uint32_t> coverage, int width, std::uint32_t first,
                      std::uint64_t most) noexcept {
    const auto columns = static_cast<std::uint32_t>(width), end = static_cast<std::uint32_t>(coverage.size());
    const std::uint32_t row_end = first - first % columns + columns;
    std::uint64_t fragments = 0;
    PixelRange range{first, first};
    for (std::uint32_t p = first; p < end && fragments + coverage[p] <= most; ++p) {
        fragments += coverage[p];
        const bool ends_row = (p + 1) % columns == 0;
        if (ends_row || p < row_end) range.last = p + 1;
        if (ends_row && first % columns != 0) break;  // the rest of the row in which the range began
    }
    range.last = std::max(range.last, first + 1);
    return range;
}

namespace {

// Space is reserved by coverage, which also counts hidden and masked fragments, so a list may end before the next one
// starts.
void start_lists(const PixelRange& pixels, std::span<const std::uint32_t> coverage, FragmentLists& fragment_lists) {
    fragment_lists.pixels = pixels;
    fragment_lists.start.resize(pixels.size());
    std::size_t fragments = 0;
    for (std::uint32_t p = 0; p < pixels.size(); ++p) {
        fragment_lists.start[p] = fragments;
        fragments += coverage[pixels.first + p];
    }
    fragment_lists.end = fragment_lists.start;
    fragment_lists.at_opaque.assign(pixels.size(), 0);
    if (fragment_lists.fragments.size() < fragments) {
        fragment_lists.fragments = {};  // frees the old fragments before the new ones are allocated
        fragment_lists.fragments.resize(fragments);
    }
}

}  // namespace

void list_visible(Region& region, const PixelRange& pixels, std::span<const std::uint32_t> coverage, Counting counting,
                  FragmentLists& fragment_lists) {
    start_lists(pixels, coverage, fragment_lists);
    if (counting == Counting::counted) {
        PassState state;
        state.needs = list_needs;
        Filing file{region, fragment_lists};
        static_cast<void>(
            region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) { file(in, out); }));
        return;
    }
    const auto area = static_cast<std::uint32_t>(region.rect().area());
    for (std::uint32_t sample = pixels.first / area; sample * area < pixels.last; ++sample) {
        const std::uint32_t first = std::max(pixels.first, sample * area),
                            last = std::min(pixels.last, (sample + 1) * area);
        Filing file{region, fragment_lists, first - pixels.first};
        const PixelRange own{first - sample * area, last - sample * area};
        static_cast<void>(RegionShortcuts{region}.visit_batches(list_needs, rect_of(own, region.rect()), sample,
                                                                [&](const FragmentBatch& in, const Outputs& out) {
                                                                    file(in, out);
                                                                    return true;
                                                                }));
    }
}

// The mean of a pixel's samples may be less than its fragments, their sum is not.
std::vector<std::uint32_t> coverage_of_pixels(Region& region) {
    std::vector<std::uint32_t> coverage = coverage_of(region);
    const std::size_t area = region.rect().area();
    for (std::size_t element = area; element < coverage.size(); ++element)
        coverage[element % area] += coverage[element];
    coverage.resize(area);
    return coverage;
}

void list_pixels(Region& region, const PixelRange& pixels, std::span<const std::uint32_t> coverage, Counting counting,
                 FragmentLists& fragment_lists) {
    start_lists(pixels, coverage, fragment_lists);
    fragment_lists.samples.resize(fragment_lists.fragments.size());
    const auto file = [&](const FragmentBatch& in, const Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            if (out.alive[i] == 0) continue;
            const std::size_t at = fragment_lists.end[in.pixel[i] - pixels.first]++;
            fragment_lists.fragments[at] = {
                in.code[i], 0, in.primitive[i], {in.color[0][i], in.color[1][i], in.color[2][i], in.color[3][i]}};
            fragment_lists.samples[at] = out.samples[i];
        }
    };
    const PassState state = state_of_pixels(region);
    if (counting == Counting::counted)
        static_cast<void>(
            region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) { file(in, out); }));
    else
        RegionShortcuts{region}.visit_pixels(state, rect_of(pixels, region.rect()), file);
}

void count_list_pass(Region& region, bool once_a_pixel) {
    PassState state;
    state.needs = {.shader_z = false, .code = false, .color = true};
    if (once_a_pixel) state = state_of_pixels(region);
    static_cast<void>(region.draw(state, [](const FragmentBatch&, const Loads&, Outputs&) {}));
}

}  // namespace strata::peeling
