// tests/fuzz/differential_seeds.cpp - the same frames without libFuzzer: the bytes of each frame are made from its
// seed.
// Run: differential_seeds --seeds A..B (B exclusive), exit status 1 at the first difference;
//      --seeds A..B --threads N on N threads;
//      --seeds A..B --relations compares each frame with equivalent forms of it;
//      differential_seeds --write FOLDER: the bytes of the first hundred frames as a corpus for libFuzzer.
#include <charconv>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <random>
#include <string_view>

#include "tests/fuzz/differential.h"
#include "tests/fuzz/relations.h"

namespace {

struct Seeds {
    std::uint64_t first = 0, end = 0;
};

std::optional<Seeds> parse(std::string_view text) {
    Seeds seeds;
    const std::size_t dots = text.find("..");
    if (dots == std::string_view::npos) return std::nullopt;
    const auto number = [](std::string_view digits, std::uint64_t& value) {
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return error == std::errc{} && end == digits.data() + digits.size();
    };
    if (!number(text.substr(0, dots), seeds.first) || !number(text.substr(dots + 2), seeds.end)) return std::nullopt;
    return seeds;
}

std::vector<std::uint8_t> bytes_of(std::uint64_t seed) {
    std::mt19937_64 random{seed};
    std::vector<std::uint8_t> bytes(64 + random() % 1472);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 32);
    return bytes;
}

void write(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const std::vector<std::uint8_t> bytes = bytes_of(seed);
        std::ofstream(folder / std::to_string(seed), std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
}

// Prints the sum and one line per relation.
void print(const strata::fuzz::RelationCounts& held) {
    std::uint64_t all = 0;
    for (const auto& [name, frames] : held) all += frames;
    std::cout << all << " relations hold\n";
    for (const auto& [name, frames] : held) std::cout << "  " << frames << ' ' << name << '\n';
}

}  // namespace

int main(int count, char** words) {
    if (count == 3 && std::string_view{words[1]} == "--write") {
        write(words[2]);
        return 0;
    }
    const bool has_threads = count == 5 && std::string_view{words[3]} == "--threads";
    const int threads = has_threads ? std::atoi(words[4]) : 1;
    const bool has_relations = count == 4 && std::string_view{words[3]} == "--relations";
    const bool is_run =
        (count == 3 || has_threads || has_relations) && std::string_view{words[1]} == "--seeds" && threads > 0;
    const std::optional<Seeds> seeds = is_run ? parse(words[2]) : std::nullopt;
    if (!seeds) {
        std::cerr << "differential_seeds --seeds A..B [--threads N | --relations] | --write FOLDER\n";
        return 2;
    }
    strata::fuzz::RelationCounts held;
    for (std::uint64_t seed = seeds->first; seed < seeds->end; ++seed) {
        bool agrees = false;
        try {
            agrees = has_relations ? strata::fuzz::check_relations(bytes_of(seed), held, std::cerr)
                                   : strata::fuzz::check(bytes_of(seed), std::cerr, threads);
        } catch (const std::exception& error) {
            std::cerr << error.what() << '\n';
        }
        if (agrees) continue;
        std::cerr << "seed " << seed << '\n';
        return 1;
    }
    std::cout << seeds->end - seeds->first << " frames: ";
    if (!has_relations) {
        std::cout << "every way alike\n";
        return 0;
    }
    print(held);
}
