// specification_cases RULE CASES [SEED]: writes cases of a rule (tests/specification/cases.h) to standard output.
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "rasterizer/base/float_environment.h"
#include "tests/specification/cases.h"

int main(int argc, char** argv) {
    const strata::FloatEnvironment environment;
    const std::string_view rule = argc > 2 ? argv[1] : "";
    const std::uint64_t cases = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
    const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
    if (cases > 0 && rule == "window_z") {
        strata::specification::write_window_z(std::cout, cases, seed);
    } else if (cases > 0 && rule == "dual") {
        strata::specification::write_dual(std::cout, cases, seed);
    } else if (cases > 0 && rule == "blend") {
        strata::specification::write_blend(std::cout, cases, seed);
    } else {
        std::cerr << "specification_cases: expected window_z, dual or blend, and a number of cases\n";
        return 2;
    }
    return std::cout ? 0 : 3;
}
