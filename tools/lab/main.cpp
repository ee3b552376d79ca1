// tools/lab/main.cpp - strata-lab: the experiments, and every other command. People type `strata cost`, which runs
// this.
#include "tools/lab/commands.h"
#include "tools/strata/program.h"

int main(int count, char** words) {
    using namespace strata::tools;
    return run_program(count, words,
                       {{"cost", add_cost},
                        {"invariance", add_invariance},
                        {"hard-cases", add_hard_cases},
                        {"reproduce", add_reproduce},
                        {"bench", add_bench},
                        {"hardware-check", add_hardware_check},
                        {"probe", add_probe},
                        {"infer", add_infer}});
}
