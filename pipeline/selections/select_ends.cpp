// pipeline/selections/select_ends.cpp - which fragments a pass of a peel from both ends visits: either end of its windows, and what lies next to
// them (execution.md 7.1).
#include <bit>

#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/selections/key_windows.h"

namespace strata::pipeline {

namespace {

// Two channels that MAX leaves (-z, z) in, of the nearest and of the farthest of what lies between the ends.
struct InnerPlanes {
    Word *near = nullptr, *far = nullptr;
};

// The same of a pixel.
struct InnerRange {
    Word near, far;
    bool is_plain;  // else a profile decides: depths that are 0, less, or denormal

    InnerRange(std::uint64_t nearest, std::uint64_t farthest) noexcept {
        constexpr std::uint32_t zero = rasterizer::ordered_code(0.0f), least = zero | 0x00800000u;
        near = (static_cast<std::uint32_t>(nearest) ^ zero) | 0x80000000u;
        far = static_cast<std::uint32_t>(farthest) ^ zero;
        is_plain = nearest >= least;
    }
    // False where the program has to say it.
    [[nodiscard]] bool put(const InnerPlanes& to, std::size_t pixel) const noexcept {
        const auto exceeds = [](Word a, Word b) { return std::bit_cast<float>(a) > std::bit_cast<float>(b); };
        if (!is_plain || !exceeds(near, to.near[pixel]) || !exceeds(far, to.far[pixel])) return false;
        to.near[pixel] = near;
        to.far[pixel] = far;
        return true;
    }
};

// Whether windows are bounded by a range and by a surface alone.
bool is_of_a_range(const FragmentSelection& s) {
    return s.range.exists() && s.before.exists() &&
           s == FragmentSelection{.keeps = Keeps::ends,
                                  .outside = s.outside,
                                  .before = s.before,
                                  .range = s.range,
                                  .keys_suffice = s.keys_suffice};
}

}  // namespace

// Ends are taken by the columns' own keys: where a bound was flushed as a denormal, they are still the ones that decide.
void Region::select_ends(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const FragmentSelection& selection = state.selection;
    const bool has_range = is_one_sample(state.color[0]) && at(state.color[0]).format() == Format::rg32f &&
                           state.blend[0] == blend_mode::max && profile().blend_storage == BlendStorage::target &&
                           selection.keys_suffice && frame_.key == DepthKey::shader_z;
    InnerPlanes inner;
    if (has_range) inner = {at(state.color[0]).texels(0).plane(0).words, at(state.color[0]).texels(0).plane(1).words};
    EndsCourse& course = scratch_->sorted.ends_course();
    const bool has_course = has_range && is_of_a_range(selection);
    bool goes_on = false;
    if (has_course) {
        const Texels range = storage(selection.range).texels(0);
        const std::uint32_t* const surface = codes_of(selection.before);
        const bool keeps_empty = selection.outside == Outside::one_value;
        goes_on = course.is_at({range.plane(0).words, range.plane(1).words, surface}, sorted.pixels(), keeps_empty);
        course.begin({inner.near, inner.far, surface}, sorted.pixels(), keeps_empty);
    }
    std::uint64_t done = 0;
    SelectedFragments::Ends ends = selected.begin_ends();
    SelectedFragments::Filling &nearest = ends[0], &after_nearest = ends[1], &before_farthest = ends[2],
                               &farthest = ends[3];
    const auto visit = [&](const WindowColumn& column) {
        const auto& [number, p, words, first, last, tested, low] = column;
        std::size_t rank = SelectedFragments::end_ranks;  // of what is tied with an end
        const auto key = [&column](std::uint32_t k) { return column.words[k] >> 32; };
        std::uint32_t near_end = first, far_begin = last;
        if (first < last) nearest.add(p, words[near_end++]);
        while (near_end < last && key(near_end) == key(first)) selected.add(p, words[near_end++], rank++);
        while (far_begin > near_end && key(far_begin - 1) == key(last - 1)) --far_begin;
        const EndsCourse::Window left{number, near_end, far_begin};
        if (near_end < far_begin) {
            const bool has_two = near_end + 1 < far_begin;
            const InnerRange between{key(near_end), key(far_begin - 1)};
            if (has_range && between.put(inner, p)) {
                done += has_two ? 2 : 1;
            } else {
                after_nearest.add(p, words[near_end]);
                if (has_two) before_farthest.add(p, words[far_begin - 1]);
            }
            if (has_course) course.leave(left, p, between.near, between.far);
        } else if (has_course) {
            course.leave_empty(left);
        }
        if (far_begin < last) farthest.add(p, words[far_begin]);
        for (std::uint32_t k = far_begin + 1; k < last; ++k) selected.add(p, words[k], rank++);
        // Only where the window writes nothing but its first key does the value of those outside come from outside.
        if (selection.outside == Outside::one_value && near_end == last && last - first < words.size())
            after_nearest.add(p, words[first > 0 ? 0 : last]);
    };
    if (goes_on)
        for (const auto& [number, first, last] : course.windows())
            visit({number, sorted.occupied()[number], sorted.column(number), first, last, last, 0});
    else
        for_each_column(sorted,
                        window_of(selection, frame_, [&](Target t) -> const TargetStorage& { return storage(t); }),
                        nullptr, selected.windows, visit);
    selected.finish_ends(ends);
    count_visits(done);
}

}  // namespace strata::pipeline
