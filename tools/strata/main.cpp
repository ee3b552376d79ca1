// tools/strata/main.cpp - strata: the commands of every day. Experiments are strata-lab's (tools/lab).
#include "tools/strata/program.h"

int main(int count, char** words) { return strata::tools::run_program(count, words, {}); }
