// tests/fuzz/input_fuzz.cpp - libFuzzer's entry to tests/fuzz/inputs.h. The program's name selects the input:
// profile_fuzz, camera_fuzz, plan_fuzz, pack_fuzz, exr_fuzz and calls_fuzz are links to it, so that processes that
// libFuzzer starts select the same input. Run: profile_fuzz CORPUS
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

#include "tests/fuzz/inputs.h"

namespace {

const strata::fuzz::Input* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char*** words) {
    const std::string name = std::filesystem::path((*words)[0]).filename().string();
    for (const auto& input : strata::fuzz::inputs())
        if (name == std::string{input.name} + "_fuzz") chosen = &input;
    if (chosen != nullptr) return 0;
    std::cerr << "input_fuzz: expected to be called by the name of an input, such as profile_fuzz, found '" << name
              << "'\n";
    std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        chosen->try_bytes({data, size});
    } catch (const std::logic_error& broken) {
        std::cerr << broken.what() << '\n';
        std::abort();
    }
    return 0;
}
