// tools/oracle/emulations/program_change.h - mistakes that change what a program writes: parts that several files use.
#pragma once
#include <algorithm>
#include <functional>
#include <initializer_list>
#include <string_view>

#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

[[nodiscard]] inline bool is_run_by(const AlteredRun& e, std::initializer_list<std::string_view> algorithms) {
    return std::ranges::find(algorithms, e.algorithm->name) != algorithms.end();
}

[[nodiscard]] inline std::size_t lanes_of_call(const pipeline::ProgramCall& call) {
    return static_cast<std::size_t>(call.in.count);
}

// Calls change(call) after the programs of passes of this kind whose first target has this name.
template <class Change>
bool behind_pass_of(AlteredRun& e, pipeline::PassKind kind, const char* target, Change change) {
    e.alterations.push_back({.program = [names = e.names, kind, target, change](const pipeline::ProgramCall& call,
                                                                                const std::function<void()>& run) {
        run();
        if (call.kind == kind && names->is(call.state.color[0], target)) change(call);
    }});
    return true;
}

}  // namespace strata::oracle
