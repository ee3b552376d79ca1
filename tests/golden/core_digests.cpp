// tests/golden/core_digests.cpp - prints the digests of the core's five scenes; tools/test.sh --matrix compares them
// between compilers.
#include <exception>
#include <iostream>

#include "tests/golden/core_scenes.h"

int main(int count, char** words) {
    using namespace strata::golden;
    try {
        const Settings settings = parse(count, words);
        std::string text =
            "# scene profile algorithm colour depth outcome; 64x64. Made by tools/golden.sh (core_digests).\n"
            "# Right because tests/peeling compares the same fragments and their order with the exact A-buffer.\n";
        for (const GoldenScene& scene : core_scenes()) text += lines(scene, settings);
        return finish(text, settings);
    } catch (const std::exception& error) {
        std::cerr << "core_digests: " << error.what() << '\n';
        return 2;
    }
}
