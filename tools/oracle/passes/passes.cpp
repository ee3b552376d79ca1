// tools/oracle/passes/passes.cpp - collects each pass of all samples in step and reports it with the content of all
// targets (passes.h).
#include "tools/oracle/passes/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "peeling/as_shown.h"
#include "peeling/sampled_renderer.h"
#include "pipeline/device/check.h"
#include "pipeline/region/region.h"
#include "rasterizer/base/enum_values.h"

namespace strata::oracle {

using pipeline::Region;
using pipeline::Step;
using pipeline::StepEvent;

std::string_view name(ReportedPassKind kind) noexcept { return enum_name(kind); }

void TargetNames::add(pipeline::Target target, std::string_view name) {
    const auto id = static_cast<std::size_t>(target.id);
    if (names_.size() <= id) names_.resize(id + 1);
    std::string wanted{name};
    for (int number = 1; std::ranges::find(names_, wanted) != names_.end(); ++number)
        wanted = fmt::format("{}.{}", name, number);
    names_[id] = std::move(wanted);
}

std::string TargetNames::of(pipeline::Target target) const {
    const auto id = static_cast<std::size_t>(target.id);
    return id < names_.size() && !names_[id].empty() ? names_[id] : fmt::format("target.{}", target.id);
}

pipeline::Image observe(const RunInput& input, const peeling::Algorithm& algorithm,
                        std::span<const pipeline::Observer> observers,
                        std::span<const pipeline::Alteration> alterations) {
    peeling::RenderOptions options = input.options;
    options.execution = pipeline::Execution::literal;
    options.audit = options.keep_layers = options.nearest_depth = false;
    std::vector<pipeline::Instruments> instruments;
    for (const pipeline::Observer& observer : observers) {
        const std::size_t sample = instruments.size();
        instruments.push_back(
            {.observer = &observer, .alteration = alterations.empty() ? nullptr : &alterations[sample]});
    }
    peeling::SampledRenderer renderer{input.list, input.view, input.profile, options, input.sampling};
    peeling::RenderResult result = renderer.render(algorithm, {}, nullptr, instruments);
    if (result.outcome == peeling::Outcome::refused) throw pipeline::Refused{input.profile, *std::move(result.refusal)};
    return std::move(result.frame.color);
}

namespace {

// Collects the passes of all samples. The samples make the same steps, and all have made a step before any makes the
// next; so what a step is, is taken from sample 0, and a pass is complete when every sample has shown its targets.
class PassCollector {
  public:
    PassCollector(const std::function<void(PassReport&&)>& on_pass, const peeling::AsShown& shown, int samples)
        : on_pass_{on_pass}, shown_{shown}, samples_{samples} {}

    void name(int sample, pipeline::Target target, std::string_view name) {
        const std::lock_guard held{mutex_};
        if (sample == 0) names_.add(target, name);
    }

    void step(int sample, const Region& region, const StepEvent& event) {
        if (!event.is_counted) return;
        const std::lock_guard held{mutex_};
        switch (event.step) {
            case Step::clear:
                if (sample == 0) next_.before.push_back("clear " + names_.of(event.to));
                break;
            case Step::copy:
                if (sample == 0)
                    next_.before.push_back(fmt::format("copy {} to {}", names_.of(event.from), names_.of(event.to)));
                break;
            case Step::query:
                if (sample == 0 && ended_) ended_->queries.push_back({event.passed, event.answer});
                break;
            case Step::geometry: add(sample, region, event, ReportedPassKind::geometry); break;
            case Step::full_screen: add(sample, region, event, ReportedPassKind::full_screen); break;
            case Step::publish:
                if (sample == 0) next_.iteration = event.iteration;
                break;
        }
    }

    void publish(pipeline::Image picture) {
        flush();
        next_.kind = ReportedPassKind::published;
        next_.number = number_;
        next_.targets.push_back({"picture", std::move(picture)});
        on_pass_(std::move(next_));
    }

  private:
    // A pass is reported when its queries are answered.
    void flush() {
        if (ended_) on_pass_(*std::exchange(ended_, std::nullopt));
    }

    // Adds one sample's part of a pass.
    void add(int sample, const Region& region, const StepEvent& event, ReportedPassKind kind) {
        if (shown_samples_ == 0) {
            flush();
            for (int id = 0; id < region.targets().count(); ++id) next_.targets.emplace_back();
        }
        next_.passed += event.passed;
        next_.tallied += event.tallied;
        for (int id = 0; id < region.targets().count(); ++id)
            add(sample, region.targets().image({id}), next_.targets[static_cast<std::size_t>(id)].image);
        if (++shown_samples_ == samples_) complete(event, kind);
    }

    // A target that already has samples, as the stencil-routed k-buffer's, is of a frame of one sample.
    void add(int sample, pipeline::Image part, pipeline::Image& whole) const {
        shown_.turn(part);
        if (samples_ == 1) {
            whole = std::move(part);
            return;
        }
        if (whole.codes.empty()) whole = pipeline::Image::for_overwrite(part.format, part.width, part.height, samples_);
        const auto channels = static_cast<std::size_t>(part.channels()), all = static_cast<std::size_t>(samples_);
        const auto first = static_cast<std::size_t>(sample) * channels;
        for (std::size_t pixel = 0, i = 0; i < part.codes.size(); ++pixel)
            for (std::size_t c = 0; c < channels; ++c, ++i)
                whole.codes[pixel * all * channels + first + c] = part.codes[i];
    }

    void add(std::vector<std::string>& to, pipeline::Target target) const {
        if (target.exists()) to.push_back(names_.of(target));
    }

    void complete(const StepEvent& event, ReportedPassKind kind) {
        next_.kind = kind;
        next_.number = number_++;
        next_.iteration = event.iteration;
        if (event.state != nullptr) {
            for (const pipeline::Target target : event.state->reads) add(next_.reads, target);
            for (int unit = 0; unit < event.state->depth_unit_count; ++unit)
                add(next_.reads, event.state->depth_units[static_cast<std::size_t>(unit)].depth);
            for (const pipeline::Target target : event.state->textures) add(next_.reads, target);
            for (const pipeline::Target target : event.state->color) add(next_.writes, target);
            if (event.state->depth.enabled)
                add(event.state->depth.write ? next_.writes : next_.reads, event.state->depth_target);
            if (event.state->stencil.enabled) add(next_.writes, event.state->stencil_target);
        }
        for (std::size_t id = 0; id < next_.targets.size(); ++id)
            next_.targets[id].name = names_.of({static_cast<int>(id)});
        ended_ = std::exchange(next_, {});
        shown_samples_ = 0;
    }

    const std::function<void(PassReport&&)>& on_pass_;
    peeling::AsShown shown_;
    int samples_;
    std::mutex mutex_;
    TargetNames names_;
    PassReport next_{};
    int shown_samples_ = 0;  // of next_
    std::optional<PassReport> ended_{};
    int number_ = 0;
};

}  // namespace

void passes(const RunInput& input, const peeling::Algorithm& algorithm,
            const std::function<void(PassReport&&)>& on_pass, std::span<const pipeline::Alteration> alterations) {
    const int samples = input.sampling.samples;
    PassCollector collector{on_pass, {input.options, input.profile}, samples};
    std::vector<pipeline::Observer> observers;
    for (int sample = 0; sample < samples; ++sample)
        observers.push_back(
            {.named = [&collector, sample](pipeline::Target target,
                                           std::string_view name) { collector.name(sample, target, name); },
             .step = [&collector, sample](const Region& region,
                                          const StepEvent& event) { collector.step(sample, region, event); }});
    collector.publish(observe(input, algorithm, observers, alterations));
}

}  // namespace strata::oracle
