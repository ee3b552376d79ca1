// Tests the prediction of --max-memory against the peak that the system measures.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <sstream>

#include "tests/tools/program.h"

namespace {

using namespace strata::test;

constexpr double bytes_of_a_mebibyte = 1 << 20;

// The number of bytes in the message that rejects the run.
double predicted(const Folder& folder, std::vector<std::string> words) {
    words.insert(words.end(), {"--max-memory", "1M"});
    const CommandResult ended = run_strata(folder, words);
    CHECK(ended.status == 2);
    std::smatch found;
    REQUIRE(std::regex_search(ended.err, found, std::regex("needs about ([0-9]+) MB, the limit is 1 MB")));
    return std::stod(found[1]) * bytes_of_a_mebibyte;
}

struct Peak {
    double told, measured;  // bytes
};

Peak peak_of(const Folder& folder, const std::string& job, const char* threads) {
    std::istringstream in(job + " --threads " + threads);
    const std::vector<std::string> words{std::istream_iterator<std::string>{in}, {}};
    const auto measured = static_cast<double>(peak_of_strata(folder, words));
    REQUIRE(measured > 0);
    return {predicted(folder, words), measured};
}

}  // namespace

TEST_CASE("the predicted memory of a picture is within a quarter of the measured one") {
    const std::vector<std::string> jobs{
        "render teapot --size 1024x1024 --algorithm dual",
        "render teapot --size 1024x1024 --algorithm dual --no-audit -o a.png",
        "render teapot --size 1024x1024 --algorithm dual --no-audit -o a.exr",
        "render teapot --size 1024x1024 --algorithm dual --execution literal --no-audit",
        "render teapot --size 1024x1024 --algorithm dual --execution literal --profile ideal --no-audit",
        "render teapot --size 1024x1024 --algorithm depth_units --execution literal --no-audit",
        "layers teapot --size 512x512 --algorithm front_to_back -o layers.exr",
        "render volume-beam:slices=64 --size 512x512 --algorithm dual",
        "render volume-beam:slices=64 --size 512x512 --algorithm a_buffer",
        "render volume-beam:slices=64 --size 512x512 --algorithm depth_units --no-audit"};
    const Folder folder;
    double worst = 0;
    for (const std::string& job : jobs) {
        const Peak one = peak_of(folder, job, "1"), two = peak_of(folder, job, "2");
        INFO(job << ": " << one.measured / bytes_of_a_mebibyte << " and " << two.measured / bytes_of_a_mebibyte
                 << " MiB");
        CHECK(one.told == Approx(one.measured).epsilon(0.25));
        // Two threads may work on their tiles alternately and then need less, but never a quarter more than predicted.
        CHECK(two.measured < 1.25 * two.told);
        worst = std::max(worst, std::abs(one.told / one.measured - 1));
    }
    std::cout << jobs.size() << " pictures: memory told within " << std::ceil(100 * worst) << " %" << std::endl;
}

TEST_CASE("a picture that would exceed --max-memory is rejected before anything is written") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"render", "teapot", "--size", "2048x2048", "--execution", "literal",
                                                    "--max-memory", "64M", "-o", "a.exr"});
    CHECK(ended.status == 2);
    CHECK(std::regex_match(
        ended.err, std::regex(R"(strata: --max-memory: dual at 2048x2048 needs about [0-9]+ MB, the limit is 64 MB; )"
                              R"(a smaller --size or --fragment-memory takes less\n)")));
    CHECK(folder.files().empty());
    CHECK(run_strata(folder, {"render", "teapot", "--size", "64x64", "--max-memory", "64M"}).status == 0);
}

TEST_CASE("a verdict takes at most 200 bytes a pixel and 64 MB", "[long]") {
    const Folder folder;
    constexpr std::uint64_t side = 1024;
    REQUIRE(
        run_strata(folder, {"render", "teapot", "--alpha", "0.5", "--size", "1024x1024", "--no-audit", "-o", "a.exr"})
            .status == 0);
    const std::uint64_t peak = peak_of_strata(folder, {"compare", "teapot", "a.exr", "--alpha", "0.5"});
    INFO(static_cast<double>(peak) / bytes_of_a_mebibyte << " MiB");
    CHECK(peak > 0);
    CHECK(peak < 200 * side * side + (std::uint64_t{64} << 20));
}

namespace {

void write(const Folder& folder, const std::string& name, const std::string& bytes) {
    std::ofstream{folder / name, std::ios::binary} << bytes;
}

// Every image is the same file, and every material draws another of them.
std::string gltf_with_images(int count) {
    std::string images, textures, materials, primitives;
    for (int i = 0; i < count; ++i) {
        const std::string number = std::to_string(i), comma = i == 0 ? "" : ",";
        images += comma + R"({"uri": "a.png"})";
        textures += comma + R"({"source": )" + number + "}";
        materials += comma + R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": )" + number + "}}}";
        primitives += comma + R"({"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": )" + number + "}";
    }
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]},
                      {"componentType": 5126, "count": 3, "type": "VEC2"}], "images": [)" +
           images + R"(], "textures": [)" + textures + R"(], "materials": [)" + materials +
           R"(], "meshes": [{"primitives": [)" + primitives + "]}]}";
}

}  // namespace

TEST_CASE("what a file or a scene takes is compared with --max-memory before it is read") {
    struct Large {
        std::vector<std::string> words;
        std::string message;  // its beginning
    };
    const Large large = GENERATE(values<Large>({
        {{"compare", "a.raw", "a.raw", "--layout", "4096x4096:rgba32f"}, "a.raw: size: expected a picture that takes"},
        {{"compare", "a.raw", "a.raw", "--layout", "4x4:rgba8"}, "a.raw: size: expected 64 bytes (4 rows of 16 bytes)"},
        {{"render", "random:triangles=10000000"}, "random:triangles=10000000: scene: expected triangles that take"},
        {{"render", "planes:count=64,cells=256"}, "planes:count=64,cells=256: scene: expected triangles that take"},
        {{"render", "a.gltf"}, "a.gltf: /images/"},
        {{"render", "a.stl"}, "a.stl: size: expected a model that takes"},
        {{"render", "a.json"}, "a.json: size: expected JSON that takes"},
        {{"render", "teapot", "--camera", "a.raw"}, "a.raw: size: expected at most 1048576 bytes"},
    }));
    const Folder folder;
    REQUIRE(shell(folder, "strata render planes:count=1 --size 1024x1024 --no-audit -q -o a.png").status == 0);
    write(folder, "a.gltf", gltf_with_images(200));
    write(folder, "a.raw", "");
    std::filesystem::resize_file(folder / "a.raw", std::uintmax_t{4096} * 4096 * 16);
    write(folder, "a.stl", std::string(10'000'000, ' '));
    std::string list = "[0]";
    for (int i = 0; i < 5'000'000; ++i) list += ",1";
    write(folder, "a.json", R"({"positions": [)" + list + "]}");
    std::vector<std::string> words = large.words;
    words.insert(words.end(), {"--max-memory", "80M"});
    const CommandResult ended = run_strata(folder, words);
    CHECK(ended.status == 2);
    CHECK(ended.err.substr(0, 8 + large.message.size()) == "strata: " + large.message);
    CHECK(lines_of(ended.err).size() == 1);
    const std::uint64_t peak = peak_of_strata(folder, words, 2);
    INFO(static_cast<double>(peak) / bytes_of_a_mebibyte << " MiB");
    CHECK(peak > 0);
    CHECK(peak < (std::uint64_t{160} << 20));  // with the libraries that read images
}

TEST_CASE("the pixels of a picture are counted before they are decoded") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render planes:count=1 --size 1024x1024 --no-audit -q -o a.png && strata render "
                  "planes:count=1 --size 1024x1024 --no-audit -q -o a.exr")
                .status == 0);
    for (const char* file : {"a.png", "a.exr"})
        for (const char* reference : {"planes:count=1", "a.png"}) {
            const CommandResult ended = run_strata(folder, {"compare", reference, file, "--max-memory", "40M"});
            INFO(ended.err);
            CHECK(ended.status == 2);
            CHECK(std::regex_match(
                ended.err,
                std::regex(R"(strata: a\.(png|exr): size: expected a picture that takes at most [0-9]+ (MB|bytes), )"
                           R"(which --max-memory leaves, found 1024x1024, which takes about [0-9]+ MB\n)")));
        }
    for (const char* command : {"golden", "passes"})
        CHECK(run_strata(folder, {command, "teapot", "--size", "1024x1024", "--max-memory", "40M", "-o", "out"})
                  .err.starts_with("strata: --max-memory: "));
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("a limit below a megabyte is said in bytes") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"render", "teapot", "--size", "8x8", "--max-memory", "10"});
    CHECK(ended.status == 2);
    CHECK(ended.err.find("the limit is 10 bytes;") != std::string::npos);
}
