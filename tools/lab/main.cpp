// tools/lab/main.cpp - strata-lab: the program with the experiments and all other commands. Users call `strata cost`,
// which runs this program.
#include "tools/lab/commands.h"
#include "tools/strata/program.h"

int main(int count, char** words) {
    using namespace strata::tools;
    return run_program(count, words,
                       {{"cost", add_cost},
                        {"invariance", add_invariance},
                        {"multisampling", add_multisampling},
                        {"hard-cases", add_hard_cases},
                        {"reproduce", add_reproduce},
                        {"bench", add_bench},
                        {"hardware-check", add_hardware_check},
                        {"probe", add_probe},
                        {"infer", add_infer}});
}
