// tests/fuzz/differential_seeds.cpp - the same frames without libFuzzer: the bytes of each come from its seed.
// Run: differential_seeds --seeds A..B (B is left out). Exit status 1 at the first difference.
#include <charconv>
#include <exception>
#include <iostream>
#include <optional>
#include <random>
#include <string_view>

#include "tests/fuzz/differential.h"

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

}  // namespace

int main(int count, char** words) {
    const std::optional<Seeds> seeds =
        count == 3 && std::string_view{words[1]} == "--seeds" ? parse(words[2]) : std::nullopt;
    if (!seeds) {
        std::cerr << "differential_seeds --seeds A..B\n";
        return 2;
    }
    for (std::uint64_t seed = seeds->first; seed < seeds->end; ++seed) {
        bool agrees = false;
        try {
            agrees = strata::fuzz::check(bytes_of(seed), std::cerr);
        } catch (const std::exception& error) {
            std::cerr << error.what() << '\n';
        }
        if (agrees) continue;
        std::cerr << "seed " << seed << '\n';
        return 1;
    }
    std::cout << seeds->end - seeds->first << " frames: every way alike\n";
}
