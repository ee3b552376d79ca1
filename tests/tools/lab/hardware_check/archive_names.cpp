#include "tests/tools/lab/hardware_check/archive_names.h"

#include <fmt/format.h>

namespace strata::hardware_check {
namespace {

Names with(const Names& starts, const Names& ends) {
    Names all;
    for (const std::string& start : starts)
        for (const std::string& end : ends) all.push_back(start + end);
    return all;
}

const Names or_depth{"", "_ZB"},
    surfaces{"X_Z1RGB5", "X_O1RGB5", "R5G6B5", "X_ZRGB8", "X_ORGB8", "XA_Z1A7RGB8", "XA_O1A7RGB8", "ARGB8"};
const Names factors{"0",      "1",        "srcRGB",  "1-srcRGB", "srcA",   "1-srcA", "dstA", "1-dstA",
                    "dstRGB", "1-dstRGB", "srcAsat", "cRGB",     "1-cRGB", "cA",     "1-cA"};
const Names equations{"ADD", "SUB", "REVSUB", "MIN", "MAX", "SADD", "SREVSUB"};

// `steps` clear values from `max` downwards.
Names cleared(const std::string& start, std::uint32_t max, std::uint32_t steps) {
    Names all;
    for (const char* const compressed : {"n", "y"})
        for (std::uint32_t i = 0; i <= steps; ++i)
            all.push_back(fmt::format(fmt::runtime(start), compressed, max - i * (max / steps)));
    return all;
}

void add(Archive& archive, Outcome outcome, std::string_view suite, Names names, std::size_t count) {
    archive.push_back({outcome, suite, std::move(names), count});
}

void add_fragment_suites(Archive& archive) {
    const Names funcs{"Never",    "LessThan",           "Equal", "LessThanOrEqual", "GreaterThan",
                      "NotEqual", "GreaterThanOrEqual", "Always"};
    add(archive, Outcome::drawn, "Alpha_func", with(with({"AlphaFunc"}, funcs), {"_Enabled", "_Disabled"}), 16);
    const Names stencil{"Never", "Less", "Equal", "LessThanOrEqual", "Greater", "NotEqual", "GreaterThanOrEqual",
                        "Always"};
    add(archive, Outcome::drawn, "Stencil_func", with(stencil, or_depth), 16);
    add(archive, Outcome::drawn, "Stencil",
        with(with({"Stencil_ZERO", "Stencil_REPLACE"}, {"", "_ST", "_DT", "_ST_DT"}), or_depth), 16);
    Names blend = with({"#spot_"}, with(factors, with({"_"}, equations)));
    for (const std::string& name : with(with(with(factors, {"_"}), with(equations, {"_"})), factors))
        blend.push_back(name);
    add(archive, Outcome::drawn, "Blend_tests", blend, 1673 + 7);  // 0_..._0 is omitted upstream
    add(archive, Outcome::drawn, "Blend_surface", with({"DstAlpha_", "1-DstAlpha_"}, surfaces), 16);
    add(archive, Outcome::drawn, "Blend_surface", with(surfaces, {"_Add_SrcA_1-SrcA", "_Add_SrcA_DstA"}), 16);
    add(archive, Outcome::drawn, "Color_mask_blend", {"C00010101_O32774_S772_D0"}, 1);
    const Names masks{"C00000000", "C00000001", "C00000100", "C00010000", "C01000000", "C01010101"};
    add(archive, Outcome::drawn, "Clear", with(with(masks, {"_Depth_y", "_Depth_n"}), or_depth), 24);
    add(archive, Outcome::drawn, "Clear",
        {"SFC_A8R8G8B8", "SFC_X1R5G5B5_Z1R5G5B5", "SCF_X1R5G5B5_O1R5G5B5", "SCF_R5G6B5", "SCF_X8R8G8B8_Z8R8G8B8",
         "SCF_X8R8G8B8_O8R8G8B8", "SCF_X1A7R8G8B8_Z1A7R8G8B8", "SCF_X1A7R8G8B8_O1A7R8G8B8"},
        8);
}

// Surfaces of several samples per pixel.
void add_sample_suites(Archive& archive) {
    const Names created = with({"CreateSurfaceWith"}, {"Center1", "CenterCorner2", "SquareOffset4"});
    add(archive, Outcome::drawn, "Antialiasing_tests", created, 3);
    add(archive, Outcome::drawn, "Antialiasing_tests",
        {"FBSurfaceWithCenter1", "FBSurfaceWithCenterCorner2", "AAOnThenOffCPUWrite", "CPUWriteIgnoresSurfaceConfig",
         "FramebufferNotModifiedBySurfaceState", "NonAACPURoundTrip", "SurfaceStatesAreIndependent"},
        7);
    add(archive, Outcome::not_modelled, "Antialiasing_tests", {"GPUAAWriteAfterCPUWrite"}, 1);
    const Names commands{"", "-inlinebuf", "-inlinearrays", "-inlineelements"};
    const Names filled = with({"Triangles", "TriStrip", "TriFan", "Quads", "QuadStrip", "Polygon"}, commands);
    add(archive, Outcome::drawn, "3D_primitive", with(filled, {"", "-ls", "-ps", "-ls-ps"}), 96);
    const Names others = with({"Points", "Lines", "LineLoop", "LineStrip"}, commands);
    add(archive, Outcome::drawn, "3D_primitive", with(others, {"", "-ls", "-ps", "-ls-ps"}), 64);
    add(archive, Outcome::drawn, "Stipple_tests",
        {"Checkered_Off", "Checkered_On", "Zero_On", "Border_On", "Alternating_On"}, 5);
    add(archive, Outcome::drawn, "Point_params",
        with({"PointParamsOff_SmoothOff_128", "PointParamsOn_SmoothOn_128", "PointParamsOn_SmoothOff_128", "Detailed"},
             {"_FF", "_VS"}),
        8);
    add(archive, Outcome::drawn, "Point_params", {"PointParamsOn_SmoothOn_001_FF"}, 1);
    const Names constants{"Scale_0_", "Scale_4_"}, distances{"0_0", "1_0", "0_1", "1_1"};
    add(archive, Outcome::drawn, "Point_params", with(with(constants, distances), {"_FF", "_VS"}), 16);
}

void add_depth_suites(Archive& archive) {
    const std::string zb = "_ZB", wide = "DepthFmt_";
    for (const std::string& end : {std::string{}, zb}) {
        add(archive, Outcome::drawn, "Depth_buffer", cleared(wide + "z16_C{}_FZn_M{:06x}" + end, 0xffff, 48), 98);
        add(archive, Outcome::drawn, "Depth_buffer", cleared(wide + "z24_C{}_FZn_M{:06x}" + end, 0xffffff, 48), 98);
        add(archive, Outcome::drawn, "Depth_buffer", cleared(wide + "z16_C{}_FZy_M{:06x}" + end, 0xffff, 48), 98);
        add(archive, Outcome::drawn, "Depth_buffer", cleared(wide + "z24_C{}_FZy_M{:06x}" + end, 0xfeffff, 48), 98);
        const std::string_view fixed = "Depth_buffer_fixed_function";
        add(archive, Outcome::drawn, fixed, cleared("z16_C{}_FZn_M{:06x}" + end, 0xffff, 4), 10);
        add(archive, Outcome::drawn, fixed, cleared("z24_C{}_FZn_M{:06x}" + end, 0xffffff, 4), 10);
        add(archive, Outcome::drawn, fixed, cleared("z16_C{}_FZy_M{:06x}" + end, 0xffff, 4), 10);
        add(archive, Outcome::not_modelled, "Depth_buffer_fixed_function",
            cleared("z24_C{}_FZy_M{:06x}" + end, 0xfeffff, 4), 10);
    }
    add(archive, Outcome::drawn, "Depth_function", {"DepthFunc", "DepthFunc_ZB"}, 2);
    const Names flags = with(with({"_FR0", "_FR1"}, {"_VSH0", "_VSH1"}), {""});
    add(archive, Outcome::drawn, "Depth_Clamp", with({"depth_clamp_W0_C0_ZB0", "depth_clamp_W0_C1_ZB0"}, flags), 8);
    const Names others{"depth_clamp_W0_C0_ZB1", "depth_clamp_W0_C1_ZB1", "depth_clamp_W1_C0_ZB0",
                       "depth_clamp_W1_C1_ZB0", "depth_clamp_W1_C0_ZB1", "depth_clamp_W1_C1_ZB1"};
    add(archive, Outcome::drawn, "Depth_Clamp", with(others, flags), 24);
    const Names offsets{"_Ofs0.685", "_Ofs0.822", "_Ofs3.015", "_Ofs3.216"};
    add(archive, Outcome::drawn, "Depth_Clamp", with({"depth_equal", "depth_equal_WBuf"}, offsets), 8);
    Names zpass{"ZPass"};
    for (const int n : {0, 1, 4, 7, 8, 9, 15, 16, 64, 255, 256, 504, 511})
        zpass.push_back(fmt::format("ZPassPointSize-0x{:04X}", n));
    for (const int n : {0, 1, 4, 7, 8, 9, 15, 16, 64, 255, 256, 504, 505, 511, 512, 513})
        zpass.push_back(fmt::format("ZPassPointSizeVS-0x{:04X}", n));
    for (const int n : {0, 1, 4, 8, 15, 16, 64, 255, 504}) zpass.push_back(fmt::format("ZPassLineWidth-0x{:04X}", n));
    add(archive, Outcome::drawn, "ZPass_pixel_count", with(zpass, or_depth), 78);
}

void add_geometry_suites(Archive& archive) {
    const Names shifts{"0.0000", "0.0010", "0.4999", "0.5000", "0.5624", "0.5625", "0.5626", "0.9990", "1.0000"};
    const std::string_view rounding = "Vertex_shader_rounding_tests";
    add(archive, Outcome::drawn, rounding,
        with({"Geometry_", "AdjacentGeometry_", "ProjAdjacentGeometry_", "GeometrySubscreen_"}, shifts), 36);
    add(archive, Outcome::drawn, rounding, {"TopLeftRaster", "TopLeftRaster_Fixed"}, 2);
    add(archive, Outcome::not_modelled, rounding, with({"GeometrySuperscreen_"}, shifts), 9);
    add(archive, Outcome::not_modelled, rounding, {"RenderTarget", "Compositing_-4", "Compositing_2"}, 3);
    const Names primitives{"_Tri", "_TriStrip", "_TriFan", "_Quad", "_QuadStrip", "_Poly"};
    const Names kinds = with(primitives, {"_Flat_First", "_Flat_Last", "_Smooth_First", "_Smooth_Last"});
    add(archive, Outcome::drawn, "Shade_model", with({"Prog"}, kinds), 24);
    add(archive, Outcome::drawn, "Shade_model", with({"Fixed", "FixedTex", "W_Fixed", "W_FixedTex", "ProgTex"}, kinds),
        120);
    add(archive, Outcome::drawn, "Shade_model", with({"ProgLM"}, kinds), 24);
    const Names offsets{"0.000_0.000",   "0.531_0.531", "0.562_0.562",  "-0.531_-0.531",
                        "-0.438_-0.438", "1.000_1.000", "-1.000_-1.000"};
    add(archive, Outcome::drawn, "Viewport", with(offsets, {"-0.000_0.000", "-2.000_0.000"}), 14);
    const Names clips{"x0y0_w512h384",  "x16y8_w512h384",  "x0y0_w640h480",
                      "x8y16_w632h464", "x0y240_w640h240", "x320y240_w320h240"};
    const Names layouts{"", "_A8R8G8B8", "_B8", "_G8B8"};
    add(archive, Outcome::drawn, "Surface_clip", with(clips, layouts), 24);
    add(archive, Outcome::not_modelled, "Surface_clip", with({"x0y0_w0h0"}, layouts), 4);
    add(archive, Outcome::not_modelled, "Surface_clip", with({"rt_"}, clips), 6);
    add(archive, Outcome::not_modelled, "Surface_clip", {"XemuBug420", "DebugTextShouldClip"}, 2);
    const Names faces = with({"CW", "CCW", "0x00", "0x63"}, {"_CF_F", "_CF_B", "_CF_FaB"});
    add(archive, Outcome::drawn, "Front_face", with({"FrontFace_", "FrontFace_FM_", "FrontFace_LM_"}, faces), 36);
    const Names first{"x0y0_w0h0",     "x0y0_w256h256", "x8y16_w3840h3840", "x0y0_w255h255",
                      "x1y1_w254h254", "x1y1_w253h253", "x0y0_w128h128",    "x0y0_w1h1",
                      "x255y255_w1h1", "x256y256_w1h1", "x96y96_w64h64"};
    Names regions = with(with({"I_", "E_"}, first), {"-x0y0_w0h0", "-x16y16_w8h8"});
    regions.insert(regions.end(), {"sI_x60y60_w64h64-x0y0_w64h64", "sE_x60y60_w64h64-x0y0_w64h64"});
    add(archive, Outcome::drawn, "Window_clip", regions, 46);
    add(archive, Outcome::drawn, "Window_clip", with({"r"}, regions), 46);
    add(archive, Outcome::drawn, "Texture_perspective",
        with(with({"tex_tex_pers_", "tex_diff_pers_"}, {"y_", "n_"}), {"quad", "bitri"}), 8);
}

void add_range_suites(Archive& archive) {
    const Names formats{"16D_", "16F_", "24D_", "24F_"},
        offsets{"_V1_ZB0_ZS0", "_V1_ZB0_ZS1", "_V1_ZB1_ZS0", "_V1_ZB1_ZS1"};
    const Names shapes{"FloorQuad", "RoofQuad", "WallQuad", "LargeZ", "TriH", "TriV"};
    const Names z = with(with(with({"ZBuf"}, formats), shapes), offsets), flat{"_V1_ZB0_ZS0_ZB", "_V1_ZB1_ZS0_ZB"};
    add(archive, Outcome::drawn, "W_buffering", with(z, {"_ZB"}), 96);
    add(archive, Outcome::drawn, "W_buffering", z, 96);  // colours
    const Names w = with(with(with({"WBuf"}, formats), shapes), offsets);
    add(archive, Outcome::drawn, "W_buffering", w, 96);  // colours
    add(archive, Outcome::drawn, "W_buffering", with(with(with({"WBuf"}, formats), shapes), flat), 48);
    const Names wide{"FloorQuad", "RoofQuad", "WallQuad", "LargeZ"}, sloped{"_V1_ZB0_ZS1_ZB", "_V1_ZB1_ZS1_ZB"};
    add(archive, Outcome::drawn, "W_buffering", with(with(with({"WBuf"}, formats), wide), sloped), 32);
    add(archive, Outcome::not_modelled, "W_buffering", with(with(with({"WBuf"}, formats), {"TriH", "TriV"}), sloped),
        16);
    const Names buffers{"ZBuf", "WBuf"}, settings{"_ZB0_ZS0", "_ZB0_ZS1", "_ZB1_ZS0", "_ZB1_ZS1"};
    const Names floor = with(with(with(buffers, formats), {"FloorQuad_V0"}), settings);
    add(archive, Outcome::drawn, "W_buffering", with(floor, or_depth), 64);
    const Names lines = with(with(with(buffers, formats), {"LineStrip"}), offsets);
    add(archive, Outcome::drawn, "W_buffering", with(lines, or_depth), 64);
    add(archive, Outcome::drawn, "W_buffering",
        with({"WBuf24D_Riddick", "ZBuf24D_Trunc0", "ZBuf24D_TruncNeg"}, {"_V1_ZB0_ZS0", "_V1_ZB0_ZS0_ZB"}), 6);
    const Names floors{"-150-032", "-150-128", "-150-224"}, walls{"-159-000", "-261-000", "-363-000"};
    add(archive, Outcome::drawn, "W_buffering", with(with({"WBuf24D_ClipF"}, floors), {"_V1_ZB0_ZS1"}), 3);
    add(archive, Outcome::not_modelled, "W_buffering", with(with({"WBuf24D_ClipF"}, floors), {"_V1_ZB0_ZS1_ZB"}), 3);
    add(archive, Outcome::drawn, "W_buffering", with(with({"WBuf24D_ClipW"}, walls), {"_V1_ZB0_ZS1", "_V1_ZB0_ZS1_ZB"}),
        6);

    const Names multiples{"0.00",  "-0.00",     "1.00",      "-1.00",     "inf",       "-inf",      "0.50",
                          "-0.50", "-3.08e-33", "-9.63e-35", "-1.50e-36", "-7.52e-37", "-3.76e-37", "-1.88e-37"};
    add(archive, Outcome::drawn, "W_param", with({"prog_w_zero_inf__quad_w", "prog_w_zero_inf__bitri_w"}, multiples),
        28);
    add(archive, Outcome::not_modelled, "W_param",
        {"ff_w_zero_inf__quad_w0.00", "rcc_w_zero_inf__z0.25", "w_gaps", "w_pos_strip_tex_persp"}, 4);
    const Names modes = with({"", "WBuf_"}, with({"", "NEARFAR_"}, with({"ZCULL", "ZCLAMP"}, {"", "_IgnW"})));
    add(archive, Outcome::drawn, "ZMinMaxControl", with({"Ctrl_"}, modes), 16);
    add(archive, Outcome::drawn, "ZMinMaxControl", with({"CtrlFixed_"}, modes), 16);
}

void add_texture_suites(Archive& archive) {
    const Names funcs{"_N", "_GT", "_EQ", "_GE", "_LT", "_NE", "_LE", "_A"}, stages{"2", "3"};
    const Names raw{"R16_0-FFFF_7FFF",     "R16_0-100_80", "R16_100-200_180",
                    "R24_0-FFFFFF_7FFFFF", "R24_0-100_80", "R24_100-200_180"};
    const Names both{"16_-6.00-193.00_5.9400", "16_10.00-20.00_15.0000", "16f_-6.00-193.00_4.5669",
                     "16f_10.00-20.00_14.0400", "24_-6.00-193.00_10.6500"};
    const std::string_view shadow = "Texture_shadow_comparator";
    add(archive, Outcome::drawn, shadow, with(with(stages, raw), funcs), 96);
    add(archive, Outcome::drawn, shadow, with(with(with(stages, {"F", "P"}), both), funcs), 160);
    add(archive, Outcome::drawn, shadow,
        with(with(stages, {"F24_10.00-20.00_11.4700", "P24_10.00-20.00_11.4500"}), funcs), 32);
    add(archive, Outcome::drawn, "Combiner", {"CombinerOps", "Flags", "Mux", "SpecialInputs"}, 4);
    add(archive, Outcome::not_modelled, "Combiner",
        {"AlphaFromBlue", "ColorAlphaIndependence", "Independence", "SignedCombinerOps", "SignedPassThroughPipeline",
         "SignedToUnsignedMapping", "UnboundTexSampler"},
        7);
    add(archive, Outcome::drawn, "Pixel_shader", {"ClipPlane", "Passthru"}, 2);
    add(archive, Outcome::not_modelled, "Pixel_shader",  // the first two need image files of the test suite
        {"DotZW", "DotST", "BumpEnvMap", "BumpEnvMapLuminance", "StageDependentAlphaRed", "StageDependentGreenBlue"},
        6);
}

void add_vertex_suites(Archive& archive) {
    const Names floats{"0_1",      "-1_1",     "-8_1",       "0_8",          "-NaNq_NaNq", "-NaNs_NaNs",
                       "-INF_INF", "-Max_Max", "-MinN_MinN", "-MaxSN_MaxSN", "-Min_Min"};
    add(archive, Outcome::drawn, "Attrib_float", floats, 11);
    const Names attributes{"w", "n", "d", "s", "fc", "ps", "bd", "bs", "t0", "t1", "t2", "t3"},
        endings{"0.1_0.0_1.0_1.0-da", "0.8_0.0_0.0_1.0-ib", "0.5_0.0_0.0_1.0-ia", "0.2_0.0_0.6_1.0-ie"};
    add(archive, Outcome::drawn, "Attrib_carryover", with(with({"L-", "T-"}, attributes), endings), 96);
    Names swizzles{"Control", "ControlNA"};
    for (int n = 0; n < 17; ++n) swizzles.push_back(fmt::format("Mov{:02}", n));
    for (int n = 0; n < 10; ++n) swizzles.push_back(fmt::format("NAMov{:02}", n));
    add(archive, Outcome::drawn, "Vertex_shader_swizzle_tests", swizzles, 29);
    add(archive, Outcome::drawn, "SetVertexData",
        with({"SET_VERTEX_DATA"}, {"2F_M", "4F_M", "2S-0001", "2S-7FFF", "4S_M-0001", "4S_M-7FFF"}), 6);
    add(archive, Outcome::not_modelled, "SetVertexData", {"SET_VERTEX_DATA4UB"}, 1);
}

}  // namespace

Archive archive_names() {
    Archive archive;
    add_fragment_suites(archive);
    add_sample_suites(archive);
    add_depth_suites(archive);
    add_geometry_suites(archive);
    add_range_suites(archive);
    add_texture_suites(archive);
    add_vertex_suites(archive);
    return archive;
}

}  // namespace strata::hardware_check
