// tests/support/catch_main.cpp - the main function of the tests where the package's Catch2 main library cannot be
// linked.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
