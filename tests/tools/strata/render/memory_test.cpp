// Tests the peak memory of a run against the sizes of the scene, the images and --fragment-memory.
#include <catch2/catch.hpp>

#include "tests/tools/program.h"

namespace {

using namespace strata::test;

constexpr std::uint64_t megabyte = std::uint64_t{1} << 20;

// Four tiles of up to a million fragments: if stored completely, each would take about 40 MB.
std::uint64_t peak(const Folder& folder, const std::string& algorithm, const std::vector<std::string>& how) {
    std::vector<std::string> words{
        "render",    "volume-beam:slices=64", "--size",      "256x256", "--tile", "128", "--threads", "2",
        "--profile", "geforce8_dx101",        "--algorithm", algorithm};
    words.insert(words.end(), how.begin(), how.end());
    const std::uint64_t bytes = peak_of_strata(folder, words);
    REQUIRE(bytes > 0);
    return bytes;
}

std::uint64_t picture_bytes(const Folder& folder) {
    // The program with its threads and libraries: the peak for a tiny picture.
    const std::uint64_t program =
        peak_of_strata(folder, {"render", "volume-beam:slices=1", "--size", "8x8", "--threads", "2"});
    REQUIRE(program > 0);
    const std::uint64_t scene = megabyte;                   // 5,128 triangles
    const std::uint64_t targets = 256 * 256 * (4 + 1) * 4;  // colour and Z, a 32-bit value per code
    return program + (scene + targets) * 3 / 2;
}

}  // namespace

TEST_CASE("the memory of a frame is at most 1.5 times that of its scene and targets and fragment memory") {
    const Folder folder;
    const std::uint64_t picture = picture_bytes(folder), fragments = 4 * megabyte;
    for (const char* algorithm : {"dual", "front_to_back", "dual_independent", "depth_units"}) {
        // depth_units keeps a colour and a depth for each of 65 layers and the empty one, in two tiles at a time.
        const std::uint64_t layers = algorithm == std::string{"depth_units"} ? 2 * 66 * 2 * 128 * 128 * 4 : 0;
        // A pass of dual_independent lists the fragments that it visits, 12 bytes each: nearest, farthest and their
        // neighbours.
        const std::uint64_t visits = algorithm == std::string{"dual_independent"} ? 2 * 4 * 12 * 128 * 128 : 0;
        INFO(algorithm);
        CHECK(peak(folder, algorithm, {"--fragment-memory", "4M", "--no-audit"}) <
              picture + (layers + visits + fragments) * 3 / 2);
    }
}

TEST_CASE(
    "the memory of an audited frame is at most 1.5 times that of its scene and targets and twice its fragment memory") {
    const Folder folder;
    // An audit of everything at once would take 16 bytes of trace and 52 bytes of lists for each of 2.6 million
    // fragments: 180 MB.
    const std::uint64_t limit = 16 * megabyte;
    const std::vector<std::pair<std::string, std::string>> ways{{"dual", "replay"},
                                                                {"depth_units", "replay"},
                                                                {"a_buffer", "replay"},
                                                                {"a_buffer", "literal"},
                                                                {"unsorted", "literal"}};
    for (const auto& [algorithm, execution] : ways) {
        const std::uint64_t layers = algorithm == "depth_units" ? 2 * 66 * 2 * 128 * 128 * 4 : 0;
        INFO(algorithm << ", " << execution);
        CHECK(peak(folder, algorithm, {"--fragment-memory", "16M", "--execution", execution}) <
              picture_bytes(folder) + (layers + 2 * limit) * 3 / 2);
    }
}
