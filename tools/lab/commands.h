// tools/lab/commands.h - the commands of strata-lab. Their names and descriptions are in tools/strata/lab.cpp.
#pragma once
#include "tools/strata/command.h"
#include "tools/strata/lab.h"

namespace strata::tools {

[[nodiscard]] Command add_cost(CLI::App& root);
[[nodiscard]] Command add_invariance(CLI::App& root);
[[nodiscard]] Command add_multisampling(CLI::App& root);
[[nodiscard]] Command add_hard_cases(CLI::App& root);
[[nodiscard]] Command add_reproduce(CLI::App& root);
[[nodiscard]] Command add_bench(CLI::App& root);
[[nodiscard]] Command add_hardware_check(CLI::App& root);
[[nodiscard]] Command add_probe(CLI::App& root);
[[nodiscard]] Command add_infer(CLI::App& root);

}  // namespace strata::tools
