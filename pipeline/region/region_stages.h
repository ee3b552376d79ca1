// pipeline/region/region_stages.h - one pass over batches: the stages from a batch's values to the render targets, in
// OpenGL's order.
//
// Rule     begin_pass; for each batch start_batch, shade, load, the program, finish; open_cache before the first batch,
//          close_cache after the last.
// Source   pipeline/reference/fragment-stages.md 1.
// Tests    tests/pipeline/region/region_test.cpp, tests/peeling/execution/execution_test.cpp
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/frame/alteration.h"
#include "pipeline/frame/observer.h"
#include "pipeline/stages/target_storage.h"
#include "pipeline/vertices/prepare.h"

namespace strata::pipeline {

class Targets;
class TileCache;
struct PixelBatch;
struct RegionShared;

class Stages {
  public:
    Stages(const RegionShared& shared, Targets& targets) noexcept;
    Stages(const Stages&) = delete;
    Stages& operator=(const Stages&) = delete;
    ~Stages();

    void begin_pass(const PassState& state, PassKind kind);
    void begin_query() noexcept { kind_ = PassKind::full_screen; }  // for Region::trace_pixels, which is not a pass
    // Sets what is known about the depth test of this pass, and what the colours that it looks at use.
    void set_depth(DepthOutcome outcome) noexcept { depth_ = outcome; }
    void set_material(const MaterialNeeds& shaded) noexcept { shaded_ = shaded; }
    [[nodiscard]] int samples() const noexcept { return samples_; }  // of the pass's targets

    // Called around the batches of a pass whose blends are stored in binary32 (tile_cache.h); no effect for other
    // profiles.
    void open_cache(const PassState& state);
    void close_cache();
    [[nodiscard]] Outputs& start_batch(const FragmentBatch& batch);
    // The elements of a full-screen pass, sample by sample and row by row, from index `next` on, of one sample per
    // batch; null after the last.
    [[nodiscard]] FragmentBatch* next_screen_batch(std::size_t& next);
    void shade(const PreparedDraw& list, FragmentBatch& batch, Outputs& out);  // material stage: texture, MASK
    void load(const PassState& state, const FragmentBatch& batch);
    [[nodiscard]] const Loads& loads() const noexcept;
    // `program` runs the pass's program over the batch.
    void run_program(const PassState& state, FragmentBatch& batch, Outputs& out, const std::function<void()>& program);
    void finish(const PassState& state, const FragmentBatch& batch, Outputs& out, DrawCounts& drawn);
    // For a pass once a pixel: tests every sample before the program; after it writes the samples that remain.
    [[nodiscard]] Outputs& test_pixels(const PassState& state, PixelBatch& pixels, DrawCounts& drawn);
    void write_pixels(const PassState& state, PixelBatch& pixels, Outputs& out, DrawCounts& drawn);
    // True if the pass's values are evaluated at the centroid of the samples that pass its depth test (13.7).
    [[nodiscard]] bool moves_centroids(const PassState& state, const PreparedDraw& list) const;
    // Calls `work` with the batch of each sample, and the outputs with its covered lanes alive.
    void for_each_sample(const PassState& state, PixelBatch& pixels,
                         const std::function<void(FragmentBatch&, Outputs&)>& work);
    void record_trace(const FragmentBatch& batch, const Outputs& out, const Lanes<std::uint32_t>& alive);
    void show(Stage stage, const PassState& state, const FragmentBatch& batch, const Outputs& out,
              const Lanes<std::uint32_t>& alive, int sample = 0) const;

  private:
    // The sample that the loads of the current pass read.
    [[nodiscard]] LoadedSample loaded_sample() const noexcept;
    [[nodiscard]] Lanes<std::uint32_t> elements_of(const FragmentBatch& batch, std::size_t sample) const noexcept;
    void load_resolved(TargetStorage& from, std::size_t read, const FragmentBatch& batch);
    void decode_loaded(Format stored, std::size_t read, int count);
    void load_target(TargetStorage& from, std::size_t read, const Lanes<std::uint32_t>& elements, int count);
    // SAMPLE_ALPHA_TO_COVERAGE, SAMPLE_COVERAGE and the sample mask (pipeline/reference/fragment-stages.md 13.6).
    void cover_samples(const PassState& state, const FragmentBatch& batch, Outputs& out);
    void finish_sample(const PassState& state, const FragmentBatch& batch, const Outputs& out, int sample,
                       DrawCounts& drawn);
    std::uint64_t test_depth_and_stencil(const PassState& state, const FragmentBatch& batch, int sample,
                                         Lanes<std::uint32_t>& alive);  // returns the number that pass
    std::uint64_t test_stencil(const PassState& state, const FragmentBatch& batch, int sample,
                               Lanes<std::uint32_t>& alive);
    void test_depth_units(const PassState& state, const FragmentBatch& batch, int sample, Lanes<std::uint32_t>& alive);
    void extra_alpha_test(const PassState& state, const FragmentBatch& batch, Outputs& out);
    void extra_tests(const PassState& state, const FragmentBatch& batch, Lanes<std::uint32_t>& alive);
    void extra_blend(const Blend& blending, const FragmentBatch& batch, const ColorLanes& color,
                     const TargetStorage& target, int sample);
    void count_color_bytes(const Blend& blending, const TargetStorage& target, std::uint64_t pixels);
    void report_saturation(const FragmentBatch& batch);
    // Writes the targets that have `elements` elements.
    void write_colors(const PassState& state, const FragmentBatch& batch, const Outputs& out, int sample,
                      const Lanes<std::uint32_t>& alive, std::uint64_t passed, std::size_t elements);
    void require_elements(const PassState& state) const;
    [[nodiscard]] static std::uint64_t alive_count(const Outputs& out, int count) noexcept;

    const RegionShared& shared_;
    Targets& targets_;
    std::optional<TargetStorage> extra_stencil_;
    std::unique_ptr<TileCache> cache_;         // for profiles with BlendStorage::cached_tiles
    DepthOutcome depth_ = DepthOutcome::open;  // for the current pass
    PassKind kind_ = PassKind::geometry;
    int samples_ = 1;
    MaterialNeeds shaded_;
    std::uint64_t tallied_ = 0;
    std::vector<bool> has_saturated_;  // elements whose stencil has reached its limit; empty until one does
};

}  // namespace strata::pipeline
