// pipeline/region/executor.cpp - both executions in one class: literal execution has a single region, whose own counts
// are the frame's (pipeline/reference/execution.md 4, 5 and 8).
#include "pipeline/region/executor.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "pipeline/fragments/tile_parts.h"
#include "pipeline/frame/termination.h"
#include "pipeline/region/frame_pictures.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/parallel.h"

namespace strata::pipeline {

namespace {

// What remains of a region after its storage is released.
struct RegionRun {
    RegionStatistics statistics;
    std::uint64_t fragments = 0;  // sum over all its runs
    int runs = 0;
};

class FrameRun {
  public:
    FrameRun(const Frame& frame, const Body& body, Execution execution, int threads,
             const std::function<void(double)>& progress, const Instruments& instruments,
             const RegionCallbacks& callbacks)
        : frame_{frame},
          body_{body},
          threads_{threads},
          progress_{progress},
          instruments_{instruments},
          callbacks_{callbacks},
          extent_{execution == Execution::literal ? Extent::frame : Extent::tile} {
        areas_ = extent_ == Extent::frame ? std::vector<RegionArea>{{frame.rect(), 0, Extent::frame}}
                                          : tile_parts(frame, threads);
        regions_.resize(areas_.size());
        look_alike_.assign(regions_.size(), no_look_alike);
        for (std::size_t r = 0; r < regions_.size(); ++r) weight_of_all_ += weight(r);
    }

    FrameResult finish() {
        if (callbacks_.begun) callbacks_.begun(areas_);
        const std::vector<std::size_t> others = run_one_blank_of_each_size();
        parallel_for(others.size(), threads_, [&](std::size_t i) {
            if (look_alike_[others[i]] == no_look_alike)
                run_region(others[i], {});
            else
                copy_blank(others[i]);
        });
        if (extent_ == Extent::tile && frame_.max_passes > 0 && regions_[0].statistics.loops.size() > 1) limit_loops();
        settle();
        gather();
        pictures_.finish();
        return std::move(result_);
    }

  private:
    [[nodiscard]] const rasterizer::Rect& rect(std::size_t r) const { return areas_[r].rect; }

    // True if no list has a triangle in tile `r`, and the frame promises that the body's result there does not depend
    // on the position (execution.md 6).
    [[nodiscard]] bool is_blank(std::size_t r) const {
        const auto is_empty = [&](const PreparedDraw* list) {
            return list == nullptr || list->triangles_in(areas_[r].tile) == 0;
        };
        return extent_ == Extent::tile && frame_.effects == Effects::needed && frame_.blank_tiles_are_equal &&
               is_empty(frame_.transparent) && is_empty(frame_.second) && is_empty(frame_.opaque);
    }

    // Runs one blank tile of each size: every other blank tile of that size has the same result and gets a copy later.
    // Returns the tiles that are still to be run or copied. A tile with diagnostics is not copied, because they refer
    // to its pixels.
    [[nodiscard]] std::vector<std::size_t> run_one_blank_of_each_size() {
        std::vector<std::size_t> others;
        for (std::size_t r = 0; r < regions_.size(); ++r) {
            if (!is_blank(r)) {
                others.push_back(r);
                continue;
            }
            const auto same_size = [&](std::size_t b) {
                return rect(b).width() == rect(r).width() && rect(b).height() == rect(r).height();
            };
            const auto found = std::find_if(blanks_.begin(), blanks_.end(), same_size);
            look_alike_[r] = found == blanks_.end() ? r : *found;
            if (found != blanks_.end()) {
                others.push_back(r);
                continue;
            }
            run_region(r, {});
            if (regions_[r].statistics.diagnostics.empty()) blanks_.push_back(r);
        }
        return others;
    }

    // The copy has the other tile's statistics, because the device would have worked in both tiles, but it rasterized
    // nothing itself.
    void copy_blank(std::size_t r) {
        regions_[r] = regions_[look_alike_[r]];
        regions_[r].fragments = regions_[r].statistics.fragments_processed = 0;
        pictures_.copy(rect(look_alike_[r]), rect(r));
        if (callbacks_.alike) callbacks_.alike(look_alike_[r], r);
        show(r);
    }

    // A region's share of the progress: its triangles in every list plus one.
    [[nodiscard]] std::size_t weight(std::size_t r) const {
        if (extent_ == Extent::frame) return 1;
        std::size_t triangles = 1;
        for (const PreparedDraw* list : {frame_.transparent, frame_.second, frame_.opaque})
            if (list != nullptr) triangles += list->triangles_in(areas_[r].tile);
        return triangles;
    }

    // Reports that region `r` is done. A region that runs again is counted again, but the total is limited to 1.
    void show(std::size_t r) {
        if (!progress_) return;
        const std::size_t done = weight_done_ += weight(r);
        progress_(std::min(1.0, static_cast<double>(done) / static_cast<double>(weight_of_all_)));
    }

    // Runs region `r` with the answers of `script`; further answers are guessed from its own counts (region_loop.cpp).
    // The image of the nearest depth does not depend on answers, so the first run writes its final values.
    void run_region(std::size_t r, const Answers& script) {
        const Clock::time_point start = Clock::now();
        RegionStatistics statistics;
        statistics.script = script;
        statistics.passes_before = passes_before_;
        Region region{frame_, areas_[r], statistics, instruments_, &scratch_};
        body_(region);
        region.targets().report_overflow(statistics.published);
        pictures_.write(region, statistics.published);
        RegionRun& kept = regions_[r];
        if (frame_.nearest_depth && kept.runs == 0) pictures_.write_nearest(region);
        kept.fragments += statistics.fragments_drawn;
        kept.statistics = std::move(statistics);
        ++kept.runs;
        const Clock::time_point ended = Clock::now();
        if (callbacks_.ended) callbacks_.ended(region, r, result_);
        time_in_bodies_ += (ended - start).count();
        time_in_watch_ += (Clock::now() - ended).count();
        show(r);
    }

    void run(const std::vector<std::size_t>& which, const Answers& script) {
        parallel_for(which.size(), threads_, [&](std::size_t i) { run_region(which[i], script); });
    }

    // True if a region is not affected by the frame's answer to decision d: it counted nothing there, or it had stopped
    // earlier, and promised that further iterations change nothing.
    [[nodiscard]] static bool is_idle(const LoopStatistics& loop, std::size_t d) {
        const std::size_t last = std::min(d, loop.decisions.size() - 1);
        return loop.decisions[last].own == 0 && loop.decisions[last].idle != Idle::no;
    }

    // The number of further answers known to be "yes": those of a region that had the frame's answers up to decision d,
    // and whose own counts suffice. The number is only a hint that avoids runs: every answer is settled in a round of
    // its own.
    [[nodiscard]] std::size_t certain_after(std::size_t loop, std::size_t d, bool answer) const {
        std::size_t longest = 0;
        for (const auto& [r, fragments, runs] : regions_) {
            std::size_t next = d + 1;
            const std::vector<Decision>& own = r.loops[loop].decisions;
            if (own.size() <= next || own[d].answer != answer) continue;
            while (next < own.size() && continues(frame_.termination, frame_.rect(), own[next].own, frame_.samples()))
                ++next;
            longest = std::max(longest, next - d - 1);
        }
        return longest;
    }

    // A limit counts the passes of all loops. A region that leaves a loop before the others has made fewer passes and
    // may iterate too often later. For each loop in turn this computes how many iterations the limit leaves to the
    // frame; a region with more runs again.
    void limit_loops() {
        std::vector<int> most;  // iterations of each loop
        for (std::size_t loop = 0; loop < regions_[0].statistics.loops.size(); ++loop) {
            passes_before_.push_back(loop == 0 ? 0 : passes_before_.back() + passes_of(loop - 1, most.back()));
            const int left = std::max(0, frame_.max_passes - passes_before_[loop]);
            most.push_back(left / std::max(1, passes_of(loop, 1)));
        }
        std::vector<std::size_t> again;
        for (std::size_t r = 0; r < regions_.size(); ++r) {
            const std::vector<LoopStatistics>& loops = regions_[r].statistics.loops;
            const auto goes_too_far = [&](std::size_t loop) { return loops[loop].iterations > most[loop]; };
            for (std::size_t loop = 0; loop < loops.size(); ++loop)
                if (goes_too_far(loop) && (again.empty() || again.back() != r)) again.push_back(r);
        }
        run(again, {});
        result_.work.reruns += again.size();
    }

    // The geometry passes of `iterations` iterations of a loop, or of as many as the frame has made if these are fewer.
    // Every iteration of a loop makes the same number; for a loop without iterations it is the passes before it.
    [[nodiscard]] int passes_of(std::size_t loop, int iterations) const {
        const LoopStatistics& longest = regions_[longest_in(loop)].statistics.loops[loop];
        if (longest.iterations == 0) return longest.passes.geometry;
        return std::min(iterations, longest.iterations) * (longest.passes.geometry / longest.iterations);
    }

    // A region that runs a loop as long as the frame does, because it had something to count until the end.
    [[nodiscard]] std::size_t longest_in(std::size_t loop) const {
        const auto iterations = [loop](const RegionRun& r) { return r.statistics.loops[loop].iterations; };
        return static_cast<std::size_t>(std::ranges::max_element(regions_, {}, iterations) - regions_.begin());
    }

    // Settles the frame's answers one decision after the other. The counts at a decision depend only on earlier
    // answers, so each round settles at least one; regions that guessed otherwise run again with the answers known so
    // far.
    void settle() {
        if (extent_ == Extent::frame) {
            for (const LoopStatistics& loop : regions_[0].statistics.loops) {
                result_.answers.emplace_back();
                for (const Decision& d : loop.decisions) result_.answers.back().push_back(d.answer);
            }
            return;
        }
        for (std::size_t loop = 0; loop < regions_[0].statistics.loops.size(); ++loop) settle(loop);
    }

    void settle(std::size_t loop) {
        std::vector<bool>& answers = result_.answers.emplace_back();
        for (std::size_t d = 0;; ++d) {
            std::uint64_t sum = 0;
            bool anyone = false;
            for (const auto& [r, fragments, runs] : regions_) {
                const std::vector<Decision>& own = r.loops[loop].decisions;
                if (d >= own.size()) continue;
                sum += own[d].own;
                anyone = true;
            }
            if (!anyone) return;
            answers.push_back(continues(frame_.termination, frame_.rect(), sum, frame_.samples()));
            std::vector<std::size_t> again;
            for (std::size_t r = 0; r < regions_.size(); ++r) {
                const LoopStatistics& own = regions_[r].statistics.loops[loop];
                if (own.decisions.empty() || is_idle(own, d)) continue;
                if (d >= own.decisions.size() || own.decisions[d].answer != answers[d]) again.push_back(r);
            }
            Answers script = result_.answers;
            if (!again.empty()) script.back().insert(script.back().end(), certain_after(loop, d, answers[d]), true);
            run(again, script);
            result_.work.reruns += again.size();
        }
    }

    // Assembles the frame from the statistics of all regions. Diagnostics merge in any order, so the result does not
    // depend on threads. Without queries all regions ran the same iterations.
    void gather() {
        result_.work.regions = regions_.size();
        result_.work.tile_size = extent_ == Extent::frame ? 0 : frame_.transparent->geometry.tile_size;
        for (std::size_t loop = 0; loop < regions_[0].statistics.loops.size(); ++loop) {
            const LoopStatistics& longest = regions_[longest_in(loop)].statistics.loops[loop];
            result_.iterations += longest.iterations;
            result_.passes += longest.passes;
        }
        if (extent_ == Extent::frame) result_.counters = regions_[0].statistics.counters;
        gather_path();
        for (const RegionRun& region : regions_) {
            for (const Diagnostic& d : region.statistics.diagnostics) merge(result_.diagnostics, d);
            gather_log(region.statistics.pass_log);
            result_.work.fragments += region.fragments;
            result_.work.visited += region.statistics.fragments_processed;
        }
        const auto watched = static_cast<double>(time_in_watch_), bodies = static_cast<double>(time_in_bodies_);
        result_.watched = watched > 0 ? watched / (watched + bodies) : 0;
        if (frame_.keep_layers) gather_layers();
    }

    void gather_path() {
        if (extent_ == Extent::frame) return;
        const auto path = [](const RegionRun& region) { return region.statistics.taken.path(); };
        const RegionRun& slowest = *std::ranges::min_element(regions_, {}, path);
        result_.work.path = path(slowest);
        if (const char* const why = slowest.statistics.taken.why(); why != nullptr) result_.work.why = why;
    }

    void gather_log(const PassLog& log) {
        PassLog& all = result_.pass_log;
        all.passes.insert(all.passes.end(), log.passes.begin(), log.passes.end());
        all.queries += log.queries;
    }

    // A region that stopped early uses its last layer, an empty one, for every further layer of the frame. The side of
    // a layer comes from a region that found the layer.
    void gather_layers() {
        std::size_t layer_count = 0;
        for (const auto& [r, fragments, runs] : regions_)
            layer_count = std::max(layer_count, r.layers.size() - r.idle_layers);
        const rasterizer::Rect whole = frame_.rect();
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            PeeledLayer kept;
            for (std::size_t r = 0; r < regions_.size(); ++r) {
                std::vector<PeeledLayer>& layers = regions_[r].statistics.layers;
                if (layer + regions_[r].statistics.idle_layers < layers.size()) kept.side = layers[layer].side;
                const PeeledLayer& part = layers[std::min(layer, layers.size() - 1)];
                if (kept.color.codes.empty()) {
                    kept.color = Image::for_overwrite(part.color.format, whole.width(), whole.height());
                    kept.depth = Image::for_overwrite(part.depth.format, whole.width(), whole.height());
                }
                pictures_.copy_into(part.color, rect(r), kept.color);
                pictures_.copy_into(part.depth, rect(r), kept.depth);
                if (layer + 1 < layers.size()) layers[layer] = {};  // frees memory for the next layer
            }
            result_.layers.push_back(std::move(kept));
        }
    }

    using Clock = std::chrono::steady_clock;

    const Frame& frame_;
    const Body& body_;
    int threads_;
    const std::function<void(double)>& progress_;
    Instruments instruments_;
    const RegionCallbacks& callbacks_;
    Extent extent_;
    RegionScratchPool scratch_;
    std::vector<RegionArea> areas_;
    std::vector<RegionRun> regions_;  // index as in areas_
    static constexpr std::size_t no_look_alike = ~std::size_t{0};
    std::vector<std::size_t> blanks_, look_alike_;  // blank regions that ran; per region, the one that it is a copy of
    std::vector<int> passes_before_;                // per loop; empty until a limit needs them
    FrameResult result_;
    FramePictures pictures_{frame_, result_};
    std::size_t weight_of_all_ = 0;
    std::atomic<std::size_t> weight_done_{0};
    // Sums over all threads, in clock ticks. Only their ratio is reported; no result bit depends on time.
    std::atomic<Clock::rep> time_in_bodies_{0}, time_in_watch_{0};
};

}  // namespace

FrameResult run(const Frame& frame, const Body& body, Execution execution, int threads,
                const std::function<void(double)>& progress, const Instruments& instruments,
                const RegionCallbacks& callbacks) {
    const FloatEnvironment ours;
    // A run that times one additional effect rasterizes in every pass, because recorded fragments would skip the
    // effect.
    const auto run_as = [&](const Frame& given, Execution way) {
        return FrameRun{given, body, way, threads, progress, instruments, callbacks}.finish();
    };
    Frame rasterized = frame;  // without replay: rasterizes in every pass
    rasterized.replay = {};
    const bool is_plain = execution == Execution::replay && instruments.once_more == Effect::none;
    const Frame& given = is_plain ? frame : rasterized;
    if (instruments.observer != nullptr) rasterized.trace = rasterized.trace || instruments.observer->traced;
    if (instruments.observer != nullptr || instruments.alteration != nullptr)
        return run_as(rasterized, Execution::literal);
    if (execution == Execution::literal) return run_as(given, execution);
    if (!frame.needs_frame) try {
            return run_as(given, execution);
        } catch (const NeedsFrame&) {  // a lookup left its region: run the frame again literally
        }
    return run_as(rasterized, Execution::literal);
}

}  // namespace strata::pipeline
