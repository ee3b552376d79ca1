// tools/oracle/emulations/altered_run.cpp - how a mistake changes a run: names of targets, vertices, programs, and
// combinations of two mistakes (altered_run.h).
#include "tools/oracle/emulations/altered_run.h"

#include <algorithm>
#include <utility>

namespace strata::oracle {

using RenderTarget = pipeline::Target;

void Names::add(RenderTarget target, std::string_view name) {
    const auto id = static_cast<std::size_t>(target.id);
    if (names_.size() <= id) names_.resize(id + 1);
    names_[id] = name;
}

bool Names::is(RenderTarget target, std::string_view name) const {
    const auto id = static_cast<std::size_t>(target.id);
    return target.exists() && id < names_.size() && names_[id] == name;
}

RenderTarget Names::partner(RenderTarget target) const {
    const auto id = static_cast<std::size_t>(target.id);
    if (!target.exists() || id >= names_.size() || names_[id].empty()) return target;
    RenderTarget other = target;
    for (std::size_t i = 0; i < names_.size(); ++i)
        if (i != id && names_[i] == names_[id]) {
            if (other != target) return target;  // three are not a pair
            other = {static_cast<int>(i)};
        }
    return other;
}

pipeline::DrawList& AlteredRun::scene() {
    if (!own_list) {
        own_list = std::make_shared<pipeline::DrawList>(*list);
        list = own_list.get();
    }
    return *own_list;
}

namespace {

// Calls both functions, one after the other.
template <class T>
std::function<void(T&)> in_turn(std::function<void(T&)> first, std::function<void(T&)> second) {
    if (!first || !second) return first ? first : second;
    return [first = std::move(first), second = std::move(second)](T& changed) {
        first(changed);
        second(changed);
    };
}

}  // namespace

void AlteredRun::alter_vertices(pipeline::VertexAlteration change) {
    if (vertex_alteration)
        change = {in_turn(vertex_alteration->vertices, std::move(change.vertices)),
                  in_turn(vertex_alteration->corners, std::move(change.corners))};
    vertex_alteration = std::make_shared<const pipeline::VertexAlteration>(std::move(change));
    options.vertex_alteration = vertex_alteration.get();
}

namespace {

using pipeline::Alteration;

// Calls the program of alteration `next` and of the later ones around the pass's own program.
void run_program(const std::vector<Alteration>& all, std::size_t next, const pipeline::ProgramCall& call,
                 const std::function<void()>& run) {
    while (next < all.size() && !all[next].program) ++next;
    if (next == all.size()) return run();
    all[next].program(call, [&] { run_program(all, next + 1, call, run); });
}

}  // namespace

Alteration combined(const AlteredRun& experiment) {
    const std::vector<Alteration>& all = experiment.alterations;
    return {
        .named = [names = experiment.names](RenderTarget target, std::string_view name) { names->add(target, name); },
        .clear =
            [&all](pipeline::Region& region, RenderTarget& target, pipeline::ClearValue& value) {
                return std::ranges::all_of(
                    all, [&](const Alteration& a) { return !a.clear || a.clear(region, target, value); });
            },
        .copy =
            [&all](pipeline::Region& region, RenderTarget& from, RenderTarget& to) {
                return std::ranges::all_of(all,
                                           [&](const Alteration& a) { return !a.copy || a.copy(region, from, to); });
            },
        .pass =
            [&all](pipeline::Region& region, pipeline::PassState& state, pipeline::PassKind kind) {
                for (const Alteration& a : all)
                    if (a.pass) a.pass(region, state, kind);
            },
        .program = [&all](const pipeline::ProgramCall& call,
                          const std::function<void()>& run) { run_program(all, 0, call, run); },
        .drawn =
            [&all](pipeline::PassKind kind, std::uint64_t passed) {
                for (const Alteration& a : all)
                    if (a.drawn) a.drawn(kind, passed);
            },
        .query =
            [&all](std::uint64_t count, bool goes_on) {
                for (const Alteration& a : all)
                    if (a.query) goes_on = a.query(count, goes_on);
                return goes_on;
            }};
}

}  // namespace strata::oracle
