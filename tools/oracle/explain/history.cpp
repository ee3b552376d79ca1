// tools/oracle/explain/history.cpp - watches every stage of a run at chosen pixels and records which fragment each
// pass drew, killed or took (history.h).
#include "tools/oracle/explain/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "peeling/as_shown.h"
#include "peeling/programs/programs.h"
#include "pipeline/device/sample_points.h"
#include "pipeline/region/region.h"
#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"
#include "tools/oracle/explain/fragment_facts.h"

namespace strata::oracle {

using pipeline::Region;
using pipeline::Stage;
using pipeline::StageEvent;
using pipeline::Step;
using pipeline::StepEvent;

std::string_view name(Fate fate) noexcept { return enum_name(fate); }

std::string_view name(LineKind kind) noexcept { return enum_name(kind); }

using peeling::FrameRequest;

namespace {

bool holds(pipeline::CompareFunc func, std::uint32_t own, std::uint32_t stored) noexcept {
    switch (func) {
        case pipeline::CompareFunc::never: return false;
        case pipeline::CompareFunc::less: return own < stored;
        case pipeline::CompareFunc::equal: return own == stored;
        case pipeline::CompareFunc::lequal: return own <= stored;
        case pipeline::CompareFunc::greater: return own > stored;
        case pipeline::CompareFunc::notequal: return own != stored;
        case pipeline::CompareFunc::gequal: return own >= stored;
        case pipeline::CompareFunc::always: break;
    }
    return true;
}

// An element's codes of all samples of the target's own.
std::vector<std::uint32_t> codes_of(const Region& region, pipeline::Target target, std::uint32_t element) {
    const pipeline::TargetStorage& storage = region.storage(target);
    std::vector<std::uint32_t> codes;
    for (int sample = 0; sample < storage.samples(); ++sample)
        for (int c = 0; c < pipeline::info(storage.format()).channels; ++c)
            codes.push_back(storage.code(element, c, sample));
    return codes;
}

// Records what happens at one sample of pixels.
class Recorder {
  public:
    Recorder(const rasterizer::Rect& pixels, const peeling::RenderOptions& options, int sample, pipeline::DepthKey key,
             std::vector<History>& histories)
        : pixels_{pixels},
          width_{options.width},
          first_{sample * options.width * options.height},
          key_{key},
          histories_{histories},
          open_(histories.size()) {}

    void name(pipeline::Target target, std::string_view name) { names_.add(target, name); }

    void stage(const Region& region, const StageEvent& e) {
        if (!e.is_counted && !e.is_geometry) return;
        for (std::size_t i = 0; i < static_cast<std::size_t>(e.batch.count); ++i) {
            const int slot = slot_of(e.batch.pixel[i]);
            if (slot < 0) continue;
            const bool begins = e.stage == (e.is_geometry ? Stage::shaded : Stage::program);
            if (begins) begin(region, e, i, static_cast<std::size_t>(slot));
            follow(e, i, static_cast<std::size_t>(slot));
        }
    }

    void step(const Region& region, const StepEvent& e) {
        if (!e.is_counted) {  // the opaque list: its fragments are recorded, its clears are not
            for (std::size_t slot = 0; slot < open_.size(); ++slot) close(region, slot);
            return;
        }
        for (std::size_t slot = 0; slot < open_.size(); ++slot) {
            close(region, slot);
            Line line{.pass = pass_, .iteration = e.iteration};
            switch (e.step) {
                case Step::clear:
                case Step::copy:
                    line.kind = e.step == Step::clear ? LineKind::clear : LineKind::copy;
                    if (e.step == Step::copy) line.from = names_.of(e.from);
                    line.held.push_back(held(region, e.to, element_of(slot)));
                    line.held[0].after = line.held[0].before;
                    break;
                case Step::query:
                    line.kind = LineKind::query;
                    line.pass = pass_ - 1;
                    line.count = e.passed;
                    line.goes_on = e.answer;
                    break;
                case Step::publish:
                    line.kind = LineKind::published;
                    line.held.push_back(held(region, e.to, element_of(slot)));
                    break;
                case Step::geometry:
                case Step::full_screen: number_iteration(histories_[slot].lines, e.iteration); continue;
            }
            histories_[slot].lines.push_back(std::move(line));
        }
        if (e.step == Step::geometry || e.step == Step::full_screen || e.step == Step::publish) ++pass_;
    }

    // A stage event has no iteration number; the end of the pass has it.
    void number_iteration(std::vector<Line>& lines, int iteration) const {
        for (auto line = lines.rbegin(); line != lines.rend() && line->pass == pass_; ++line)
            line->iteration = iteration;
    }

    // A trace entry recorded after its pass belongs to that pass.
    void traced(const pipeline::TraceEntry& entry) {
        const int slot = slot_of(entry.pixel);
        if (slot < 0) return;
        History& history = histories_[static_cast<std::size_t>(slot)];
        const bool is_in_pass = open_[static_cast<std::size_t>(slot)].has_value();
        Line line{.kind = LineKind::taken, .pass = is_in_pass ? pass_ : pass_ - 1, .side = entry.side};
        for (std::size_t f = 0; f < history.fragments.size(); ++f) {
            const FragmentFact& fact = history.fragments[f];
            const std::uint32_t key =
                key_ == pipeline::DepthKey::shader_z ? peeling::ordered_code(fact.shader_z) : fact.code;
            if (!fact.is_masked && (entry.is_fragment ? fact.primitive == entry.primitive : key == entry.key))
                line.fragments.push_back(static_cast<int>(f));
        }
        (is_in_pass ? open_[static_cast<std::size_t>(slot)]->taken : history.lines).push_back(std::move(line));
    }

  private:
    [[nodiscard]] int slot_of(std::uint32_t element) const {
        const int pixel = static_cast<int>(element) - first_;
        if (pixel < 0) return -1;
        const int x = pixel % width_, y = pixel / width_;
        if (x < pixels_.x0 || x >= pixels_.x1 || y < pixels_.y0 || y >= pixels_.y1) return -1;
        return (y - pixels_.y0) * pixels_.width() + x - pixels_.x0;
    }
    [[nodiscard]] std::uint32_t element_of(std::size_t slot) const {
        return static_cast<std::uint32_t>(first_ + histories_[slot].y * width_ + histories_[slot].x);
    }

    [[nodiscard]] TargetValues held(const Region& region, pipeline::Target target, std::uint32_t element) const {
        return {names_.of(target), region.storage(target).format(), codes_of(region, target, element), {}};
    }

    // Starts the line of a fragment or of a quad's pixel, with the current values of its targets.
    void begin(const Region& region, const StageEvent& e, std::size_t i, std::size_t slot) {
        close(region, slot);
        Line line{.kind = !e.is_counted   ? LineKind::opaque
                          : e.is_geometry ? LineKind::fragment
                                          : LineKind::quad,
                  .pass = e.is_counted ? pass_ : -1};
        line.state = e.state;
        line.state.primitives = {};
        std::vector<pipeline::Target> written;
        const std::uint32_t element = element_of(slot);
        for (const pipeline::Target target : e.state.color)
            if (target.exists()) written.push_back(target);
        if (e.state.depth.enabled) {
            line.depth_target = names_.of(e.state.depth_target);
            written.push_back(e.state.depth_target);
        }
        if (e.state.stencil.enabled) {
            line.stencil_target = names_.of(e.state.stencil_target);
            written.push_back(e.state.stencil_target);
        }
        for (const pipeline::Target target : written) line.held.push_back(held(region, target, element));
        for (const pipeline::Target target : e.state.reads)
            if (target.exists()) line.reads.push_back(held(region, target, element));
        for (int unit = 0; unit < e.state.depth_unit_count; ++unit)
            line.reads.push_back(held(region, e.state.depth_units[static_cast<std::size_t>(unit)].depth, element));
        if (e.is_geometry)
            line.fragment = fragment(e, i, e.is_counted ? histories_[slot].fragments : histories_[slot].opaque);
        open_[slot] = Open{std::move(written), std::move(line)};
    }

    // The index of the fragment among the pixel's; a new one is added.
    [[nodiscard]] static int fragment(const StageEvent& e, std::size_t i, std::vector<FragmentFact>& all) {
        const auto found = std::ranges::find(all, e.batch.primitive[i], &FragmentFact::primitive);
        if (found != all.end()) return static_cast<int>(found - all.begin());
        FragmentFact fact{.primitive = e.batch.primitive[i]};
        for (std::size_t c = 0; c < 4; ++c) fact.color[c] = e.batch.color[c][i];
        fact.shader_z = e.batch.shader_z[i];
        fact.code = e.batch.code[i];
        fact.front_facing = e.batch.front_facing[i] != 0;
        fact.is_masked = e.out.alive[i] == 0;
        all.push_back(std::move(fact));
        return static_cast<int>(all.size()) - 1;
    }

    // Records what this stage did to the lane.
    void follow(const StageEvent& e, std::size_t i, std::size_t slot) {
        Open& open = *open_[slot];
        Line& line = open.line;
        const bool is_alive = e.alive[i] != 0;
        switch (e.stage) {
            case Stage::shaded: kill(open, is_alive, Fate::masked); break;
            case Stage::program:
                line.depth_code = e.batch.code[i];
                if (e.is_geometry && e.state.needs.reference) line.reference_code = e.batch.reference_code[i];
                for (std::size_t k = 0; k < e.state.color.size(); ++k) {
                    if (!e.state.color[k].exists()) continue;
                    ProgramOutput output{.target = names_.of(e.state.color[k]), .blend = e.state.blend[k]};
                    for (std::size_t c = 0; c < 4; ++c) output.color[c] = e.out.color[k][c][i];
                    line.outputs.push_back(std::move(output));
                }
                kill(open, is_alive, Fate::discarded);
                break;
            case Stage::alpha_test: kill(open, is_alive, Fate::alpha_killed); break;
            case Stage::depth_units:
                if (!is_alive && !open.is_dead && e.state.depth_unit_count > 0)
                    open.sample_fate = Fate::depth_unit_killed;
                break;
            case Stage::tests:
                if (is_alive) open.has_passed = true;
                if (!is_alive && !open.is_dead && open.sample_fate == Fate::passed)
                    open.sample_fate = tested(e, i, line);
                break;
            case Stage::written: break;
        }
    }

    // By the stencil test, or after it by the depth test.
    [[nodiscard]] static Fate tested(const StageEvent& e, std::size_t i, const Line& line) {
        if (!e.state.stencil.enabled) return Fate::depth_killed;
        const pipeline::StencilTest& test = e.state.stencil;
        const pipeline::StencilFace& face = test.two_sided && e.batch.front_facing[i] == 0 ? test.back : test.front;
        const std::uint32_t stored = line.held.back().before[static_cast<std::size_t>(e.sample)];
        return holds(face.func, face.ref & face.func_mask, stored & face.func_mask) ? Fate::depth_killed
                                                                                    : Fate::stencil_killed;
    }

    struct Open {
        std::vector<pipeline::Target> written;
        Line line;
        std::vector<Line> taken{};  // collected during the pass
        bool is_dead = false;       // before samples are considered separately
        bool has_passed = false;    // in some sample
        Fate sample_fate = Fate::passed;
    };

    static void kill(Open& open, bool is_alive, Fate fate) {
        if (is_alive || open.is_dead) return;
        open.is_dead = true;
        open.line.fate = fate;
    }

    // Called when the fragment has left its pass: no other fragment has changed its targets since.
    void close(const Region& region, std::size_t slot) {
        if (!open_[slot]) return;
        Open& open = *open_[slot];
        if (!open.is_dead && !open.has_passed) open.line.fate = open.sample_fate;
        for (std::size_t t = 0; t < open.written.size(); ++t)
            open.line.held[t].after = codes_of(region, open.written[t], element_of(slot));
        auto& lines = histories_[slot].lines;
        lines.push_back(std::move(open.line));
        std::ranges::move(open.taken, std::back_inserter(lines));
        open_[slot].reset();
    }

    rasterizer::Rect pixels_;
    int width_;
    int first_;  // the sample's first element
    pipeline::DepthKey key_;
    std::vector<History>& histories_;
    std::vector<std::optional<Open>> open_;
    TargetNames names_;
    int pass_ = 0;
};

std::vector<History> empty_histories(const FrameRequest& input, const peeling::Algorithm& algorithm,
                                     const rasterizer::Rect& pixels) {
    std::vector<History> histories;
    for (int y = pixels.y0; y < pixels.y1; ++y)
        for (int x = pixels.x0; x < pixels.x1; ++x)
            histories.push_back({.x = x, .y = y, .algorithm = algorithm.name, .profile = input.profile.name});
    return histories;
}

void check_pixels(const rasterizer::Rect& pixels, int width, int height) {
    if (pixels.x0 < 0 || pixels.y0 < 0 || pixels.x1 > width || pixels.y1 > height || pixels.x0 >= pixels.x1 ||
        pixels.y0 >= pixels.y1)
        throw InputError("explain", "pixel", fmt::format("a pixel from 0,0 to {},{}", width - 1, height - 1),
                         fmt::format("{},{}", pixels.x0, pixels.y0));
}

// What is recorded of one sample.
struct Recording {
    Recording(const FrameRequest& input, const peeling::Algorithm& algorithm, const rasterizer::Rect& in_memory,
              int sample = 0)
        : histories{empty_histories(input, algorithm, in_memory)},
          recorder{in_memory, input.options, sample, algorithm.key, histories} {}
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    // `input` is that of a frame of the sample alone.
    [[nodiscard]] std::vector<History> finish(const FrameRequest& input, const peeling::Algorithm& algorithm,
                                              const rasterizer::Rect& in_memory) && {
        for (History& history : histories) {
            history.depth_format = format;
            history.is_reversed = input.options.raster.depth_order == rasterizer::DepthOrder::greater;
        }
        add_facts(input, algorithm, in_memory, histories);
        const peeling::AsShown shown{input.options, input.profile};
        for (History& history : histories) history.y = shown.row(history.y);
        std::ranges::stable_sort(histories, {}, &History::y);
        return std::move(histories);
    }

    std::vector<History> histories;
    Recorder recorder;
    pipeline::DepthFormat format{};
};

using Recordings = std::vector<std::unique_ptr<Recording>>;

// Runs the algorithm with every effect, and returns the published picture.
pipeline::Image record(const FrameRequest& input, const peeling::Algorithm& algorithm, const Recordings& recordings) {
    const auto each = [&recordings](const auto& tell) {
        for (const auto& recording : recordings) tell(*recording);
    };
    const pipeline::Observer observer{
        .named = [&](pipeline::Target target,
                     std::string_view name) { each([&](Recording& r) { r.recorder.name(target, name); }); },
        .step =
            [&](const Region& region, const StepEvent& event) {
                each([&](Recording& r) {
                    r.format = region.frame().depth.format;
                    r.recorder.step(region, event);
                });
            },
        .stage = [&](const Region& region,
                     const StageEvent& event) { each([&](Recording& r) { r.recorder.stage(region, event); }); },
        .traced = [&](const Region&,
                      const pipeline::TraceEntry& entry) { each([&](Recording& r) { r.recorder.traced(entry); }); }};
    FrameRequest everything = input;
    everything.options.effects = pipeline::Effects::all;
    return observe(everything, algorithm, observer);
}

}  // namespace

std::vector<History> explain(const FrameRequest& input, const peeling::Algorithm& algorithm,
                             const rasterizer::Rect& pixels) {
    check_pixels(pixels, input.options.width, input.options.height);
    const rasterizer::Rect in_memory = peeling::AsShown{input.options, input.profile}.rect(pixels);
    Recordings recordings;
    recordings.push_back(std::make_unique<Recording>(input, algorithm, in_memory));
    static_cast<void>(record(input, algorithm, recordings));
    return std::move(*recordings[0]).finish(input, algorithm, in_memory);
}

SampledHistory explain_samples(const FrameRequest& input, const peeling::Algorithm& algorithm, int x, int y) {
    const rasterizer::Rect pixel{x, y, x + 1, y + 1};
    check_pixels(pixel, input.options.width, input.options.height);
    const rasterizer::Rect in_memory = peeling::AsShown{input.options, input.profile}.rect(pixel);
    Recordings recordings;
    for (int sample = 0; sample < input.options.sampling.samples; ++sample)
        recordings.push_back(std::make_unique<Recording>(input, algorithm, in_memory, sample));
    const pipeline::Image picture = record(input, algorithm, recordings);
    SampledHistory result{.sampling = input.options.sampling, .format = picture.format};
    for (std::size_t sample = 0; sample < recordings.size(); ++sample) {
        FrameRequest single = input;
        single.options.sampling = {};
        if (recordings.size() > 1)
            pipeline::set_sample(single.options.raster, input.profile.sample_positions, input.options.sampling.samples,
                                 sample);
        result.points.push_back(single.options.raster.sample.value_or(rasterizer::SamplePoint{}));
        result.samples.push_back(std::move(*recordings[sample]).finish(single, algorithm, in_memory).at(0));
        if (recordings.size() > 1) result.samples.back().sample = static_cast<int>(sample);
    }
    for (int c = 0; c < picture.channels(); ++c) result.resolved.push_back(picture.codes[picture.index(x, y, c)]);
    return result;
}

std::vector<std::vector<int>> composited(const History& history) {
    std::vector<std::vector<int>> front, back;
    for (const Line& line : history.lines) {
        if (line.kind != LineKind::taken) continue;
        (line.side == pipeline::Side::back ? back : front).push_back(line.fragments);
    }
    front.insert(front.end(), back.rbegin(), back.rend());
    return front;
}

}  // namespace strata::oracle
