// Tests error messages and exit statuses of the command against those that tools/docs/commands.md documents.
#include <catch2/catch.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

struct Wrong {
    std::vector<std::string> words;
    std::string message;  // the whole message, or its beginning if it ends in "..."
};

bool says(const std::string& err, const std::string& message) {
    if (message.ends_with("...")) return err.starts_with(message.substr(0, message.size() - 3));
    return err == message + "\n";
}

}  // namespace

TEST_CASE("a wrong argument gives exit status 2 and one error message with the expected and similar values") {
    const auto wrong = GENERATE(values<Wrong>({
        {{"rendr", "teapot"},
         "strata: strata has no command 'rendr' (did you mean 'render'?); strata --help lists them"},
        {{"render", "teapot", "--sise", "8x8"},
         "strata: strata render has no option '--sise' (did you mean '--size'?)"},
        {{"render", "teapot", "--sise=8x8"}, "strata: strata render has no option '--sise' (did you mean '--size'?)"},
        {{"render", "teapot", "--size", "12by3"},
         "strata: --size: expected WIDTHxHEIGHT such as 640x480, each from 1 to 16384, found '12by3'"},
        {{"render", "teapot", "--size", "0x3"},
         "strata: --size: expected WIDTHxHEIGHT such as 640x480, each from 1 to 16384, found '0x3'"},
        {{"render", "teapot", "--size", "8x16385"},
         "strata: --size: expected WIDTHxHEIGHT such as 640x480, each from 1 to 16384, found '8x16385'"},
        {{"render", "teapot", "--size"}, "strata: --size needs one WIDTHxHEIGHT"},
        {{"render", "teapot", "--algorithm", "duel"},
         "strata: --algorithm: expected names of algorithms (strata list algorithms shows them) or all, found 'duel' "
         "(did "
         "you mean 'dual'?)"},
        {{"render", "teapot", "--profile", "geforce4"},
         "strata: --profile: name: expected geforce3, geforce8, geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, "
         "softpipe, swiftshader, direct3d11, or a JSON file, found "
         "'geforce4' (did you mean 'geforce3'?)"},
        {{"render", "teapt"},
         "strata: teapt: scene: expected a .gltf, .glb, .obj, .ply, .stl or .off file, a pack's folder, triangles in "
         ".npy or .json, or one of "
         "teapot, volume-beam, random, planes, "
         "shadow-demo, showroom, wireframe, hair, splats, hard, found 'teapt' "
         "(did you mean 'teapot'?)"},
        {{"render", "teapot", "--depth-format", "d25"},
         "strata: --depth-format: expected d16, d24, d32f, d16f or d24f, found 'd25' (did you mean 'd24'?)"},
        {{"render", "teapot", "--depth-format", "d\n24"},
         "strata: --depth-format: expected d16, d24, d32f, d16f or d24f, found 'd\\x0a24' (did you mean 'd24'?)"},
        {{"render", "teapot", "--depth-format", "\xff\xc0\x80\x1b\xf4\x90\x80\x80\xed\xa0\x80\xc3\xa9\xe2\x82"},
         "strata: --depth-format: expected d16, d24, d32f, d16f or d24f, found "
         "'\\xff\\xc0\\x80\\x1b\\xf4\\x90\\x80\\x80\\xed\\xa0\\x80\xc3\xa9\\xe2\\x82'"},
        {{"render", "teapot", "--no-audit=-1"}, "strata: --no-audit takes no value"},
        {{"scene", "teapot", "--json=nan"}, "strata: --json takes no value"},
        {{"render", "teapot", "--tile", "33"},
         "strata: --tile: expected 8, 16, 32, 64 or 128, found '33' (did you mean '32'?)"},
        {{"render", "teapot", "--simd", "avx3"},
         "strata: --simd: expected scalar, avx2, avx512 or best, found 'avx3' (did you mean 'avx2'?)"},
        {{"render", "teapot", "--fragment-memory", "64Q"},
         "strata: --fragment-memory: expected bytes such as 65536, 64M or 1G, found '64Q'"},
        {{"render", "teapot", "--execution", "tile"}, "strata: --execution: expected literal or replay, found 'tile'"},
        {{"render", "teapot", "--reference-path", "rq"},
         "strata: --reference-path: expected window_z, perspective_rq, depth_replace, float32, float32_plane, exact, "
         "w_buffer, logarithmic or packed_rgba8, found 'rq'"},
        {{"render", "teapot", "--compare-epsilon", "2ups"},
         "strata: --compare-epsilon: expected a part of the depth range from 0 to 1 such as 1e-7, or units in the last "
         "place such as 2ulp, found '2ups'"},
        {{"render", "teapot", "--compare-epsilon", "1.5"},
         "strata: --compare-epsilon: expected a part of the depth range from 0 to 1 such as 1e-7, or units in the last "
         "place such as 2ulp, found '1.5'"},
        {{"render", "teapot", "--vertex-path", "fused,double,nv20"},
         "strata: --vertex-path: expected one or two of separate, fused, reassociated, double, toward_zero or nv20, "
         "found 'fused,double,nv20'"},
        {{"render", "teapot", "--depth-range", "0,1.5"},
         "strata: --depth-range: expected two numbers from 0 to 1 such as 0,0.5, found '0,1.5'"},
        {{"render", "teapot", "--depth-range", "nan,1"},
         "strata: --depth-range: expected two numbers from 0 to 1 such as 0,0.5, found 'nan,1'"},
        {{"render", "teapot", "--depth-range", "0"},
         "strata: --depth-range: expected two numbers from 0 to 1 such as 0,0.5, found '0'"},
        {{"render", "teapot", "--polygon-offset", "1"},
         "strata: --polygon-offset: expected two numbers such as 1,1, each from -16777216 to 16777216, found '1'"},
        {{"bench", "teapot", "--execution", "replay,tile"},
         "strata: --execution: expected literal, replay or all, found 'tile'"},
        {{"bench", "teapot", "--repeat", "0"}, "strata: --repeat: expected a whole number from 1, found '0'"},
        {{"bench", "teapot", "--warm-up", "-1"}, "strata: --warm-up: expected seconds from 0 to 3600, found '-1'"},
        {{"bench", "teapot", "--warm-up=1e308"}, "strata: --warm-up: expected seconds from 0 to 3600, found '1e308'"},
        {{"bench", "teapot", "--baseline", "none.json"}, "strata: none.json: ..."},
        {{"render", "teapot", "--threads", "-1"},
         "strata: --threads: expected a whole number from 0 to 1024, found '-1'"},
        {{"render", "teapot", "--threads=-0"}, "strata: --threads: expected a whole number from 0 to 1024, found '-0'"},
        {{"render", "teapot", "--threads=1025"},
         "strata: --threads: expected a whole number from 0 to 1024, found '1025'"},
        {{"render", "teapot", "--polygon-offset=18446744073709551616,0"},
         "strata: --polygon-offset: expected two numbers such as 1,1, each from -16777216 to 16777216, found "
         "'18446744073709551616,0'"},
        {{"render", "teapot", "--alpha", "1,5"},
         "strata: --alpha: expected a number from 0 to 1, or MATERIAL=A with commas between, found '1,5'"},
        {{"render", "teapot", "--alpha", "nan"},
         "strata: --alpha: expected a number from 0 to 1, or MATERIAL=A with commas between, found 'nan'"},
        {{"render", "teapot", "--background", "0,0"},
         "strata: --background: expected none, or three or four numbers from 0 to 1 such as 0.2,0.2,0.3 or 0,0,0,0.5, "
         "found '0,0'"},
        {{"render", "teapot", "--orbit", "30"},
         "strata: --orbit: expected azimuth and elevation in degrees such as 30,20, found '30'"},
        {{"render", "teapot", "--termination", "ratio:2"},
         "strata: --termination: expected exact, paper, any, ratio:R with R from 0 to 1, or fixed:N with N from 1, "
         "found 'ratio:2'"},
        {{"render", "teapot", "--sort", "bucket:0"},
         "strata: --sort: expected bucket:N with N from 1, exact, none, reverse, or shuffle:FRACTION,SEED with a "
         "fraction from 0 to "
         "1, found 'bucket:0'"},
        {{"render", "teapot", "--sort", "shuffle:0.5"}, "strata: --sort: ..."},
        {{"render", "teapot", "--formulation", "printed"},
         "strata: --formulation: expected resolved or published, found 'printed'"},
        {{"render", "volume-beam:slices=2", "--algorithm", "hybrid", "--sorted", "plane"},
         "strata: --sorted: expected a mesh or a material of the scene (planes, cone), found 'plane' (did you mean "
         "'planes'?)"},
        {{"render", "volume-beam:slices=2", "--polygon-offset=-1,-1", "--only", "plane"},
         "strata: --only: expected a mesh or a material of the scene (planes, cone), found 'plane' (did you mean "
         "'planes'?)"},
        {{"render", "showroom", "--polygon-offset=-1,-1", "--only", "sold"},
         "strata: --only: expected a mesh or a material of the scene (strata scene lists them), found 'sold' (did you "
         "mean 'solid'?)"},
        {{"render", "volume-beam:slices=2", "--only", "planes"}, "strata: --only is valid only with --polygon-offset"},
        {{"reproduce", "carr2007", "-o", "page"},
         "strata: PAPER: expected carr2008, everitt2001 or bavoil2008, found 'carr2007' (did you mean 'carr2008'?)"},
        {{"reproduce", "everitt2001"}, "strata: --output is missing; strata reproduce --help says more"},
        {{"render", "teapot", "--orbit", "1,2", "--camera", "x.json"},
         "strata: --orbit and --camera exclude each other"},
        {{"render", "teapot", "--camera", "top"},
         "strata: --camera: expected a .json file (the scene has no camera), found 'top'"},
        {{"render", "teapot", "--camera", "none.json"}, "strata: none.json: ..."},
        {{"render", "teapot", "-o", "out.jpg"},
         "strata: -o: expected a file that ends in .exr or .png, found 'out.jpg'"},
        {{"render", "teapot", "-o", "nowhere/out.png"}, "strata: -o: expected a folder that exists, found nowhere"},
        {{"render"}, "strata: SCENE is missing; strata render --help says more"},
        {{"render", "teapot", "bunny"}, "strata: strata render: unexpected argument 'bunny'"},
        {{"render", "none.glb"}, "strata: none.glb: no such file"},
        {{"info", "--digests", "none.exr"}, "strata: none.exr: no such file"},
        {{"layers", "teapot"}, "strata: ..."},
        {{"layers", "teapot", "-o", "x.exr", "--deep", "x.exr"}, "strata: --deep: 'x.exr' is also the file of -o"},
        {{"layers", "teapot", "-o", "x.exr", "--deep", "./x.exr"}, "strata: --deep: './x.exr' is also the file of -o"},
        {{"render", "teapot", "-o", ""}, "strata: -o needs a file name or -"},
        {{"layers", "teapot", "--deep", ""}, "strata: --deep needs a file name"},
        {{"render", "teapot", "--stats", ""}, "strata: --stats needs a file name or -"},
        {{"render", "teapot", "--camera", ""}, "strata: --camera: expected a camera's name or file, found ''"},
        {{"bench", "teapot", "-o", ""}, "strata: -o needs a file name"},
        {{"bench", "teapot", "--per-effect", "-o", "x.json"},
         "strata: --per-effect goes with neither -o nor --baseline"},
        {{"diagnose", "teapot"}, "strata: CANDIDATE is missing; strata diagnose --help says more"},
        {{"diagnose", "teapot", "a.png", "--suite"}, "strata: --suite has no effect without --list"},
        {{"list"}, "strata: WHAT is missing; strata list --help says more"},
        {{"list", "profile"},
         "strata: WHAT: expected algorithms, profiles or scenes, found 'profile' (did you mean 'profiles'?)"},
        {{"list", "scenes", "teapt"},
         "strata: NAME: expected a built-in scene (teapot, volume-beam, random, planes, "
         "shadow-demo, showroom, wireframe, hair, splats or hard), found 'teapt' (did you mean 'teapot'?)"},
        {{"invariance", "teapot"}, "strata: -o is missing: the folder for the results"},
        {{"invariance", "teapot", "-o", ""}, "strata: -o needs a folder"},
        {{"list", "profiles", "ideel"},
         "strata: --profile: name: expected geforce3, geforce8, geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, "
         "softpipe, swiftshader, direct3d11, or a JSON file, found "
         "'ideel' "
         "(did you mean 'ideal'?)"},
    }));
    const Folder folder;
    const CommandResult ended = run_strata(folder, wrong.words);
    INFO("wanted " << wrong.message << "\nfound  " << ended.err);
    CHECK(ended.status == 2);
    CHECK(says(ended.err, wrong.message));
    CHECK(lines_of(ended.err).size() == 1);
    CHECK(ended.out.empty());
    CHECK(folder.files().empty());
}

TEST_CASE(
    "two outputs that are one file through a linked folder are rejected and a link to a file is replaced by a file") {
    const Folder folder;
    std::filesystem::create_directory(folder / "real");
    std::filesystem::create_directory_symlink("real", folder / "linked");
    const std::vector<std::string> layers{"layers",     "teapot", "--size",     "16x16",
                                          "--no-audit", "-o",     "real/x.exr", "--deep"};
    const auto with = [&](const std::string& deep) {
        auto words = layers;
        words.push_back(deep);
        return run_strata(folder, words);
    };
    const CommandResult same = with("linked/x.exr");
    CHECK(same.status == 2);
    CHECK(same.err == "strata: --deep: 'linked/x.exr' is also the file of -o\n");
    CHECK(std::filesystem::is_empty(folder / "real"));
    std::filesystem::create_symlink("x.exr", folder / "real/y.exr");
    CHECK(with("linked/y.exr").status == 0);
    CHECK(run_strata(folder, {"info", "--digests", "real/x.exr"}).out.find("color") != std::string::npos);
    CHECK(run_strata(folder, {"info", "--digests", "real/y.exr"}).out.find("fragments") != std::string::npos);
}

TEST_CASE(
    "a single algorithm that the profile cannot run gives exit status 2 and one among others a row of the table") {
    const Folder folder;
    const CommandResult alone =
        run_strata(folder, {"render", "teapot", "--size", "16x16", "--algorithm", "dual_independent", "-o", "out.png"});
    CHECK(alone.status == 2);
    CHECK(alone.err.find("ARB_draw_buffers_blend") != std::string::npos);
    CHECK(folder.files().empty());
    const CommandResult among = run_strata(
        folder, {"render", "teapot", "--size", "16x16", "--algorithm", "dual,dual_independent", "-o", "out.png"});
    CHECK(among.status == 0);
    CHECK(among.out.find("refused") != std::string::npos);
    CHECK(folder.files() == std::vector<std::string>{"out.dual.png"});
}

TEST_CASE("a write error gives exit status 3 and leaves no file") {
    const auto words =
        GENERATE(values<std::vector<std::string>>({{"-o", "out.exr"}, {"-o", "out.png"}, {"--stats", "out.json"}}));
    const Folder folder;
    std::vector<std::string> all{"render", "random:seed=3,triangles=300", "--size", "256x256", "--algorithm", "dual"};
    all.insert(all.end(), words.begin(), words.end());
    const CommandResult ended = run_strata(folder, all, {.out = "/dev/null", .max_file_bytes = 600});
    INFO(ended.err);
    CHECK(ended.status == 3);
    CHECK(lines_of(ended.err).size() == 1);
    CHECK(folder.files().empty());
}

TEST_CASE("standard output on a full disk gives exit status 3") {
    const auto verb = GENERATE(as<std::string>{}, "algorithms", "profiles", "scenes");
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"list", verb, "--json"}, {.out = "/dev/full"});
    CHECK(ended.status == 3);
    CHECK(ended.err.starts_with("strata: standard output: "));
}

TEST_CASE("a viewport that the profile lacks is rejected by the depth pass of bench as by render") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"bench", "teapot", "--size", "16384x8", "--profile", "geforce8",
                                                    "--algorithm", "depth", "--repeat", "1", "--warm-up", "0"});
    CHECK(ended.status == 2);
    CHECK(ended.out.find("refused: depth: profile geforce8 has no viewport of 16384 x 8 pixels") != std::string::npos);
}

TEST_CASE("a camera file that is a link to itself is rejected as bad input") {
    const Folder folder;
    std::filesystem::create_symlink("loop", folder / "loop");
    const CommandResult ended = run_strata(folder, {"render", "teapot", "--camera", "loop"});
    CHECK(ended.status == 2);
    CHECK(ended.err == "strata: --camera: expected a .json file (the scene has no camera), found 'loop'\n");
}
