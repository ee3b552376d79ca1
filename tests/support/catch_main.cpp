// tests/support/catch_main.cpp - the main function of tests where the package's own cannot be linked.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
