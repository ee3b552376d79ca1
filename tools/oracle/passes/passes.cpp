// tools/oracle/passes/passes.cpp - collects each pass and reports it with the content of all targets (passes.h).
#include "tools/oracle/passes/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "peeling/as_shown.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "pipeline/frame/instruments.h"
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

pipeline::Image observe(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                        const pipeline::Observer& observer, const pipeline::Alteration* alteration) {
    peeling::RenderOptions options = input.options;
    options.execution = pipeline::Execution::literal;
    options.audit = options.keep_layers = options.nearest_depth = false;
    peeling::Renderer renderer{input.with(options)};
    peeling::RenderResult result = renderer.render(algorithm, {}, {.observer = &observer, .alteration = alteration});
    if (result.outcome == peeling::Outcome::refused) throw pipeline::Refused{input.profile, *std::move(result.refusal)};
    return std::move(result.frame.color);
}

namespace {

class PassCollector {
  public:
    PassCollector(const std::function<void(PassReport&&)>& on_pass, const peeling::AsShown& shown)
        : on_pass_{on_pass}, shown_{shown} {}

    void name(pipeline::Target target, std::string_view name) { names_.add(target, name); }

    void step(const Region& region, const StepEvent& event) {
        if (!event.is_counted) return;
        switch (event.step) {
            case Step::clear: next_.before.push_back("clear " + names_.of(event.to)); break;
            case Step::copy:
                next_.before.push_back(fmt::format("copy {} to {}", names_.of(event.from), names_.of(event.to)));
                break;
            case Step::query:
                if (ended_) ended_->queries.push_back({event.passed, event.answer});
                break;
            case Step::geometry: add(region, event, ReportedPassKind::geometry); break;
            case Step::full_screen: add(region, event, ReportedPassKind::full_screen); break;
            case Step::publish: next_.iteration = event.iteration; break;
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

    void add(const Region& region, const StepEvent& event, ReportedPassKind kind) {
        flush();
        next_.passed = event.passed;
        next_.tallied = event.tallied;
        for (int id = 0; id < region.targets().count(); ++id)
            next_.targets.push_back({names_.of({id}), image_of(region, {id})});
        complete(event, kind);
    }

    // The image of all samples of the frame, and of those that a target has of its own, as the stencil-routed
    // k-buffer's.
    [[nodiscard]] pipeline::Image image_of(const Region& region, pipeline::Target target) const {
        const auto samples = static_cast<std::size_t>(region.frame().samples());
        pipeline::Image whole;
        for (std::size_t sample = 0; sample < samples; ++sample) {
            const pipeline::Image part = shown_image(region, target, sample);
            if (sample == 0)
                whole = pipeline::Image::for_overwrite(part.format, part.width, part.height,
                                                       static_cast<int>(samples) * part.samples);
            const auto words = static_cast<std::size_t>(part.samples * part.channels());
            for (std::size_t pixel = 0, i = 0; i < part.codes.size(); ++pixel)
                for (std::size_t w = 0; w < words; ++w, ++i)
                    whole.codes[(pixel * samples + sample) * words + w] = part.codes[i];
        }
        return whole;
    }

    [[nodiscard]] pipeline::Image shown_image(const Region& region, pipeline::Target target, std::size_t sample) const {
        pipeline::Image image = region.targets().image(target, sample);
        shown_.turn(image);
        return image;
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
        ended_ = std::exchange(next_, {});
    }

    const std::function<void(PassReport&&)>& on_pass_;
    peeling::AsShown shown_;
    TargetNames names_;
    PassReport next_{};
    std::optional<PassReport> ended_{};
    int number_ = 0;
};

}  // namespace

void passes(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
            const std::function<void(PassReport&&)>& on_pass, const pipeline::Alteration* alteration) {
    PassCollector collector{on_pass, {input.options, input.profile}};
    const pipeline::Observer observer{
        .named = [&](pipeline::Target target, std::string_view name) { collector.name(target, name); },
        .step = [&](const Region& region, const StepEvent& event) { collector.step(region, event); }};
    collector.publish(observe(input, algorithm, observer, alteration));
}

}  // namespace strata::oracle
