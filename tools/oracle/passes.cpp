#include "tools/oracle/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "peeling/as_shown.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "pipeline/region/region.h"

namespace strata::oracle {

using pipeline::Region;
using pipeline::Step;
using pipeline::StepEvent;

std::string_view name(PassKind kind) noexcept {
    switch (kind) {
        case PassKind::geometry: return "geometry";
        case PassKind::full_screen: return "full_screen";
        case PassKind::published: return "published";
    }
    return "";  // unreachable: the enum is closed
}

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

void observe(const RunInput& input, const peeling::Algorithm& algorithm, const pipeline::Observer& observer,
             const pipeline::Alteration* alteration) {
    peeling::RenderOptions options = input.options;
    options.execution = pipeline::Execution::literal;
    options.audit = options.keep_layers = options.nearest_depth = false;
    peeling::Renderer renderer{input.list, input.view, input.profile, options};
    peeling::RenderResult result = renderer.render(algorithm, {}, {.observer = &observer, .alteration = alteration});
    if (result.outcome == peeling::Outcome::refused) throw pipeline::Refused{input.profile, *std::move(result.refusal)};
}

namespace {

class Collector {
  public:
    Collector(const std::function<void(PassReport&&)>& on_pass, const peeling::AsShown& shown)
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
            case Step::geometry: show(region, event, PassKind::geometry); break;
            case Step::full_screen: show(region, event, PassKind::full_screen); break;
            case Step::publish: show(region, event, PassKind::published); break;
        }
    }

    // A pass is reported when its queries are answered.
    void flush() {
        if (ended_) on_pass_(*std::exchange(ended_, std::nullopt));
    }

  private:
    void add(std::vector<std::string>& to, pipeline::Target target) const {
        if (target.exists()) to.push_back(names_.of(target));
    }

    void show(const Region& region, const StepEvent& event, PassKind kind) {
        next_.kind = kind;
        next_.number = number_++;
        next_.iteration = event.iteration;
        next_.passed = event.passed;
        next_.tallied = event.tallied;
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
        if (kind == PassKind::published)
            next_.targets.push_back({"picture", region.targets().image(event.to)});
        else
            for (int id = 0; id < region.targets().count(); ++id)
                next_.targets.push_back({names_.of({id}), region.targets().image({id})});
        for (NamedImage& target : next_.targets) shown_.turn(target.image);
        flush();
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

void passes(const RunInput& input, const peeling::Algorithm& algorithm,
            const std::function<void(PassReport&&)>& on_pass, const pipeline::Alteration* alteration) {
    Collector collector{on_pass, {input.options, input.profile}};
    const pipeline::Observer observer{
        .named = [&](pipeline::Target target, std::string_view name) { collector.name(target, name); },
        .step = [&](const Region& region, const StepEvent& event) { collector.step(region, event); }};
    observe(input, algorithm, observer, alteration);
    collector.flush();
}

}  // namespace strata::oracle
