// peeling/closed/block_course.h - the blocks of a region from their opaque colours to the frame's: what closed forms peel into.
//
// Rule     A front begins cleared, as its alpha's meaning says; the last quad puts it over what lies behind it. On rgba8
//          a block goes up to that quad at once; floats are stored, and the quad is a pass, which alone says which of
//          two NaN stays.
// Tests    tests/peeling/execution_test.cpp: against literal execution
#pragma once
#include <algorithm>
#include <numeric>

#include "peeling/closed/block_passes.h"
#include "peeling/closed/closed_form.h"
#include "peeling/programs/region_programs.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling {

class Rgba8Course {
  public:
    Rgba8Course(pipeline::Region& region, FrontAlpha meaning, const BlockRules& rules)
        : region_{region},
          rules_{rules},
          meaning_{meaning},
          target_{region.make_color()},
          opaque_{pipeline::RegionShortcuts{region}.words(region.opaque_color())},
          result_{pipeline::RegionShortcuts{region}.words(target_)} {
        if (meaning == FrontAlpha::lets_through) cleared_[3].fill(255);
        for (std::size_t pixel = 0; pixel < region.rect().area(); ++pixel)  // where there is no fragment
            result_[pixel] = opaque_[pixel] | 0xff000000u;
    }

    // What peel(block, front, back, rules) answers.
    bool run(const ColumnBlock& block, auto peel) {
        BlockCodes front = cleared_, back = codes_of(opaque_ + block.first);
        const bool is_done = peel(block, front, back, rules_);
        composite_block(front, back, meaning_, rules_, result_ + block.first);
        return is_done;
    }

    void publish() {
        using namespace pipeline;
        RegionShortcuts{region_}.book({.full_screen = 1});
        region_.publish(target_);
    }

  private:
    pipeline::Region& region_;
    BlockRules rules_;
    FrontAlpha meaning_;
    pipeline::Target target_;
    const std::uint32_t* opaque_;  // words of the region
    std::uint32_t* result_;
    BlockCodes cleared_{};
};

class FloatCourse {
  public:
    FloatCourse(pipeline::Region& region, FrontAlpha meaning, const BlockRules& rules)
        : region_{region}, rules_{rules}, meaning_{meaning}, front_{region.make_color()} {
        const pipeline::Rgba cleared{0, 0, 0, meaning == FrontAlpha::lets_through ? 1.0f : 0.0f};
        cleared_ = color_codes(region.frame().color_format, rules_.color.rounding, cleared);
        if (meaning == FrontAlpha::covers) back_ = region.make_color();
        region.uncounted([&] {
            region.clear(front_, {.color = cleared});
            if (back_.exists()) region.copy(region.opaque_color(), back_);
        });
    }

    bool run(const ColumnBlock& block, auto peel) {
        const auto first = static_cast<std::uint32_t>(block.first);
        BlockCodes front, back{};
        for (std::size_t c = 0; c < 4; ++c) front[c].fill(cleared_[c]);
        if (back_.exists()) load(first, block.count, back);
        const bool is_done = peel(block, front, back, rules_);
        store(front, first, block.count, front_);
        if (back_.exists()) store(back, first, block.count, back_);
        return is_done;
    }

    void publish() { publish_over(region_, front_, meaning_, back_.exists() ? back_ : region_.opaque_color()); }

  private:
    void load(std::uint32_t first, int count, BlockCodes& codes) {
        std::iota(pixel_.begin(), pixel_.begin() + block_lanes, first);
        region_.storage(region_.opaque_color()).gather(pixel_, count, 0, codes_);
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(codes_[c].begin(), count, codes[c].begin());
    }
    void store(const BlockCodes& codes, std::uint32_t first, int count, pipeline::Target to) {
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(codes[c].begin(), count, codes_[c].begin());
        pipeline::RegionShortcuts{region_}.store_pixels(to, first, count, codes_);
    }

    pipeline::Region& region_;
    BlockRules rules_;
    FrontAlpha meaning_;
    pipeline::Target front_, back_{};  // no back where nothing is blended onto it
    std::array<std::uint32_t, 4> cleared_;
    pipeline::Lanes<std::uint32_t> pixel_;
    pipeline::ColorCodes codes_;
};

}  // namespace strata::peeling
