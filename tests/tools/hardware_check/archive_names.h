// tests/tools/hardware_check/archive_names.h - every name that the test suite on the chip can give its pictures, made
// as its programs make them (abaire/nxdk_pgraph_tests, MIT), and what is said of each: drawn, or not modelled for a
// reason.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strata::hardware_check {

using Names = std::vector<std::string>;

enum class Says : std::uint8_t { drawn, not_modelled, unknown };

// Names of one suite that share an answer. `count` is how many there are by the suite's parameters, counted by hand.
struct NameGroup {
    Says says;
    std::string_view suite;
    Names names;
    std::size_t count;
};
using Archive = std::vector<NameGroup>;

[[nodiscard]] Archive archive_names();

}  // namespace strata::hardware_check
