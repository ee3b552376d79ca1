// tools/strata/main.cpp - strata: the program with the everyday commands. The experiments are in strata-lab
// (tools/lab).
#include "tools/strata/program.h"

int main(int count, char** words) { return strata::tools::run_program(count, words, {}); }
