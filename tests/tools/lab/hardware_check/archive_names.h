// tests/tools/lab/hardware_check/archive_names.h - every name that the test suite for the NV2A can give its captures,
// generated as its programs do (abaire/nxdk_pgraph_tests, MIT), and whether each is drawn or not modelled.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strata::hardware_check {

using Names = std::vector<std::string>;

enum class Outcome : std::uint8_t { drawn, not_modelled, unknown };

// Names of one suite with the same outcome. `count` is their number by the suite's parameters, counted by hand.
struct NameGroup {
    Outcome outcome;
    std::string_view suite;
    Names names;
    std::size_t count;
};
using Archive = std::vector<NameGroup>;

[[nodiscard]] Archive archive_names();

}  // namespace strata::hardware_check
