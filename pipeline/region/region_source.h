// pipeline/region/region_source.h - provides the fragments of a geometry pass: from the rasterizer, from the tile's
// record, from the selected part of the record, or as rows that are written directly to the targets.
//
// Rule     Literal execution rasterizes in every pass; all other paths are tested against it.
// Source   pipeline/reference/execution.md 5 and 7.
// Tests    execution_test.cpp and selection_test.cpp of tests/peeling, tests/pipeline/region/needs_of_tiles_test.cpp
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "pipeline/frame/pass.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/walk/batch_sink.h"
#include "rasterizer/walk/depth_drawn.h"

namespace strata::rasterizer {
class TileRasterizer;
}

namespace strata::pipeline {

class Stages;
class Targets;
struct RegionShared;
enum class JoinedColors : std::uint8_t;
struct KeyIntervals;
struct PixelBatch;
class PixelFragments;

class FragmentSource {
  public:
    FragmentSource(const RegionShared& shared, Targets& targets, Stages& stages);
    FragmentSource(const FragmentSource&) = delete;
    FragmentSource& operator=(const FragmentSource&) = delete;
    ~FragmentSource();

    // All fragments of a pass, from the record if possible.
    void for_each_batch(const PreparedDraw& list, const PassState& state, rasterizer::BatchSink sink);
    // The fragments of a part of the region, joined from those of all samples.
    void for_each_pixel_batch(const PreparedDraw& list, const PassState& state, const rasterizer::Rect& part,
                              JoinedColors colors, const std::function<void(PixelBatch&)>& sink);
    [[nodiscard]] bool reads_record() const noexcept { return from_ == From::record; }

    // Finds the fragments that a selection keeps, if possible; next_visit returns them batch by batch, null after the
    // last.
    [[nodiscard]] bool find_fragments(const PassState& state, const PreparedDraw& list);
    [[nodiscard]] FragmentBatch* next_visit(const PassState& state);
    [[nodiscard]] std::size_t wave() const noexcept { return wave_; }  // the wave of that batch
    [[nodiscard]] std::uint64_t recorded() const noexcept;             // number of fragments in the record
    // For waves in submission order: called before the first wave, and after the last.
    void route_submitted(const PassState& state);
    void finish_submitted(const PassState& state);

    // For passes that rows can draw: the first function of each pair tests whether the pass is suitable, the second
    // draws the pass and returns the counts.
    [[nodiscard]] bool depth_suits_rows(const PassState& state);
    [[nodiscard]] rasterizer::DepthDrawn draw_depth_rows(const PassState& state);
    [[nodiscard]] bool sums_suit_rows(const PassState& state);
    [[nodiscard]] rasterizer::DepthDrawn draw_sum_rows(const PassState& state);

    // Records the transparent list with the values that `needs` names, sorted by the frame's key. Returns false if that
    // cannot be recorded or sorted.
    [[nodiscard]] bool record_sorted(const rasterizer::FragmentNeeds& needs);
    // Indices of a sample's triangles that may touch the region, in submission order; needs_of_tile: the needs of the
    // materials of all samples' triangles.
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(const PreparedDraw& list,
                                                              std::size_t sample) const noexcept;
    [[nodiscard]] const MaterialNeeds& needs_of_tile(const PreparedDraw& list);
    [[nodiscard]] rasterizer::TileRasterizer& rasterizer() noexcept { return *rasterizer_; }

  private:
    enum class From : std::uint8_t { rasterizer, recording, record };

    void rasterize(const PreparedDraw& list, rasterizer::FragmentNeeds needs,
                   std::span<const PrimitiveRange> primitives, rasterizer::BatchSink sink);
    void rasterize_sample(const PreparedDraw& list, std::size_t sample, const rasterizer::FragmentNeeds& needs,
                          std::span<const PrimitiveRange> primitives, rasterizer::BatchSink sink);
    void require_range(const FragmentBatch& batch) const;
    [[nodiscard]] bool may_record(const PreparedDraw& list) const;
    [[nodiscard]] bool record(const PreparedDraw& list, const rasterizer::FragmentNeeds& needs);
    void visit_all(const rasterizer::FragmentNeeds& needs, rasterizer::BatchSink sink);
    void note_rasterized(const PassState& state, const rasterizer::FragmentNeeds& needs);
    [[nodiscard]] DepthOutcome depth_outcome(const PassState& state, const PreparedDraw& list) const;
    [[nodiscard]] bool sort_for(const PassState& state);
    [[nodiscard]] bool find_kept(const PassState& state);
    [[nodiscard]] KeyIntervals intervals_of(const FragmentSelection& selection) const;
    void find_positions(FragmentBatch& batch) const;
    [[nodiscard]] bool waits_in_order(const PassState& state) const;
    void find_submitted(const PassState& state);
    [[nodiscard]] bool may_walk_rows(const PreparedDraw& list) const;
    [[nodiscard]] bool draws_rows(const PassState& state, const PreparedDraw& list);

    const RegionShared& shared_;
    Targets& targets_;
    Stages& stages_;
    std::unique_ptr<rasterizer::TileRasterizer> rasterizer_;
    std::unique_ptr<PixelFragments> joined_;                         // once a pass has needed it
    std::optional<MaterialNeeds> transparent_needs_, opaque_needs_;  // of the tile's triangles, computed on demand
    From from_ = From::rasterizer;
    std::size_t wave_ = 0;
};

}  // namespace strata::pipeline
