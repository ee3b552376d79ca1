// pipeline/region/region_scratch.h - what a region borrows while it runs: the arrays that one batch passes through, the
// rasterizer's own, and the captured fragments. Handed from region to region, so that nothing is allocated per batch
// and little per tile.
#pragma once
#include <memory>
#include <mutex>
#include <vector>

#include "pipeline/fragments/fragment_waves.h"
#include "pipeline/fragments/sorted_lists.h"
#include "pipeline/fragments/tile_fragments.h"
#include "pipeline/frame/pass.h"
#include "pipeline/frame/trace.h"
#include "pipeline/stages/target_storage.h"
#include "rasterizer/base/uninitialized.h"

namespace strata::pipeline {

// Contents last from one stage of a batch to the next, but for the record and what is sorted of it, `trace`, which last
// as long as the region.
struct alignas(64) RegionScratch {
    Loads loads;
    Outputs out;
    FragmentBatch screen;               // of full-screen passes
    FragmentBatch recorded;             // from the record
    ColorLanes texel;                   // a texture's or a shadow's colours; also the cut source of narrow surfaces
    ColorCodes codes, idle_codes;       // stored values on their way through the blender
    Lanes<std::uint32_t> alive;         // of one sample
    Lanes<std::uint32_t> depth_stored;  // of a pixel that is stored alone
    Lanes<std::uint32_t> depth_pass;
    Lanes<std::uint32_t> stencil_stored;
    Lanes<std::uint32_t> saturated;
    TileFragments fragments;
    TileFragments::Reading reading;
    SortedLists sorted, other_sorted;  // of the record: what the present pass looks into, and what another did
    FragmentWaves waves;               // of the present pass
    Trace trace;
    std::vector<TargetWords> target_words;  // of targets that are no more

    [[nodiscard]] TargetWords take_words() {
        if (target_words.empty()) return {};
        TargetWords words = std::move(target_words.back());
        target_words.pop_back();
        return words;
    }
    // Where there is no memory for the list, the rest of the words goes.
    void keep_words(std::vector<TargetStorage>& storages) noexcept try {
        for (TargetStorage& storage : storages) target_words.push_back(storage.give_memory());
    } catch (...) {
    }
};

// Free sets; as many as regions ever ran at once. A set carries no values from one region to the next.
class RegionScratchPool {
  public:
    [[nodiscard]] std::unique_ptr<RegionScratch> take() {
        const std::scoped_lock lock{mutex_};
        if (free_.empty()) return std::make_unique<RegionScratch>();
        std::unique_ptr<RegionScratch> scratch = std::move(free_.back());
        free_.pop_back();
        scratch->fragments.forget();
        scratch->sorted.forget();
        scratch->other_sorted.forget();
        return scratch;
    }
    // Called by destructors: where there is no memory for the list, the scratch goes.
    void give(std::unique_ptr<RegionScratch> scratch) noexcept try {
        const std::scoped_lock lock{mutex_};
        free_.push_back(std::move(scratch));
    } catch (...) {
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<RegionScratch>> free_;
};

}  // namespace strata::pipeline
