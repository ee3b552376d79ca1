// Tests `strata golden`: its packs against other commands on the same scene by picture bytes and digests, and the error
// message for a changed file.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;
using Catch::Contains;

TEST_CASE("a pack passes its check and replaces a scene and its options in every command") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"golden", "teapot:tessellation=3", "--size", "20x16", "--algorithm",
                                "dual,front_to_back", "--depth-format", "d24", "--background", "0.2,0.4,0.6",
                                "--color-space", "linear", "-o", "pack"})
                .status == 0);
    const CommandResult check = run_strata(folder, {"golden", "--check", "pack"});
    CHECK(check.status == 0);
    CHECK(check.out == "pack: all files match\n");
    for (const std::string simd : {"scalar", "avx2", "avx512"}) {
        const CommandResult again = run_strata(folder, {"golden", "--check", "pack", "--simd", simd});
        const bool is_missing = again.err.find("what this processor has") != std::string::npos;
        CHECK((is_missing || again.status == 0));
        if (simd == "scalar") CHECK_FALSE(is_missing);
    }
    REQUIRE(shell(folder,
                  "strata render teapot:tessellation=3 --size 20x16 --algorithm dual --depth-format d24 --background "
                  "0.2,0.4,0.6 "
                  "--color-space linear -o scene.png && strata render pack --algorithm dual -o pack.png")
                .status == 0);
    CHECK(run_strata(folder, {"compare", "scene.png", "pack.png"}).status == 0);
    CHECK(run_strata(folder, {"compare", "pack", "pack.png", "--algorithm", "dual"}).status == 0);  // encoded as PNG
    CHECK(shell(folder,
                "strata render pack/ --algorithm dual -o pack.exr && strata compare pack pack.exr --algorithm dual")
              .status == 0);
    CHECK(run_strata(folder, {"compare", "pack", "pack/expected"}).status == 0);
    for (const std::string& line :
         {std::string{"strata layers pack -o layers.exr"}, std::string{"strata passes pack --algorithm dual -o passes"},
          std::string{"strata explain pack --pixel 10,8"}, std::string{"strata scene pack/manifest.json --json"},
          std::string{"strata golden pack --algorithm dual -o again"}}) {
        INFO(line);
        if (line.find("scene") == std::string::npos) CHECK(shell(folder, line).status == 0);
    }
    // Options on the command line take precedence.
    CHECK(shell(folder,
                "strata render pack --size 8x8 --color-format rgba16f -o small.exr && strata info --digests --json "
                "small.exr")
              .out.find("rgba16f") != std::string::npos);
    CHECK(shell(folder,
                "strata golden teapot --size 12x9 --algorithm dual --color-format rgba16f --back-format rgba8 "
                "--result-format rgba32f -q -o formats && strata render formats -o formats.exr && strata compare "
                "formats formats.exr --exact --algorithm dual && strata compare formats formats.exr")
              .out.find("equal\n") != std::string::npos);
    // A pack made from a pack has the same pictures.
    const auto digest_in = [&](const std::string& pack) {
        const auto manifest = nlohmann::json::parse(content_of(folder / (pack + "/manifest.json")));
        return manifest["results"][0]["picture"]["digest"].get<std::string>();
    };
    CHECK(digest_in("again") == digest_in("pack"));
}

TEST_CASE("golden reports what it cannot do and which byte of a pack has changed") {
    const Folder folder;
    const auto fails = [&](const std::vector<std::string>& words, const std::string& message) {
        const CommandResult ended = run_strata(folder, words);
        CHECK(ended.status == 2);
        CHECK_THAT(ended.err, Contains(message));
    };
    fails({"golden"}, "strata: SCENE is missing; --check PACK needs none");
    fails({"golden", "teapot"}, "strata: -o is missing: the folder for the pack");
    fails({"golden", "teapot", "--check", "x"}, "strata: SCENE has no effect with --check");
    fails({"golden", "--check", "none"}, "none/manifest.json");
    fails({"golden", "teapot", "--profile", "geforce3", "--algorithm", "dual", "-o", "p"},
          "strata: dual: profile geforce3");
    CHECK(folder.files().empty());
    REQUIRE(run_strata(folder, {"golden", "planes:count=1,cells=1", "--size", "8x8", "-o", "p"}).status == 0);
    fails({"golden", "planes:count=1,cells=1", "-o", "p"}, "p: is not empty: expected a new or an empty folder");
    REQUIRE(shell(folder, "printf '\\007' | dd of=p/expected/dual/picture.npy bs=1 seek=200 conv=notrunc").status == 0);
    const CommandResult check = run_strata(folder, {"golden", "--check", "p"});
    CHECK(check.status == 1);
    CHECK_THAT(check.out, Contains("expected/dual/picture.npy: byte 200, row 2, column 2, channel 0: expected ") &&
                              Contains(", found 7"));
    const CommandResult compare = run_strata(folder, {"compare", "p", "p/scene"});
    CHECK(compare.status == 2);
    CHECK_THAT(compare.err, Contains("p/scene: folder: expected ALGORITHM/picture.npy"));
}

TEST_CASE("reversed depth and clip space from 0 to 1 are options of every picture and survive writing and reading") {
    const Folder folder;
    const std::string reversed = "--depth-order greater --clip-depth zero-to-one --size 24x18 --algorithm dual";
    REQUIRE(shell(folder, "strata render teapot " + reversed + " -o r.exr && strata golden teapot " + reversed +
                              " -o pack && strata render pack --algorithm dual -o p.exr")
                .status == 0);
    CHECK(run_strata(folder, {"compare", "r.exr", "p.exr"}).status == 0);
    CHECK(run_strata(folder, {"golden", "--check", "pack"}).status == 0);
    const auto manifest = nlohmann::json::parse(content_of(folder / "pack/manifest.json"));
    CHECK(manifest["state"]["depth_order"] == "greater");
    CHECK_THAT(manifest["command"].get<std::string>(), Contains("--depth-order greater --clip-depth zero-to-one"));
    // The pack's view converted back is the default view: the same picture except where depths tie.
    REQUIRE(shell(folder,
                  "strata render pack --depth-order less --clip-depth minus-one-to-one --algorithm dual -o back.exr && "
                  "strata render teapot --size 24x18 --algorithm dual -o usual.exr")
                .status == 0);
    CHECK(run_strata(folder, {"compare", "back.exr", "usual.exr", "--tolerance", "depth=4"}).status == 0);
}

TEST_CASE("golden and probe end with a summary of what they wrote unless -q is given") {
    const Folder folder;
    const CommandResult pack =
        shell(folder, "strata golden planes:count=2 --size 8x8 --algorithm dual,unsorted -o pack");
    CHECK(pack.status == 0);
    const std::string files = lines_of(shell(folder, "find pack -type f | wc -l").out).at(0);
    CHECK(pack.out.starts_with("pack: " + files + " files, "));
    CHECK(pack.out.find(" of 2 algorithms") != std::string::npos);
    CHECK(shell(folder, "strata golden planes:count=2 --size 8x8 --algorithm dual -q -o quiet").out.empty());
    const CommandResult kit = shell(folder, "strata probe -o kit");
    CHECK(kit.status == 0);
    CHECK(kit.out.starts_with("kit: kit.json and probe.html, "));
    const CommandResult answers = shell(folder, "strata probe --profile geforce8 --unseen 1 -o answers");
    CHECK(answers.out.starts_with("answers: the answers of geforce8 to "));
}

TEST_CASE("nothing is written into a pack that is read") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"golden", "planes:count=1", "--size", "8x8", "-q", "-o", "own"}).status == 0);
    const auto check = [&](const std::vector<std::string>& words, const std::string& message) {
        const CommandResult ended = run_strata(folder, words);
        CHECK(ended.status == 2);
        CHECK_THAT(ended.err, Contains(message));
    };
    for (const char* inside : {"own/inside", "own/expected/../more"})
        for (const char* command : {"golden", "passes"})
            check({command, "own", "-o", inside},
                  std::string("strata: ") + inside +
                      ": is in a pack that this command reads: expected a place outside of it");
    check({"render", "own", "-o", "own/picture.png"}, "strata: own/picture.png: is in a pack that this command reads");
    CHECK(run_strata(folder, {"golden", "--check", "own"}).out == "own: all files match\n");
}
