// pipeline/region/region.h - a rectangle of the frame with render targets of its own: what peeling algorithms are written against.
//
// Rule     An algorithm is one function over a region. Literal execution gives it the frame, replay one tile after another;
//          bits, pass counts and query results are the same. `any` is the only road from a query to a branch.
//          What the executor reads afterwards stands in RegionBooks (region_books.h); what fast ways need, in
//          RegionShortcuts (region_shortcuts.h).
// Source   execution.md 1 and 4.
// Tests    tests/pipeline/region/region_test.cpp, tests/peeling/execution_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/frame/alteration.h"
#include "pipeline/frame/captured_fragment.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/instruments.h"
#include "pipeline/frame/observer.h"
#include "pipeline/frame/pass.h"
#include "pipeline/frame/region_books.h"
#include "pipeline/frame/region_place.h"
#include "pipeline/frame/trace.h"
#include "pipeline/region/target_storage.h"
#include "pipeline/textures/depth_texels.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/walk/batch_sink.h"
#include "rasterizer/walk/depth_drawn.h"

namespace strata::rasterizer {
class TileRasterizer;
}

namespace strata::pipeline {

class RegionScratchPool;
struct RegionScratch;  // the arrays that a batch passes through
struct Windows;
class TileCache;

class Region {
  public:
    // `pool`: where the region borrows its arrays; without one it brings its own.
    Region(const Frame& frame, const RegionPlace& place, RegionBooks& books, const Instruments& instruments = {},
           RegionScratchPool* pool = nullptr);
    Region(const Region&) = delete;
    Region& operator=(const Region&) = delete;
    ~Region();

    [[nodiscard]] const Frame& frame() const noexcept { return frame_; }
    [[nodiscard]] const DeviceProfile& profile() const noexcept { return *frame_.profile; }
    [[nodiscard]] rasterizer::Rect rect() const noexcept { return rect_; }

    // Contents 0; same order in every region. Throws Refused for more samples than the profile has.
    [[nodiscard]] Target make(Format format, int samples = 1);
    [[nodiscard]] Target make_color() { return make(frame_.color_format); }
    [[nodiscard]] Target make_depth() { return make(target_format(frame_.key_request().format)); }
    // The opaque scene, drawn before the algorithm starts: depth in the form of the algorithm's key, and colour over the
    // background (without opaque geometry: depth 1, the background).
    [[nodiscard]] Target opaque_depth() const noexcept { return opaque_depth_; }
    [[nodiscard]] Target opaque_color() const noexcept { return opaque_color_; }
    // Whether its depths lie within the range, as those do that are sorted: codes beyond it have no order (depth.md 2.9).
    [[nodiscard]] bool has_ordered_surface() const;

    // What people call a target, for observers and alterations.
    void call(Target target, std::string_view name) const {
        if (const Alteration* a = instruments_.alteration; a != nullptr && a->named) a->named(target, name);
        if (const Observer* o = instruments_.observer; o != nullptr && o->named) o->named(target, name);
        if (frame_.checks_targets) names_.emplace_back(target.id, name);
    }
    // Reports colour targets that hold infinity or NaN and were not cleared to it: all of them where Frame::checks_targets, else what is
    // published. For the executor, when the body has ended.
    void report_non_finite(Target published);
    [[nodiscard]] int target_count() const noexcept { return static_cast<int>(storages_.size()); }

    // Clears fill the region: scissor and write masks belong to passes.
    void clear(Target target, const ClearValue& value, std::uint8_t sample_mask = 0xff);
    void copy(Target from, Target to);  // same format and samples: a bit copy
    // glCopyTexSubImage2D from a depth or colour buffer to a texture of the frame's size and of the same format, one sample
    // each: the rectangle `from_rect` of the frame to the same rectangle moved by (dx, dy); y down, as in memory. Throws
    // NeedsFrame where a region would have to look beyond itself.
    void copy_rectangle(Target from, const rasterizer::Rect& from_rect, Target to, int dx, int dy);
    // A depth target as texture units see it; `t` runs up where the frame's y does.
    [[nodiscard]] DepthTexels depth_texels(Target depth) const;

    // One geometry pass over the transparent list, or over the part of it that `state.primitives` names.
    template <FragmentProgram P>
    Drawn draw(const PassState& state, P&& program) {
        return draw_list(state, *frame_.transparent, program);
    }
    template <FragmentProgram P>
    Drawn draw(const PassState& state, List list, P&& program) {
        return draw_list(state, list == List::second && frame_.second != nullptr ? *frame_.second : *frame_.transparent,
                         program);
    }
    // Draws a list that is not one of the frame's. Only a frame that is a single region may: surface.h.
    template <FragmentProgram P>
    Drawn draw(const PassState& state, const PreparedDraw& list, P&& program) {
        return draw_list(state, list, program);
    }
    // One geometry pass that tests and writes depth, without a program or colours; straight into the target where it can.
    Drawn draw_depth(const PassState& state);
    // One geometry pass that adds (c a, a) of every fragment to color[0], and 1 to color[1] if it is there. `program` says the
    // same of a batch, and runs where the sums cannot go straight into the targets.
    template <FragmentProgram P>
    Drawn draw_sums(const PassState& state, P&& program) {
        return sums_suit_rows(state) ? draw_sum_rows(state) : draw(state, program);
    }
    // Runs `work`, whose passes, clears and copies are the emulator's own: nothing counts them.
    template <class Work>
    void uncounted(Work&& work) {
        const UncountedWork own{books_};
        work();
    }
    // A screen-aligned quad: every pixel of the region once.
    template <FragmentProgram P>
    Drawn full_screen(const PassState& state, P&& program);

    // Adds to the trace what `program` marks for every pixel, with `read` as its only load. For the audit: not a pass.
    template <FragmentProgram P>
    void trace_pixels(Target read, P&& program);
    // Adds one step to the trace that no pass shows.
    void trace(const TraceEntry& entry) {
        traced().push_back(entry);
        show(entry);
    }

    // The frame's answer to "is the count above the limit that --termination sets?".
    // A promise belongs to the query that ends the loop, the last act of its iteration: a region that keeps it may stop there.
    // A query for a branch within the iteration asks with Idle::no.
    [[nodiscard]] bool any(Count count, Idle idle);
    void begin_iteration();
    // A further loop begins: promises made so far concern the loops before it, and further ones it alone. Where a limit
    // counts passes across the loops, a tile that left one early learns how many the frame has made.
    void begin_loop();
    // True once --max-passes or fixed:N leave fewer than `passes` geometry passes; the same in every region.
    [[nodiscard]] bool limit_reached(int passes = 1);
    void keep_layer(Target color, Target depth, Side side = Side::front);
    // After the last one: what this region shows in layers that other regions have more than it.
    void keep_no_layer(Target color, Target depth);
    // `pixels` of this region, the first of them at region index `first_pixel`.
    void report(Fault fault, std::uint64_t pixels, std::uint32_t first_pixel, std::string detail);
    void report(Fault fault, std::string detail);  // no pixel is meant

    // Hands over the final colour, which is an algorithm's result.
    void publish(Target color) {
        books_.published = color;
        show({.step = Step::publish, .to = color});
    }

    // Every fragment of the transparent list in submission order, after MASK, before any test.
    [[nodiscard]] std::vector<CapturedFragment> capture(Bookkeeping bookkeeping);
    // The contents of a target: one colour as a program would load it, the stored codes, or all codes as an image of
    // the region.
    [[nodiscard]] Rgba color(Target target, std::uint32_t pixel, int sample = 0) const;
    [[nodiscard]] const TargetStorage& storage(Target target) const {
        return storages_[static_cast<std::size_t>(target.id)];
    }
    [[nodiscard]] Image image(Target target) const;

  private:
    friend class RegionShortcuts;

    [[nodiscard]] Trace& traced() noexcept;  // in the scratch

    // Null where the next step is to be taken as it is.
    [[nodiscard]] const Alteration* alteration() const noexcept {
        return books_.counts ? instruments_.alteration : nullptr;
    }
    [[nodiscard]] PassState altered(const PassState& state, PassKind kind);
    void tell_alteration(PassKind kind, const Drawn& drawn) const;
    template <FragmentProgram P>
    Drawn draw_list(const PassState& state, const PreparedDraw& list, P& program);
    template <FragmentProgram P>
    Drawn draw_everything(const PassState& state, const PreparedDraw& list, P& program);
    template <FragmentProgram P>
    Drawn draw_visits(const PassState& state, P& program);
    template <class Quick, class Definition>
    Drawn checked(const Quick& quick, const Definition& definition);
    template <FragmentProgram P>
    Drawn draw_screen(const PassState& state, P& program);
    template <class P>
    void run_program(const PassState& state, P& program, FragmentBatch& batch, Outputs& out);

    void begin_pass(const PassState& state, PassKind kind);
    void for_each_batch(const PreparedDraw& list, const PassState& state, rasterizer::BatchSink sink);
    void rasterize(const PreparedDraw& list, rasterizer::FragmentNeeds needs,
                   std::span<const PrimitiveRange> primitives, rasterizer::BatchSink sink);
    [[nodiscard]] bool may_record(const PreparedDraw& list) const;
    [[nodiscard]] bool record(const PreparedDraw& list, const rasterizer::FragmentNeeds& needs);
    void visit_all(const rasterizer::FragmentNeeds& needs, rasterizer::BatchSink sink);
    void note_rasterized(const PassState& state, const rasterizer::FragmentNeeds& needs);
    void require_range(const FragmentBatch& batch) const;
    // Whether depths beyond the range have codes of their own (depth.md 2.9).
    [[nodiscard]] bool wraps_depths() const noexcept {
        return profile().raster.depth_limits == rasterizer::DepthLimits::wrap;
    }
    // Around the batches of a pass whose blends binary32 holds (tile_cache.h); nothing for other profiles.
    void open_cache(const PassState& state) {
        if (profile().blend_storage != BlendStorage::target) open_tile_cache(state);
    }
    void close_cache() {
        if (cache_ != nullptr) close_tile_cache();
    }
    void open_tile_cache(const PassState& state);
    void close_tile_cache();
    // Visits of what a selection keeps: region_visits.cpp.
    [[nodiscard]] bool find_visits(const PassState& state, const PreparedDraw& list);
    [[nodiscard]] bool sort_for(const PassState& state);
    [[nodiscard]] bool find_kept(const PassState& state);
    [[nodiscard]] Windows windows_of(const FragmentSelection& selection) const;
    [[nodiscard]] FragmentBatch* next_visit(const PassState& state);  // null after the last
    void find_positions(FragmentBatch& batch) const;
    [[nodiscard]] bool waits_in_order(const PassState& state) const;
    void find_arrivals(const PassState& state);
    void route_arrivals(const PassState& state);
    void finish_arrivals(const PassState& state);
    [[nodiscard]] std::uint64_t recorded() const noexcept;  // fragments
    void count_visits(std::uint64_t fragments) noexcept {
        if (books_.counts) books_.fragments_visited += fragments;
    }
    // Null where there is no such target.
    [[nodiscard]] const std::uint32_t* codes_of(Target t) const { return t.exists() ? storage(t).depth(0) : nullptr; }
    struct Snapshot {
        std::vector<TargetStorage> targets;
        std::size_t traced;
    };
    [[nodiscard]] Snapshot snapshot();
    void restore(Snapshot& from);
    void require_equal(const Snapshot& selected, Count selected_passed, Count passed);
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(const PreparedDraw& list) const noexcept;
    [[nodiscard]] bool may_walk_rows(const PreparedDraw& list) const;
    [[nodiscard]] bool draws_rows(const PassState& state, const PreparedDraw& list);
    [[nodiscard]] bool sums_suit_rows(const PassState& state);
    Drawn draw_sum_rows(const PassState& state);
    [[nodiscard]] DepthOutcome depth_outcome(const PassState& state, const PreparedDraw& list) const;
    [[nodiscard]] Outputs& start_batch(const FragmentBatch& batch);
    void shade(const PreparedDraw& list, FragmentBatch& batch, Outputs& out);  // material stage: texture, MASK
    void load(const PassState& state, const FragmentBatch& batch);
    void load_target(TargetStorage& from, std::size_t read, const FragmentBatch& batch);
    [[nodiscard]] const MaterialNeeds& needs_of_tile(const PreparedDraw& list);
    void finish(const PassState& state, const FragmentBatch& batch, Outputs& out, Drawn& drawn);
    void finish_sample(const PassState& state, const FragmentBatch& batch, const Outputs& out, int sample,
                       Drawn& drawn);
    std::uint64_t test_depth_and_stencil(const PassState& state, const FragmentBatch& batch, int sample,
                                         Lanes<std::uint32_t>& alive);  // answers how many pass
    std::uint64_t test_stencil(const PassState& state, const FragmentBatch& batch, int sample,
                               Lanes<std::uint32_t>& alive);
    void test_depth_units(const PassState& state, const FragmentBatch& batch, int sample, Lanes<std::uint32_t>& alive);
    void idle_alpha_test(const PassState& state, const FragmentBatch& batch, Outputs& out);
    void idle_tests(const PassState& state, const FragmentBatch& batch, Lanes<std::uint32_t>& alive);
    void idle_blend(const Blend& blending, const FragmentBatch& batch, const ColorLanes& color,
                    const TargetStorage& target, int sample);
    void record_trace(const FragmentBatch& batch, const Outputs& out, const Lanes<std::uint32_t>& alive);
    void count_color_bytes(const Blend& blending, const TargetStorage& target, std::uint64_t pixels);
    void report_saturation(const FragmentBatch& batch);
    void report_saturation(std::uint32_t pixel);
    void write_colors(const PassState& state, const FragmentBatch& batch, const Outputs& out, int sample,
                      const Lanes<std::uint32_t>& alive, std::uint64_t passed);
    void draw_opaque();
    void copy_row(const TargetStorage& source, const rasterizer::Rect& written, int y, int dx, int dy,
                  TargetStorage& texture);
    void read_row(const TargetStorage& from, int y, std::uint32_t* out) const;
    // Whether to simulate an effect that changes nothing.
    [[nodiscard]] bool idles(Effect effect, bool is_called_for) const noexcept {
        return instruments_.once_more == effect || (frame_.effects == Effects::all && !is_called_for);
    }

    // To the observer, if there is one.
    void show(StepEvent event) const {
        if (instruments_.observer == nullptr || !instruments_.observer->step) return;
        event.is_counted = books_.counts;
        event.iteration = books_.iterations;
        instruments_.observer->step(*this, event);
    }
    void show(const TraceEntry& entry) const {
        if (const Observer* o = instruments_.observer; o != nullptr && o->traced) o->traced(*this, entry);
    }
    void show(Stage stage, const PassState& state, const FragmentBatch& batch, const Outputs& out,
              const Lanes<std::uint32_t>& alive, int sample = 0) const {
        if (instruments_.observer == nullptr || !instruments_.observer->stage) return;
        instruments_.observer->stage(
            *this, {stage, state, batch, out, alive, sample, kind_ == PassKind::geometry, books_.counts});
    }

    [[nodiscard]] bool is_one_sample(Target t) const { return t.exists() && storage(t).samples() == 1; }
    [[nodiscard]] TargetStorage& at(Target t) { return storages_[static_cast<std::size_t>(t.id)]; }
    [[nodiscard]] const Loads& loads() const noexcept;
    [[nodiscard]] FragmentBatch& screen_batch() noexcept;
    bool next_screen_batch(FragmentBatch& batch, std::size_t& next) const;
    [[nodiscard]] static std::uint64_t alive_count(const Outputs& out, int count) noexcept;
    // What the machine does; the emulator's own work is not counted.
    void count(const Counters& counters) noexcept {
        if (books_.counts) books_.counters += counters;
    }
    void count_pass(const PassCount& passes) noexcept {
        if (books_.counts) books_.loops.back().passes += passes;
    }

    const Frame& frame_;
    rasterizer::Rect rect_;
    std::size_t tile_;
    Extent extent_;
    RegionBooks& books_;
    Instruments instruments_;
    RegionScratchPool* pool_;
    std::unique_ptr<RegionScratch> scratch_;
    std::unique_ptr<rasterizer::TileRasterizer> rasterizer_;
    std::vector<TargetStorage> storages_;
    Target opaque_depth_, opaque_color_;

    std::optional<MaterialNeeds> transparent_needs_, opaque_needs_;  // of the tile's triangles, once asked for
    std::optional<TargetStorage> idle_stencil_;
    std::unique_ptr<TileCache> cache_;         // of profiles with BlendStorage::cached_tiles
    DepthOutcome depth_ = DepthOutcome::open;  // of the present pass
    mutable std::vector<std::pair<int, std::string>>
        names_;                             // where Frame::checks_targets: of targets by their numbers
    std::vector<int> cleared_non_finite_;   // targets that were
    bool opaque_depth_is_cleared_ = false;  // 1 everywhere, as before the first opaque triangle
    enum class Source : std::uint8_t { rasterizer, recording, record };
    Source source_ = Source::rasterizer;
    std::size_t wave_ = 0;  // of the batch that is visited
    PassKind kind_ = PassKind::geometry;
    int pass_samples_ = 1;
    bool samples_textures_ = false;  // somebody looks at the colours of this pass
    bool takes_shadow_ = false;      // and they are shadowed
    std::uint64_t tallied_ = 0;
    std::vector<bool> has_saturated_;  // pixels whose stencil has met its limit; empty until one does
};

}  // namespace strata::pipeline

#include "pipeline/region/region_draw.h"
