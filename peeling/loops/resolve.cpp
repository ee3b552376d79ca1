// peeling/loops/resolve.cpp - peels as resolves: pass i of dual takes the i-th depth from the front and the i-th from
// the back, pass i of front_to_back the i-th from the front. They run by default instead of the passes of
// peeling/algorithms/dual.cpp and front_to_back.cpp, which define them: bits, passes, queries and trace are the same.
// tests/peeling/execution/execution_test.cpp and dense_meshes_test.cpp compare the two.
//
// Declines   where a pixel's fragments alone do not decide how far it is peeled (a ratio, the paper's exit), where
//            passes compute different depths of a fragment, layers are kept, the background's alpha is not 1, the
//            colour format is not one of stored_color.h or not that of back and picture, or no record can be sorted;
//            of dual also where MAX depends on the order or changes a depth: float targets with colours that are not
//            plain (block_passes.h), visible depths below the cleared -1, denormals that are flushed. Then the passes
//            run.
// Source     peeling/reference/algorithms.md 0.7.
// Ties       dual: fragments of one depth are one group; front_to_back: the first of them (block_passes.h).
#include "peeling/loops/resolve.h"

#include <algorithm>
#include <numeric>

#include "peeling/loops/block_passes.h"
#include "peeling/programs/min_max.h"
#include "peeling/programs/region_programs.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// The reason why the resolve does not apply to the frame; null if it may be tried.
const char* why_not(const Frame& frame) {
    using enum TerminationRule;
    const auto rule = frame.termination.rule;
    const bool is_known = frame.color_format == Format::rgba8 || frame.color_format == Format::rgba16f ||
                          frame.color_format == Format::rgba32f;
    if (!is_known) return "the colour format is none of rgba8, rgba16f and rgba32f";
    if (rule != exact && rule != any && rule != fixed) return "--termination asks after every pass how many are left";
    if (!frame.is_invariant()) return "passes compare other depths than they store, or draw other vertices";
    if (frame.published_format || frame.back_format) return "the back or the picture has a format of its own";
    if (!frame.is_opaque()) return "the background's alpha is not 1";
    return frame.keep_layers ? "layers are kept" : nullptr;
}

// A limit of passes also counts the passes that peel nothing.
BlockRules rules_of(const Frame& frame, int others) {
    BlockRules rules{.color = color_rules(*frame.profile, frame.color_format)};
    const int fixed = frame.termination.rule == TerminationRule::fixed ? frame.termination.passes : 0;
    for (const int limit : {frame.max_passes, fixed})
        if (limit > 0) rules.most_passes = std::min(rules.most_passes, static_cast<std::uint32_t>(limit - others));
    return rules;
}

// True if a depth is changed by MAX blending of (-z, z) onto (-1, -1), or has no order (rasterizer/reference/depth.md
// 2.9).
bool has_foreign_depths(const TileFragments& fragments, const DeviceProfile& profile) {
    const std::uint32_t flushes = profile.denormals == DenormalRule::flush ? ~0u : 0u;
    const std::uint32_t wraps = profile.raster.depth_limits == rasterizer::DepthLimits::wrap ? ~0u : 0u;
    std::uint32_t foreign = 0;
    for (const float z : fragments.shader_z()) {
        const std::uint32_t size = std::bit_cast<std::uint32_t>(z) & 0x7fffffffu;
        const std::uint32_t is_denormal = size - 1 < 0x7fffffu ? flushes : 0, is_below = z < -1.0f ? ~0u : 0;
        foreign |= is_below | is_denormal | (z >= 0.0f && z <= 1.0f ? 0 : wraps);
    }
    return foreign != 0;
}

// The number of distinct depths of a sorted list.
std::uint32_t distinct(const ListBlock& block, std::size_t lane) {
    std::uint32_t depths = 0;
    const std::uint32_t end = block.visible[lane];
    for (std::uint32_t k = 0; k < end; k = block.end_of_depth(lane, k, end)) ++depths;
    return depths;
}

std::uint32_t most_distinct(const ListBlock& block) {
    std::uint32_t most = 0;
    for (std::size_t lane = 0; lane < block_lanes; ++lane)
        most = std::max(most, block.has_ties[lane] != 0 ? distinct(block, lane) : block.visible[lane]);
    return most;
}

// What the passes of a peel take and count.
struct BothEnds {
    static constexpr DepthKey key = DepthKey::shader_z;
    static constexpr FrontAlpha meaning = FrontAlpha::covers;
    static constexpr int other_passes = 1;  // that peel nothing
    static constexpr PassCount before{.geometry = 1, .copies = 1}, each{.geometry = 1, .full_screen = 1};
    static constexpr auto peel = peel_both_ends;

    [[nodiscard]] static bool finds_more(std::uint64_t deepest, std::uint64_t passes) { return deepest > 2 * passes; }

    // Pass by pass, the front before the back. near == far is one group, which counts as near (algorithms.md 5.1).
    template <class Add>
    static void trace(const ListBlock& block, std::size_t lane, std::uint32_t most_passes, const Add& add) {
        std::uint32_t near = 0, far = block.visible[lane];
        for (std::uint32_t pass = 0; near < far && pass < most_passes; ++pass) {
            add(near, Side::front);
            near = block.end_of_depth(lane, near, far);
            if (near == far) break;
            add(far - 1, Side::back);
            far = block.begin_of_depth(lane, near, far - 1);
        }
    }
};

struct NearEnd {
    static constexpr DepthKey key = DepthKey::stored_code;
    static constexpr FrontAlpha meaning = FrontAlpha::lets_through;
    static constexpr int other_passes = 0;
    static constexpr PassCount before{}, each{.geometry = 1, .full_screen = 1, .copies = 1};

    static bool peel(const ListBlock& block, BlockCodes& front, BlockCodes&, const BlockRules& rules) {
        peel_near_end(block, front, rules);
        return true;
    }
    [[nodiscard]] static bool finds_more(std::uint64_t deepest, std::uint64_t passes) { return deepest >= passes; }

    template <class Add>
    static void trace(const ListBlock& block, std::size_t lane, std::uint32_t most_passes, const Add& add) {
        const std::uint32_t end = block.visible[lane];
        std::uint32_t layers = 0;
        for (std::uint32_t k = 0; k < end && layers < most_passes; k = block.end_of_depth(lane, k, end), ++layers)
            add(k, Side::front);
    }
};

// The codes of a front before the first pass.
template <class Ends>
BlockCodes cleared_front(const Region& region) {
    const float alpha = Ends::meaning == FrontAlpha::lets_through ? 1.0f : 0.0f;
    const auto codes = color_codes(region.frame().color_format, region.profile().color_rounding(), {0, 0, 0, alpha});
    BlockCodes front;
    for (std::size_t c = 0; c < 4; ++c) front[c].fill(codes[c]);
    return front;
}

// The resolve of blocks of an rgba8 region, from their opaque colours to the last quad.
template <class Ends>
class Rgba8Course {
  public:
    explicit Rgba8Course(Region& region)
        : region_{region},
          target_{region.make_color()},
          opaque_{RegionShortcuts{region}.words(region.opaque_color())},
          result_{RegionShortcuts{region}.words(target_)},
          cleared_{cleared_front<Ends>(region)} {
        for (std::size_t pixel = 0; pixel < region.elements(); ++pixel)  // pixels without a fragment
            result_[pixel] = opaque_[pixel] | 0xff000000u;
    }

    // False if MAX does not order the colours.
    bool run(const ListBlock& block, const BlockRules& rules) {
        BlockCodes front = cleared_, back = codes_of(opaque_ + block.first);
        const bool is_plain = Ends::peel(block, front, back, rules);
        composite_block(front, back, Ends::meaning, rules, result_ + block.first);
        return is_plain;
    }

    void publish() {
        RegionShortcuts{region_}.count_passes({.full_screen = 1});
        region_.publish(target_);
    }

  private:
    Region& region_;
    Target target_;
    const Word* opaque_;
    Word* result_;
    BlockCodes cleared_;
};

// The resolve for float targets, which are stored: the last quad is a pass, because only a pass determines which of two
// NaNs is kept.
template <class Ends>
class FloatCourse {
  public:
    explicit FloatCourse(Region& region)
        : region_{region},
          front_{region.make_color()},
          back_{region.make_color()},
          cleared_{cleared_front<Ends>(region)} {
        RegionShortcuts{region}.uncounted([&] {
            region.clear(front_, {.color = {0, 0, 0, Ends::meaning == FrontAlpha::lets_through ? 1.0f : 0.0f}});
            region.copy(region.opaque_color(), back_);
        });
    }

    bool run(const ListBlock& block, const BlockRules& rules) {
        const auto first = static_cast<std::uint32_t>(block.first);
        BlockCodes front = cleared_, back{};
        std::iota(pixel_.begin(), pixel_.begin() + block_lanes, first);
        region_.storage(region_.opaque_color()).gather(pixel_, block.count, 0, codes_);
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(codes_[c].begin(), block.count, back[c].begin());
        const bool is_plain = Ends::peel(block, front, back, rules);
        store(front, first, block.count, front_);
        store(back, first, block.count, back_);
        return is_plain;
    }

    void publish() { publish_over(region_, front_, Ends::meaning, back_); }

  private:
    void store(const BlockCodes& codes, std::uint32_t first, int count, Target to) {
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(codes[c].begin(), count, codes_[c].begin());
        RegionShortcuts{region_}.store_pixels(to, first, count, codes_);
    }

    Region& region_;
    Target front_, back_;
    BlockCodes cleared_;
    Lanes<std::uint32_t> pixel_;
    ColorCodes codes_;
};

// Colours first, then passes: nothing is counted while a later colour may still be one that MAX does not order, and the
// trace is truncated to its former length in that case.
template <class Ends, class Course>
bool peel_region(Region& region, const SortedRecord& record) {
    RegionShortcuts shortcuts{region};
    const BlockRules rules = rules_of(region.frame(), Ends::other_passes);
    const std::uint32_t* const surface = region.storage(region.opaque_depth()).depth(0);
    const std::size_t traced = shortcuts.trace().size();
    Course course{region};
    std::uint32_t deepest = 0;
    bool is_plain = true;
    for (std::size_t number = 0; number < record.sorted.blocks(); ++number) {
        if (record.sorted.height(number) == 0) continue;
        const ListBlock block = block_of(record.sorted, number, Ends::key, surface, record.fragments.color().data());
        if (block.height == 0) continue;
        deepest = std::max(deepest, most_distinct(block));
        is_plain &= course.run(block, rules);
        if (!region.frame().trace) continue;
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane)
            Ends::trace(block, lane, rules.most_passes, [&](std::uint32_t k, Side side) {
                region.trace({static_cast<std::uint32_t>(block.first + lane), block.key(lane, k), 0, side, false});
            });
    }
    if (!is_plain) {
        shortcuts.trace().shorten(traced);
        return false;
    }
    shortcuts.count_passes(Ends::before);
    for (std::uint64_t passes = 1; !region.limit_reached(); ++passes) {
        region.begin_iteration();
        shortcuts.count_passes(Ends::each);
        const auto query = RegionShortcuts::query_of(Ends::finds_more(deepest, passes) ? 1 : 0);
        if (!region.any(query, Idle::yes)) break;
    }
    course.publish();
    return true;
}

// Notes why the loop was not computed from the record, or that it was.
template <class Ends>
bool resolve(Region& region) {
    RegionShortcuts shortcuts{region};
    const auto declines = [&](const char* reason) {
        shortcuts.note_resolved(reason);
        return reason != nullptr;
    };
    constexpr bool is_value = Ends::key == DepthKey::shader_z;
    if (declines(why_not(region.frame()))) return false;
    const auto record = shortcuts.sorted_record({.shader_z = is_value, .code = !is_value, .color = true});
    if (declines(record ? nullptr : "a tile's fragments are not recorded, or their depths have no order")) return false;
    if (is_value && has_foreign_depths(record->fragments, region.profile()))
        return !declines("MAX does not keep every depth as it is");
    const bool is_done = region.frame().color_format == Format::rgba8
                             ? peel_region<Ends, Rgba8Course<Ends>>(region, *record)
                             : peel_region<Ends, FloatCourse<Ends>>(region, *record);
    return !declines(is_done ? nullptr : "MAX does not order the colours of this float target");
}

}  // namespace

bool dual_resolve(Region& region) { return resolve<BothEnds>(region); }
bool front_to_back_resolve(Region& region) { return resolve<NearEnd>(region); }

}  // namespace strata::peeling
