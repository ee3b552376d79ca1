// peeling/closed/block_pixels.h - the sixteen pixels of a block in a target of any format: loaded, and stored again.
// Tests: tests/peeling/execution_test.cpp
#pragma once
#include <algorithm>
#include <numeric>

#include "peeling/closed/block_passes.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling {

class BlockPixels {
  public:
    BlockPixels(pipeline::Region& region, const ColumnBlock& block)
        : region_{region}, first_{static_cast<std::uint32_t>(block.first)}, count_{block.count} {}

    [[nodiscard]] BlockCodes load(pipeline::Target from) {
        std::iota(pixel_.begin(), pixel_.begin() + block_lanes, first_);
        region_.storage(from).gather(pixel_, count_, 0, codes_);
        BlockCodes codes{};
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(codes_[c].begin(), count_, codes[c].begin());
        return codes;
    }
    void store(const BlockCodes& codes, pipeline::Target to) {
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(codes[c].begin(), count_, codes_[c].begin());
        pipeline::RegionShortcuts{region_}.store_pixels(to, first_, count_, codes_);
    }

  private:
    pipeline::Region& region_;
    std::uint32_t first_;
    int count_;
    pipeline::Lanes<std::uint32_t> pixel_;
    pipeline::ColorCodes codes_;
};

}  // namespace strata::peeling
