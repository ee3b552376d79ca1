// pipeline/region/region.h - a rectangle of the frame with render targets of its own: what peeling algorithms are written against.
//
// Rule     An algorithm is one function over a region. Literal execution gives it the frame, tiled execution one tile after
//          another; bits, pass counts and query results are the same. `any` is the only road from a query to a branch.
// Source   execution.md 1 and 4.
// Tests    tests/pipeline/region/region_test.cpp, tests/peeling/execution_test.cpp
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/frame/counters.h"
#include "pipeline/frame/diagnostics.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/pass.h"
#include "pipeline/region/target_storage.h"
#include "pipeline/region/trace.h"
#include "pipeline/textures/depth_texels.h"
#include "rasterizer/walk/rows.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::pipeline {

class Arena;
class FragmentStore;

struct CapturedFragment {
    std::uint32_t pixel = 0, primitive = 0;
    std::uint32_t code = 0, exact_code = 0;
    float shader_z = 0;
    Rgba color{};
};

// What one iteration (or what stands before the first and after the last) did in one region.
struct IterationRecord {
    Counters counters;
    PassCount passes;
};

struct Decision {
    std::uint64_t own = 0;
    Idle idle = Idle::no;
    bool answer = false;
};

struct KeptLayer {
    Image color, depth;  // of the region's rectangle
};

// The targets of a full-screen pass as they are stored: for kernels that leave by themselves what the pass would leave.
struct ScreenWords {
    std::array<Texels, max_reads> reads;  // as PassState::reads; sample 0
    Texels color;                         // target 0
    std::size_t pixels = 0;
};

// What a walk over a region's fragments row by row needs (rasterizer/walk/row_walk-inl.h).
struct RowSource {
    const rasterizer::Geometry& geometry;
    std::span<const std::uint32_t> triangles;
    rasterizer::DepthRequest depth;
};

enum class Extent : std::uint8_t { frame, tile };
// Which vertices a geometry pass draws: Frame::transparent, or Frame::second, the same triangles come by another way.
enum class List : std::uint8_t { first, second };
enum class Bookkeeping : std::uint8_t { counted, silent };  // a pass of the algorithm, or a look of the emulator's own

class Region {
  public:
    class ScratchPool;

    // `script`: the frame's answers that are known already; further ones are guessed from the region's own counts. `pool`: where
    // the region borrows its arrays; without one it brings its own.
    Region(const Frame& frame, rasterizer::Rect rect, std::size_t tile, Extent extent, std::vector<bool> script = {},
           ScratchPool* pool = nullptr);
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
    // The same over a list that is not the frame's; whoever draws one needs a frame that is one region (surface.h).
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
    // A screen-aligned quad: every pixel of the region once.
    template <FragmentProgram P>
    Drawn full_screen(const PassState& state, P&& program);

    // The same without a program, for targets of these formats: counts a pass that reads and writes every pixel and hands out its
    // words. Nothing, and nothing counted, where a kernel must not stand in for the pass.
    [[nodiscard]] std::optional<ScreenWords> full_screen_words(const PassState& state, std::span<const Format> reads,
                                                               Format color);

    // Adds to the trace what `program` marks for every pixel, with `read` as its only load. For the audit: not a pass.
    template <FragmentProgram P>
    void trace_pixels(Target read, P&& program);

    // The frame's answer to "is the count above the limit that --termination sets?".
    // A promise belongs to the query that ends the loop, the last act of its iteration: a region that keeps it may stop there.
    // A query for a branch within the iteration asks with Idle::no.
    [[nodiscard]] bool any(Count count, Idle idle);
    void begin_iteration();
    // Work after the last iteration that each iteration causes (the compositing of its layer) is counted with it: from now on
    // counters go to the record of iteration `iteration`, from 1.
    void count_with(int iteration) { counted_record_ = static_cast<std::size_t>(iteration); }
    // True once --max-passes or fixed:N leave fewer than `passes` geometry passes; the same in every region.
    [[nodiscard]] bool limit_reached(int passes = 1);
    void keep_layer(Target color, Target depth);
    // `pixels` of this region, the first of them at region index `first_pixel`.
    void report(Fault fault, std::uint64_t pixels, std::uint32_t first_pixel, std::string detail);

    // What an algorithm leaves: its final colour.
    void publish(Target color) { published_ = color; }

    // Every fragment of the transparent list in submission order, after MASK, before any test.
    [[nodiscard]] std::vector<CapturedFragment> capture(Bookkeeping bookkeeping);
    // Depth of the nearest visible key: the frame's Z. The emulator's own look, never counted.
    [[nodiscard]] Target nearest_depth();

    // For closed forms (peeling/closed/closed_form.h): a way to the same bits that is not the machine's, in the machine's own books.
    // `coverage[i]` += how many fragments pixel i of the region gets, before MASK.
    void count_coverage(std::span<std::uint32_t> coverage);
    // program(batch, outputs) for the list's fragments in `band`, a part of this region, after MASK; `pixel` counts row by row
    // from the band's first. Not a pass. Once the program answers false it sees no more, and so does the caller.
    template <class P>
    [[nodiscard]] bool look(const rasterizer::FragmentNeeds& needs, const rasterizer::Rect& band, P&& program);
    // The same fragments without batches, where rows have their depths and colours; whoever walks them says how many they were.
    [[nodiscard]] std::optional<RowSource> row_source() const;
    void looked_at(std::uint64_t fragments) noexcept { fragments_drawn_ += fragments; }
    [[nodiscard]] static std::uint64_t alive_count(const Outputs& out, int count) noexcept;
    [[nodiscard]] bool opaque_depth_is_cleared() const noexcept { return opaque_depth_is_cleared_; }
    [[nodiscard]] Arena& arena() noexcept;                          // free again when the region is gone
    void count(const Counters& counters, const PassCount& passes);  // what a pass would have counted
    [[nodiscard]] static Count counted(std::uint64_t own) noexcept { return Count{own}; }
    void store_pixels(Target target, std::uint32_t first, int pixels, const ColorCodes& codes);
    // An rgba8 target's codes: a word a pixel, red lowest, and spare_words behind the last.
    [[nodiscard]] Word* words(Target target) { return at(target).depth_plane(0).words; }
    void trace(const TraceEntry& entry) { trace_->push_back(entry); }

    // For algorithms without a machine behind them (a_buffer): writes a pixel's colour, converted like a write without blending.
    [[nodiscard]] Rgba color(Target target, std::uint32_t pixel, int sample = 0) const;  // as a program would load it
    void store_pixel(Target target, std::uint32_t pixel, const Rgba& color);
    [[nodiscard]] const TargetStorage& storage(Target target) const {
        return storages_[static_cast<std::size_t>(target.id)];
    }
    [[nodiscard]] Image image(Target target) const;
    void write_image(Target target, Image& frame) const;  // into this region's place in an image of the frame

    // For the executor.
    [[nodiscard]] const std::vector<Decision>& decisions() const noexcept { return decisions_; }
    [[nodiscard]] const std::vector<IterationRecord>& records() const noexcept { return records_; }
    [[nodiscard]] int idle_from() const noexcept { return idle_from_; }
    [[nodiscard]] int iterations() const noexcept { return iterations_; }
    [[nodiscard]] bool probed() const noexcept { return probed_; }  // the last iteration was an idle probe
    [[nodiscard]] std::vector<KeptLayer>& layers() noexcept { return layers_; }
    [[nodiscard]] std::size_t idle_layers() const noexcept {
        return idle_layers_;
    }  // the last ones, kept while idle: empty
    [[nodiscard]] Trace& trace() noexcept { return *trace_; }
    [[nodiscard]] std::vector<Diagnostic>& diagnostics() noexcept { return diagnostics_; }
    [[nodiscard]] Target published() const noexcept { return published_; }
    [[nodiscard]] std::uint64_t fragments_drawn() const noexcept { return fragments_drawn_; }

  private:
    struct Scratch;  // the arrays that a batch passes through

    enum class PassKind : std::uint8_t { geometry, full_screen };

    template <FragmentProgram P>
    Drawn draw_list(const PassState& state, const PreparedDraw& list, P& program);
    template <class P>
    void run_program(P& program, FragmentBatch& batch, Outputs& out);

    void begin_pass(const PassState& state, PassKind kind);
    void for_each_batch(const PreparedDraw& list, const PassState& state, rasterizer::BatchSink sink);
    void rasterize(const PreparedDraw& list, rasterizer::FragmentNeeds needs,
                   std::span<const PrimitiveRange> primitives, rasterizer::BatchSink sink);
    void rasterize_band(rasterizer::FragmentNeeds needs, const rasterizer::Rect& band, rasterizer::BatchSink sink,
                        const bool& goes_on);
    void replay(rasterizer::BatchSink sink);
    [[nodiscard]] FragmentStore& store() noexcept;
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(const PreparedDraw& list) const noexcept;
    [[nodiscard]] bool may_walk_rows(const PreparedDraw& list) const;
    [[nodiscard]] bool draws_rows(const PassState& state, const PreparedDraw& list) const;
    [[nodiscard]] bool sums_suit_rows(const PassState& state) const;
    Drawn draw_sum_rows(const PassState& state);
    void count_rows(const PassState& state, const rasterizer::DepthDrawn& drawn);
    [[nodiscard]] DepthOutcome depth_outcome(const PassState& state, const PreparedDraw& list) const;
    void shade_or_recall(const PreparedDraw& list, FragmentBatch& batch, Outputs& out);
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
    void test_depth_units(const PassState& state, const FragmentBatch& batch, Lanes<std::uint32_t>& alive);
    void idle_alpha_test(const PassState& state, const FragmentBatch& batch, Outputs& out);
    void idle_tests(const PassState& state, const FragmentBatch& batch, Lanes<std::uint32_t>& alive);
    void idle_blend(const Blend& blending, const FragmentBatch& batch, const ColorLanes& color,
                    const TargetStorage& target, int sample);
    void record_trace(const FragmentBatch& batch, const Outputs& out, const Lanes<std::uint32_t>& alive);
    void count_color_bytes(const Blend& blending, const TargetStorage& target, std::uint64_t pixels);
    void report_saturation(const FragmentBatch& batch);
    void write_colors(const PassState& state, const FragmentBatch& batch, const Outputs& out, int sample,
                      const Lanes<std::uint32_t>& alive, std::uint64_t passed);
    void draw_opaque();
    void copy_row(const TargetStorage& source, const rasterizer::Rect& written, int y, int dx, int dy,
                  TargetStorage& texture);
    void read_row(const TargetStorage& from, int y, std::uint32_t* out) const;
    bool stop_iterating();
    void join_tail();

    [[nodiscard]] bool is_one_sample(Target t) const { return t.exists() && storage(t).samples() == 1; }
    [[nodiscard]] TargetStorage& at(Target t) { return storages_[static_cast<std::size_t>(t.id)]; }
    [[nodiscard]] const Loads& loads() const noexcept;
    [[nodiscard]] FragmentBatch& screen_batch() noexcept;
    bool next_screen_batch(FragmentBatch& batch, std::size_t& next) const;
    [[nodiscard]] IterationRecord& record() noexcept { return counts_ ? records_[counted_record_] : uncounted_; }

    const Frame& frame_;
    rasterizer::Rect rect_;
    std::size_t tile_;
    Extent extent_;
    std::vector<bool> script_;
    rasterizer::TileRasterizer rasterizer_;
    ScratchPool* pool_;
    std::unique_ptr<Scratch> scratch_;
    std::vector<TargetStorage> storages_;
    Target opaque_depth_, opaque_color_, published_;

    std::optional<MaterialNeeds> transparent_needs_, opaque_needs_;  // of the tile's triangles, once asked for
    std::optional<TargetStorage> idle_stencil_;
    DepthOutcome depth_ = DepthOutcome::open;  // of the present pass
    bool opaque_depth_is_cleared_ = false;     // 1 everywhere, as before the first opaque triangle
    enum class Source : std::uint8_t {
        rasterizer,
        captured,
        store
    };  // captured: rasterized, and kept for later passes
    Source source_ = Source::rasterizer;
    PassKind kind_ = PassKind::geometry;
    int pass_samples_ = 1;
    bool samples_textures_ = false;  // somebody looks at the colours of this pass
    bool takes_shadow_ = false;      // and they are shadowed
    std::uint64_t tallied_ = 0;
    bool counts_ = true;         // false during the emulator's own work (opaque priming, capture)
    IterationRecord uncounted_;  // where that work is counted instead
    int geometry_passes_ = 0;
    int idle_from_ = -1;  // index of the record whose counters every further iteration repeats; -1: never idle
    bool probing_ = false, probed_ = false;
    int iterations_ = 0;
    std::size_t counted_record_ = 0;
    std::vector<IterationRecord> records_;  // [0] before the first iteration, then one each, at last what follows
    std::vector<Decision> decisions_;
    std::vector<KeptLayer> layers_;
    std::size_t idle_layers_ = 0;
    Trace* trace_;  // in the scratch
    std::vector<Diagnostic> diagnostics_;
    std::vector<bool> has_saturated_;  // pixels whose stencil has met its limit; empty until one does
    std::uint64_t fragments_drawn_ = 0;
};

}  // namespace strata::pipeline

#include "pipeline/region/region_draw.h"
