// Tests the geforce3 profile against captures of an NV2A. hardware_digests.txt holds, for each reproduced capture, the
// digest of its pixels outside the box around its labels (abaire/nxdk_pgraph_tests_golden_results, CC0 1.0). `strata
// hardware-check DIR --digests` wrote it; the captures themselves are not needed.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "pipeline/device/check.h"
#include "tests/support/skip.h"
#include "tools/lab/hardware_check/drawing/compare.h"
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"

using namespace strata;
using namespace strata::hardware_check;

namespace {

struct Row {
    std::string suite, picture, digest;
    rasterizer::Rect labels;
};

std::vector<Row> rows() {
    std::ifstream file{STRATA_HARDWARE_DIGESTS};
    std::vector<Row> all;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words{line};
        Row r;
        words >> r.suite >> r.picture >> r.labels.x0 >> r.labels.y0 >> r.labels.x1 >> r.labels.y1 >> r.digest;
        REQUIRE(words);
        all.push_back(std::move(r));
    }
    return all;
}

const pipeline::DeviceProfile& geforce3() { return *pipeline::find_profile("geforce3"); }

const std::string textures = STRATA_CAPTURES_DIR "/textures";

std::string digest_with(const Row& row, const pipeline::DeviceProfile& profile) {
    const Drawing drawing = draw(*find_suite(row.suite), row.picture, profile, textures);
    if (drawing.reason.starts_with("needs textures/")) {
        strata::test::skip(row.picture + ": " + drawing.reason + "; none in " + textures);
        return row.digest;
    }
    REQUIRE(drawing.picture);
    return digest_outside(row.labels, *drawing.picture);
}

// The first picture of a suite.
Row first_of(const std::string& suite) {
    for (Row& row : rows())
        if (row.suite == suite) return std::move(row);
    FAIL("no digest of suite " << suite);
    return {};
}

}  // namespace

TEST_CASE("geforce3 reproduces every compared pixel of every listed NV2A capture", "[slow]") {
    const std::vector<Row> all = rows();
    CHECK(all.size() >= 379);
    std::string different;
    for (const Row& row : all)
        if (digest_with(row, geforce3()) != row.digest) different += row.suite + "/" + row.picture + " ";
    CHECK(different.empty());
}

TEST_CASE(
    "a profile that rounds positions or depth or coordinates or blending differently does not reproduce the captures") {
    pipeline::DeviceProfile nearest = geforce3();
    nearest.raster.snap = rasterizer::Snap::nearest_even;
    const Row geometry{"Vertex_shader_rounding_tests", "Geometry_0.5624", "", {}};
    CHECK(digest_with(geometry, nearest) != digest_with(geometry, geforce3()));

    pipeline::DeviceProfile exact = geforce3();
    exact.raster.depth_path = rasterizer::DepthPath::exact;
    const Row depth{"Depth_buffer", "DepthFmt_z24_Cn_FZn_Mffffff_ZB", "", {}};
    CHECK(digest_with(depth, exact) != digest_with(depth, geforce3()));

    pipeline::DeviceProfile cut = geforce3();
    cut.blend_rounding = pipeline::BlendRounding::truncate;
    const Row blend = first_of("Blend_tests");
    CHECK(digest_with(blend, cut) != blend.digest);

    pipeline::DeviceProfile planes = geforce3();
    planes.raster.interpolation.texture_coordinates = rasterizer::CoordinateRule::exact_plane;
    for (const Row& row : {Row{"Combiner", "CombinerOps", "", {}}, Row{"Pixel_shader", "ClipPlane", "", {}},
                           Row{"Texture_shadow_comparator", "3F16_10.00-20.00_15.0000_GT", "", {}}})
        CHECK(digest_with(row, planes) != digest_with(row, geforce3()));

    pipeline::DeviceProfile unquantized = geforce3();
    unquantized.raster.hypothesis.quantize_reference = false;
    const Row shadow{"Texture_shadow_comparator", "3P16_10.00-20.00_15.0000_EQ", "", {}};
    CHECK(digest_with(shadow, unquantized) != digest_with(shadow, geforce3()));
}

// Depth codes in the left column of quads whose weights are exact there, from captures of the NV2A, and the world z
// values of the test suite. Exact arithmetic gives 4 for the first, and 16633061, 16726379, 16746512 where the last
// bits of the reciprocal matter.
TEST_CASE("window depths of the fixed-function pipeline are the codes that the chip stored") {
    constexpr std::pair<float, int> at_24_bits[] = {{-6.0f, 8},
                                                    {-5.393292427062988f, 6367072},
                                                    {0.06707406044006348f, 14475595},
                                                    {66.80491638183594f, 16633057},
                                                    {117.76811218261719f, 16726374},
                                                    {139.60948181152344f, 16746509},
                                                    {193.0f, 16777210}};
    for (const auto& [z, word] : at_24_bits) CHECK(static_cast<int>(chip_window_z(z, 16777215.0f)) == word);
}

// The texels of this picture differ from the chip's where a coordinate is exactly on a cell's edge, so it is not in
// the list above.
TEST_CASE("a square with a corner of w = -infinity covers the same pixels as on the chip") {
    const Row row{"W_param", "prog_w_zero_inf__bitri_w-inf", "db40237f2459e2ebc4fd910187e4c6f7", {20, 25, 407, 416}};
    Drawing drawing = draw(*find_suite(row.suite), row.picture, geforce3(), textures);
    REQUIRE(drawing.picture);
    drawing.picture->reading = CaptureFormat::drawn;
    drawing.picture->background = {0x25, 0x11, 0x35, 0xfe};
    CHECK(digest_outside(row.labels, *drawing.picture) == row.digest);
}

TEST_CASE("with all bits of a vertex colour the greys of the capture are not reproduced") {
    pipeline::DeviceProfile all_bits = geforce3();
    all_bits.raster.interpolation.vertex_color_bits = 24;
    const Row row{
        "Depth_buffer", "DepthFmt_z16_Cn_FZn_M00ffff", "2459688bdfd015f99906187c18c29a3a", {20, 25, 107, 116}};
    CHECK(digest_with(row, geforce3()) == row.digest);
    CHECK(digest_with(row, all_bits) != row.digest);  // 28,607 pixels, one unit
}

TEST_CASE("a difference is counted and located and its size compared with the bound") {
    const Drawing drawing = find_suite("Front_face")->draw("FrontFace_CW_CF_B", geforce3());
    REQUIRE(drawing.picture);
    SuitePicture picture = *drawing.picture;
    picture.reading = CaptureFormat::color;
    pipeline::Image capture = picture.image;
    capture.codes[capture.index(7, 9, 2)] += 5;
    capture.codes[capture.index(3, 11, 0)] += 2;
    const std::size_t label = capture.index(600, 11);
    for (std::size_t c = 0; c < 4; ++c) capture.codes[label + c] = c == 3 ? 0 : 255;
    const CaptureComparison found = compare(picture, capture, "capture.png");
    CHECK(found.compared == 640 * 480 - 1);
    CHECK(found.differing == 2);
    CHECK(found.largest == 5);
    CHECK(found.first == std::array{7, 9});
    CHECK(found.histogram == std::map<std::int64_t, std::uint64_t>{{2, 1}, {5, 1}});
    CHECK_FALSE(found.within_bound);
    picture.bound = {2, 5};
    CHECK(compare(picture, capture, "capture.png").within_bound);
    picture.bound = {2, 4};
    CHECK_FALSE(compare(picture, capture, "capture.png").within_bound);
    CHECK(label_box(picture, capture) == rasterizer::Rect{600, 11, 601, 12});

    // A drawing of the test suite over its picture in a colour that the picture does not use is a label, too.
    const std::size_t line = capture.index(7, 9);
    for (std::size_t c = 0; c < 4; ++c) capture.codes[line + c] = c == 2 ? 0 : 255;
    CHECK(compare(picture, capture, "capture.png").differing == 2);
    picture.overdrawn = std::array<std::uint8_t, 4>{255, 255, 0, 255};
    CHECK(compare(picture, capture, "capture.png").differing == 1);
    CHECK(compare(picture, capture, "capture.png").compared == 640 * 480 - 2);
    CHECK(label_box(picture, capture) == rasterizer::Rect{7, 9, 601, 12});
}

TEST_CASE("names that no test has are unknown and names that are not modelled give a reason") {
    CHECK(find_suite("Fog_") == nullptr);
    for (const char* name : {"", "Nonsense", "FrontFace_CW_CF_X", "FrontFace_", "TopLeftRaster_"})
        CHECK(find_suite("Front_face")->draw(name, geforce3()).reason == unknown_name_reason);
    for (const Suite& suite : suites())
        for (const char* name : {"", "_", "_ZB", "C_Depth_y", "z24_", "#spot_", "W_", "AlphaFunc_Enabled", "x-1y",
                                 "ZPassPointSize-0x", "3R16_1", "3F24_--1_1_EQ", "2P16f_1-2_1_XX", "3R16_0-10000_1_EQ",
                                 "2R24_FFFFFFFF-1_1_A", "3P16_-7-20_1_LT", "3P24_1-inf_nan_LT"}) {
            const Drawing drawing = suite.draw(name, geforce3());
            CHECK((drawing.picture || !drawing.reason.empty()));
        }
    const Drawing fixed = find_suite("Shade_model")->draw("FixedLM_Quad_Smooth_First", geforce3());
    CHECK_FALSE(fixed.picture);
    CHECK(fixed.reason != unknown_name_reason);
}

TEST_CASE("the two-dimensional shadow stage of the chip compares r = 0 and ignores the r of the texture coordinates") {
    const auto picture = [](const char* name) {
        return *find_suite("Texture_shadow_comparator")->draw(name, geforce3()).picture;
    };
    CHECK(picture("2R16_100-200_180_GT").image == picture("2R16_100-200_180_N").image);
    CHECK_FALSE(picture("3R16_100-200_180_GT").image == picture("3R16_100-200_180_N").image);
    CHECK(picture("2P24_10.00-20.00_11.4500_EQ").image == picture("2P24_10.00-20.00_11.4500_N").image);
    CHECK(picture("2P24_10.00-20.00_11.4500_LT").image == picture("2P24_10.00-20.00_11.4500_A").image);
}

TEST_CASE("hidden rectangles are excluded from the comparison and the digest") {
    const Row row{"Texture_shadow_comparator", "3R16_100-200_180_EQ", "", {}};
    const SuitePicture drawn = *find_suite(row.suite)->draw(row.picture, geforce3()).picture;
    pipeline::Image capture = drawn.image;
    capture.codes[capture.index(150, 250, 1)] ^= 0x80u;
    CHECK(compare(drawn, capture, "capture.png").differing == 0);
    CHECK(digest_outside({}, drawn, capture) == digest_outside({}, drawn));
    capture.codes[capture.index(150, 234, 1)] ^= 0x80u;
    CHECK(compare(drawn, capture, "capture.png").differing == 1);
    CHECK(digest_outside({}, drawn, capture) != digest_outside({}, drawn));
}

TEST_CASE("a suite whose test loads images names the missing image") {
    const Drawing drawing = find_suite("Pixel_shader")->draw("DotST", geforce3());
    CHECK_FALSE(drawing.picture);
    CHECK(drawing.reason.find("textures/water_bump_map.png") != std::string::npos);
}

TEST_CASE("occlusion queries return the counts of the chip which are 40960 and 49152") {
    const Drawing drawing = find_suite("ZPass_pixel_count")->draw("ZPass", geforce3());
    REQUIRE(drawing.picture);
    CHECK(drawing.picture->reports == std::vector<std::uint64_t>{40960, 49152});
}
