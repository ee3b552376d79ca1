// tests/fuzz/replay_inputs.cpp - runs the kept inputs without a fuzzer.
// Run: replay_inputs FOLDER: each file of FOLDER/NAME is tried as an input of that name, those of FOLDER/gltf as
// scenes;
//      exit status 1 if a rule is broken. replay_inputs --write FOLDER: writes a corpus to start from.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "tests/fuzz/inputs.h"

// Defined in load_render_fuzz.cpp.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using strata::fuzz::Input;

void write_nothing(const std::filesystem::path&) {}

std::vector<Input> all_inputs() {
    std::vector<Input> all(strata::fuzz::inputs().begin(), strata::fuzz::inputs().end());
    all.push_back(
        {"gltf", [](strata::fuzz::Bytes bytes) { LLVMFuzzerTestOneInput(bytes.data(), bytes.size()); }, write_nothing});
    return all;
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

int replay(const Input& input, const std::filesystem::path& folder) {
    const auto files = files_in(folder);
    for (const auto& path : files) {
        std::ifstream file(path, std::ios::binary);
        const std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>{file}, {});
        try {
            input.try_bytes(bytes);
        } catch (const std::exception& error) {
            std::cerr << path << ": " << error.what() << '\n';
            return 1;
        }
    }
    std::cout << input.name << ": " << files.size() << " inputs, 0 bad\n";
    return files.empty() ? 1 : 0;
}

}  // namespace

int main(int count, char** words) {
    const bool writes = count == 3 && std::string_view{words[1]} == "--write";
    if (count != 2 && !writes) {
        std::cerr << "replay_inputs FOLDER | --write FOLDER\n";
        return 2;
    }
    int status = 0;
    for (const Input& input : all_inputs()) {
        const std::filesystem::path folder = std::filesystem::path{words[count - 1]} / input.name;
        if (writes) {
            std::filesystem::create_directories(folder);
            input.write_seeds(folder);
        } else {
            status |= replay(input, folder);
        }
    }
    return status;
}
