// Tests the options for samples: the expected error messages are written by hand, and the command that a picture
// records must draw it again.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "scenes/files/image_io.h"
#include "tests/tools/program.h"

using namespace strata::test;

TEST_CASE("numbers of samples are rejected by name and --sample where it would have no meaning") {
    struct Wrong {
        std::vector<std::string> words;
        std::string message;
    };
    const auto wrong = GENERATE(values<Wrong>({
        {{"render", "teapot", "--samples", "3"}, "--samples: expected 1, 2, 4 or 8, found '3'"},
        {{"render", "teapot", "--samples", "8", "--profile", "geforce3"},
         "dual: profile geforce3 has no 8 samples per pixel (ARB_multisample); use geforce8, "
         "geforce8_dx101, ideal or direct3d11"},
        {{"render", "teapot", "--samples", "2", "--sample", "1", "--profile", "llvmpipe"},
         "profile llvmpipe has no 2 samples per pixel (ARB_multisample); use geforce3, "
         "geforce8, geforce8_dx101, ideal or direct3d11"},
        {{"render", "teapot", "--samples", "4", "--sample", "4"},
         "--sample: expected a number from 0 to 3 with --samples 4, found 4"},
        {{"render", "teapot", "--samples", "2", "--resolve", "quincunx"},
         "dual: profile geforce8 has no Quincunx filter of 2 samples (NV_multisample_filter_hint); use --profile "
         "geforce3 with --samples 2"},
        {{"render", "teapot", "--samples", "2", "--sample", "0", "--resolve", "quincunx", "--profile", "geforce3"},
         "--resolve is valid only without --sample: one sample is not resolved"},
        {{"explain", "teapot", "--samples", "4", "--pixel", "3,3", "--svg", "a.svg"},
         "--svg shows one sample: add --sample N"},
        {{"report", "teapot", "--samples", "2", "--load-sample", "resolved", "-o", "r"},
         "a report cannot show --load-sample or --composite-sample resolved; use own or 0"},
        {{"report", "teapot", "--samples", "8", "--profile", "geforce3", "-o", "r"},
         "--samples: profile geforce3 has no 8 samples per pixel (ARB_multisample)"},
    }));
    const Folder folder;
    const CommandResult ended = run_strata(folder, wrong.words);
    CHECK(ended.status == 2);
    const std::vector<std::string> lines = lines_of(ended.err);
    CHECK((!lines.empty() && lines.back().starts_with("strata: " + wrong.message.substr(0, 20))));
    CHECK(ended.err.find(wrong.message) != std::string::npos);
}

TEST_CASE("a picture records its samples and its command draws it again") {
    const Folder folder;
    for (const std::string samples : {"--samples 4", "--samples 4 --sample 2", "--samples 2 --resolve quincunx"}) {
        const std::string device = samples.ends_with("x") ? " --profile geforce3 --algorithm depth_units " : " ";
        CHECK(shell(folder, "strata render teapot --alpha 0.5 --size 32x24 -q --no-audit -o a.exr " + samples + device)
                  .status == 0);
        CHECK(shell(folder, "strata info a.exr").out.find(samples) != std::string::npos);
        CHECK(shell(folder, "strata render --from a.exr -q --no-audit -o b.exr").status == 0);
        CHECK(shell(folder, "strata compare a.exr b.exr").status == 0);
        CHECK(shell(folder, "rm a.exr b.exr").status == 0);
    }
}

TEST_CASE("a pack of one sample has its shading and coverage and passes and explain take them") {
    const Folder folder;
    const std::string of_sample = " --size 24x18 -q --samples 4 --sample 1 --algorithm front_to_back ";
    for (const std::string shading : {" --shading pixel", " --shading pixel --interpolate centroid",
                                      " --alpha-to-coverage --sample-coverage 0.75 --sample-mask 14"}) {
        const std::string options = of_sample + shading + " --alpha 0.5 --max-passes 9 ";
        CHECK(shell(folder, "strata golden teapot -o pack" + options).status == 0);
        CHECK(shell(folder, "strata golden --check pack").status == 0);
        CHECK(shell(folder, "strata render teapot --no-audit -o a.exr" + options).status == 0);
        CHECK(shell(folder, "strata render pack --algorithm front_to_back -q --no-audit -o b.exr").status == 0);
        CHECK(shell(folder, "strata compare a.exr b.exr").status == 0);
        CHECK(shell(folder, "strata render teapot --no-audit -o c.exr --alpha 0.5 --max-passes 9" + of_sample).status ==
              0);
        CHECK(shell(folder, "strata compare a.exr c.exr").status == 1);
        const std::string pixel = shell(folder, "strata explain teapot --pixel 12,9 --json" + options).out;
        CHECK(pixel == shell(folder, "strata explain pack --pixel 12,9 -q --algorithm front_to_back --json").out);
        CHECK(pixel !=
              shell(folder, "strata explain teapot --pixel 12,9 --json --alpha 0.5 --max-passes 9" + of_sample).out);
        CHECK(shell(folder, "rm -r pack a.exr b.exr c.exr").status == 0);
    }
}

TEST_CASE("passes of all samples have targets of all samples and end with the resolved picture") {
    const Folder folder;
    for (const std::string more : {"", "--shading pixel --load-sample 0 --composite-sample resolved"}) {
        const std::string options = " --size 24x18 -q --samples 4 --alpha 0.5 --algorithm front_to_back " + more;
        CHECK(shell(folder, "strata passes teapot -o p" + options).status == 0);
        const auto passes = nlohmann::json::parse(shell(folder, "cat p/passes.json").out).at("passes");
        const auto stats = nlohmann::json::parse(shell(folder, "strata render teapot --stats -" + options).out);
        for (const auto& pass : passes)
            for (const auto& target : pass.at("targets"))
                CHECK(target.at("samples") == (pass.at("kind") == "published" ? 1 : 4));
        CHECK(passes.back().at("targets").at(0).at("digest") == stats.at(0).at("digest").at("color"));
        CHECK(shell(folder, "rm -r p").status == 0);
    }
}

TEST_CASE("a pack of all samples is the default of options and its command makes it again") {
    const Folder folder;
    for (const std::string more : {"--samples 2", "--samples 4 --shading pixel --interpolate centroid --load-sample 0",
                                   "--samples 4 --alpha-to-coverage --sample-mask 14"}) {
        const std::string options = " --size 24x18 -q --alpha 0.5 --algorithm front_to_back " + more;
        CHECK(shell(folder, "strata golden teapot -o pack" + options).status == 0);
        CHECK(shell(folder, "strata golden --check pack").status == 0);
        CHECK(shell(folder, "strata render teapot --no-audit -o a.exr" + options).status == 0);
        CHECK(shell(folder, "strata render pack --algorithm front_to_back -q --no-audit -o b.exr").status == 0);
        CHECK(shell(folder, "strata compare a.exr b.exr").status == 0);
        const auto manifest = nlohmann::json::parse(shell(folder, "cat pack/manifest.json").out);
        CHECK(shell(folder, manifest.at("command").get<std::string>() + " -q -o again").status == 0);
        CHECK(shell(folder, "diff -r pack again").status == 0);
        CHECK(shell(folder, "strata render --from b.exr -q --no-audit -o c.exr").status == 0);
        CHECK(shell(folder, "strata compare a.exr c.exr").status == 0);
        CHECK(shell(folder, "strata compare pack again").status == 0);
        CHECK(shell(folder, "strata passes pack -q -o p --algorithm front_to_back").status == 0);
        CHECK(shell(folder, "rm -r pack again p a.exr b.exr c.exr").status == 0);
    }
}

// Three planes of one pixel's fragments, and three fragments at one depth, cover every sample of the middle.
TEST_CASE("maps add the fragments of all samples and compare resolved pictures") {
    const Folder folder;
    const auto legend_of = [&](const std::string& options) {
        return shell(folder, "strata render --size 32x24 --no-audit -o m.png --samples 4 " + options).err;
    };
    CHECK(legend_of("planes:count=3 --algorithm dual --map depth-complexity") ==
          "depth-complexity: black is 0, white is 12\n");
    CHECK(legend_of("hard:case=coincident --algorithm dual --map ties") == "ties: black is 0, white is 12\n");
    CHECK(legend_of("planes:count=3 --algorithm a_buffer --map error") == "error: black is 0, white is 0 of 255\n");
    CHECK(legend_of("teapot --algorithm weighted_average --map error") != "error: black is 0, white is 0 of 255\n");
}

TEST_CASE("deep layers have a part for each sample which is the deep file of that sample alone") {
    const Folder folder;
    const std::string options = " --size 20x15 -q --no-audit --samples 4 --algorithm front_to_back ";
    CHECK(shell(folder, "strata layers teapot --deep all.exr -o layers.exr" + options).status == 0);
    const auto samples = strata::scenes::read_deep_samples(folder / "all.exr");
    REQUIRE(samples.size() == 4);
    for (std::size_t s = 0; s < 4; ++s) {
        CHECK(shell(folder, "strata layers teapot --deep one.exr --sample " + std::to_string(s) + options).status == 0);
        CHECK(samples[s] == strata::scenes::read_deep(folder / "one.exr"));
        CHECK(shell(folder, "rm one.exr").status == 0);
    }
    CHECK_FALSE(samples[0] == samples[1]);
    CHECK(shell(folder, "strata compare all.exr all.exr").status == 0);
    CHECK(shell(folder, "strata info all.exr").out.find("sample.3") != std::string::npos);
}

TEST_CASE("a pack of one sample draws that sample") {
    const Folder folder;
    const std::string options = " --size 24x18 -q --samples 2 --sample 0 --algorithm front_to_back ";
    CHECK(shell(folder, "strata golden teapot -o pack" + options).status == 0);
    CHECK(shell(folder, "strata golden --check pack").status == 0);
    CHECK(shell(folder, "strata render teapot --no-audit -o a.exr" + options).status == 0);
    CHECK(shell(folder, "strata render pack --algorithm front_to_back -q --no-audit -o b.exr").status == 0);
    CHECK(shell(folder, "strata compare a.exr b.exr").status == 0);
    CHECK(shell(folder, "strata render teapot --size 24x18 -q --no-audit --algorithm front_to_back -o c.exr").status ==
          0);
    CHECK(shell(folder, "strata compare a.exr c.exr").status == 1);
}
