// tools/probe/infer.h - a device's profile from its answers, with the evidence for every field.
//
// Rule     The evidence of a field are the places of its scenes where its values differ, all other fields being as
//          found: n of them. A value has k of n if the device's bits are those of that value in k of them. A field
//          without such a place is open; so is one whose best values have equal k. Nothing is guessed: an open field
//          keeps the value of the profile that the search began with, and is said to be open.
// Tests    tests/tools/probe/infer_test.cpp
#pragma once
#include "tools/probe/search.h"

namespace strata::probe {

// inferred: one value has all n. broken: one has the greatest k, and there are places where the device does what none
// says. open: several have the greatest k, or no scene tells. idle: the field has no effect beside the others.
// unprobed: the kit has no scene for it. stated: a feature or a limit, as the driver says.
enum class FieldState : std::uint8_t { inferred, broken, open, idle, unprobed, stated };

struct ValueCount {
    std::string value{};
    std::uint64_t agree = 0;  // k
};

// A place where the device does not do what the field's value says.
struct Contradiction {
    std::string item{}, target{};  // "color" or "depth"
    int x = 0, y = 0;
};

struct FieldFinding {
    std::string key{}, value{};
    FieldState state = FieldState::open;
    std::uint64_t agree = 0, places = 0;    // k of n
    std::vector<ValueCount> runners_up{};   // best first; equal k first if the field is open
    std::optional<Contradiction> broken{};  // the first, if k < n
    std::string reason{};                   // of a field that is neither inferred nor stated; of few that are broken
};

// A scene that the profile does not explain.
struct Unexplained {
    std::string item{};
    Tally tally{};
    Contradiction first{};
    // The one change of a field that explains most of it, and what is left then; empty if none helps.
    std::string nearest{};
    std::uint64_t left = 0;
};

struct Inference {
    DeviceProfile profile{};
    YDirection orientation{};
    Tally tally{};
    std::vector<FieldFinding> fields{};
    std::vector<Unexplained> unexplained{};
    // Items that the device did not draw, with its reason.
    std::vector<std::pair<std::string, std::string>> missing{};
};

// By the answers of one orientation.
[[nodiscard]] Inference infer(const ProbePack& pack, const std::vector<Item>& items, YDirection y);

[[nodiscard]] std::string_view name(FieldState state) noexcept;

}  // namespace strata::probe
