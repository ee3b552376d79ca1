// pipeline/region/region_scratch.h - memory that a region borrows while it runs: the arrays of one batch, those of the
// rasterizer, and the recorded fragments. It is passed from region to region, so that nothing is allocated per batch
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

// Contents are valid from one stage of a batch to the next; the record, its sorted lists and `trace` are valid while
// the region exists.
struct alignas(64) RegionScratch {
    Loads loads;
    Outputs out;
    FragmentBatch screen;               // for full-screen passes
    FragmentBatch recorded;             // read from the record
    ColorLanes texel;                   // colours of a texture or shadow; truncated source of narrow surfaces
    ColorCodes codes, extra_codes;      // stored values passing through the blender
    Lanes<std::uint32_t> alive;         // for one sample
    Lanes<std::uint32_t> depth_stored;  // of the pixel that store_pixel writes
    Lanes<std::uint32_t> depth_pass;
    Lanes<std::uint32_t> stencil_stored;
    Lanes<std::uint32_t> saturated;
    TileFragments fragments;
    TileFragments::Reading reading;
    SortedLists sorted, other_sorted;  // of the record: for the current pass, and for another selection
    FragmentWaves waves;               // for the current pass
    Trace trace;
    std::vector<TargetWords> target_words;  // memory of released targets

    [[nodiscard]] TargetWords take_words() {
        if (target_words.empty()) return {};
        TargetWords words = std::move(target_words.back());
        target_words.pop_back();
        return words;
    }
    // If there is no memory for the list, the remaining words are freed.
    void keep_words(std::vector<TargetStorage>& storages) noexcept try {
        for (TargetStorage& storage : storages) target_words.push_back(storage.give_memory());
    } catch (...) {
    }
};

// Free sets, at most as many as regions ran at once. A set has no values from earlier regions.
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
    // Called by destructors: if there is no memory for the list, the scratch is freed.
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
