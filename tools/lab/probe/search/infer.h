// tools/lab/probe/search/infer.h - infers a device's profile from its answers, with the evidence for every field.
//
// Rule     The evidence of a field is the set of n positions of its scenes where its values differ, with all other
//          fields as found. A value has k of n if the device's bits equal that value's in k of them. A field without
//          such positions is open, as is one whose best values have equal k. Nothing is guessed: an open field keeps
//          the value of the profile that the search started from, and is reported as open.
// Tests    tests/tools/lab/probe/infer_test.cpp
#pragma once
#include "tools/lab/probe/search/search.h"

namespace strata::probe {

// inferred: one value has all n. broken: one value has the greatest k, and at some positions no value explains the
// device. open: several values have the greatest k, or no scene distinguishes them. idle: the field has no effect given
// the others. unprobed: the kit has no scene for it. stated: a feature or a limit, as reported by the driver.
enum class FieldState : std::uint8_t { inferred, broken, open, idle, unprobed, stated };

struct ValueCount {
    std::string value{};
    std::uint64_t agree = 0;  // k
};

// A position where the device differs from the field's value.
struct Contradiction {
    std::string item{}, target{};  // "color" or "depth"
    int x = 0, y = 0;
};

struct FieldFinding {
    std::string key{}, value{};
    FieldState state = FieldState::open;
    std::uint64_t agree = 0, places = 0;    // k of n
    std::vector<ValueCount> runners_up{};   // best first; if the field is open they have equal k
    std::optional<Contradiction> broken{};  // the first contradiction, if k < n
    std::string reason{};                   // for fields that are neither inferred nor stated; rarely for broken ones
};

// A scene that the profile does not explain completely.
struct Unexplained {
    std::string item{};
    Tally tally{};
    Contradiction first{};
    // The single change of a field that explains most of it, and the remaining differences; empty if none helps.
    std::string nearest{};
    std::uint64_t left = 0;
};

struct Inference {
    DeviceProfile profile{};
    YDirection orientation{};
    Tally tally{};
    std::vector<FieldFinding> fields{};
    std::vector<Unexplained> unexplained{};
    // Items that the device did not draw, with the reason it gave.
    std::vector<std::pair<std::string, std::string>> missing{};
};

// Uses the answers of one orientation.
[[nodiscard]] Inference infer(const ProbePack& pack, const std::vector<Item>& items, YDirection y);

[[nodiscard]] std::string_view name(FieldState state) noexcept;

}  // namespace strata::probe
