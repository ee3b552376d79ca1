// Checks for every name of the archive whether it is drawn or not modelled, and that its picture depends on the name
// alone. A profile without any depth format is rejected by every surface after the name is parsed and before anything
// is drawn, so parsing is tested without drawing.
#include <catch2/catch.hpp>

#include "pipeline/device/check.h"
#include "tests/tools/lab/hardware_check/archive_names.h"
#include "tools/lab/hardware_check/drawing/compare.h"
#include "tools/lab/hardware_check/drawing/suite.h"

using namespace strata;
using namespace strata::hardware_check;

namespace {

Outcome outcome_of(const Suite& suite, const std::string& name) {
    pipeline::DeviceProfile nothing = *pipeline::find_profile("geforce3");
    nothing.has_d16 = nothing.has_d24 = nothing.has_d16f = nothing.has_d24f = false;
    try {
        return suite.draw(name, nothing).reason == unknown_name_reason ? Outcome::unknown : Outcome::not_modelled;
    } catch (const pipeline::Refused&) {
        return Outcome::drawn;
    }
}

// The names whose outcome is not `expected`.
std::string with_other_outcome(Outcome expected, std::string_view suite, const Names& names) {
    std::string otherwise;
    for (const std::string& name : names)
        if (outcome_of(*find_suite(suite), name) != expected) otherwise += std::string{suite} + "/" + name + " ";
    return otherwise;
}

// The digest of the picture that geforce3 draws for a name, or the reason why there is none.
std::string drawn_or_reason(std::string_view suite, const std::string& name) {
    const Drawing drawing = find_suite(suite)->draw(name, *pipeline::find_profile("geforce3"));
    return drawing.picture ? digest_outside({}, *drawing.picture) : drawing.reason;
}

}  // namespace

TEST_CASE("every name of the archive is drawn or reported as not modelled") {
    std::string otherwise;
    std::size_t names = 0;
    for (const NameGroup& group : archive_names()) {
        INFO(group.suite << " " << group.names.front());
        CHECK(group.names.size() == group.count);
        otherwise += with_other_outcome(group.outcome, group.suite, group.names);
        names += group.names.size();
    }
    CHECK(otherwise == "");
    CHECK(names >= 3600);
}

// Each name is drawn twice, with all other names drawn in between in the opposite order.
TEST_CASE("every picture of the archive is drawn completely and depends on its name alone", "[exhaustive]") {
    const Archive archive = archive_names();
    std::vector<std::string> first;
    std::string without_reason, different;
    std::size_t drawn = 0;
    for (const NameGroup& group : archive)
        for (const std::string& name : group.names) {
            first.push_back(drawn_or_reason(group.suite, name));
            if (group.outcome == Outcome::drawn) ++drawn;
            if (first.back().empty()) without_reason += name + " ";
        }
    std::size_t i = first.size();
    for (auto group = archive.rbegin(); group != archive.rend(); ++group)
        for (auto name = group->names.rbegin(); name != group->names.rend(); ++name)
            if (drawn_or_reason(group->suite, *name) != first[--i]) different += *name + " ";
    CHECK(without_reason == "");
    CHECK(different == "");
    CHECK(drawn >= 3400);
}

TEST_CASE("parameters that no test of the suite uses are rejected") {
    const std::pair<std::string_view, Names> wrong[] = {
        {"Vertex_shader_rounding_tests",
         {"Geometry_nan", "Geometry_inf", "Geometry_1e30", "Geometry_-0.5", "Geometry_", "Geometry_0.5x"}},
        {"ZPass_pixel_count",
         {"ZPassPointSize-0x", "ZPassPointSize-0xFFFFFFFFF", "ZPassLineWidth-0x-1", "ZPass_ZB_ZB"}},
        {"Depth_buffer",
         {"DepthFmt_z16_Cn_FZn_M010000_ZB", "DepthFmt_z24_Cn_FZn_M1000000_ZB", "DepthFmt_z32_Cn_FZn_M00ffff"}},
        {"Depth_Clamp", {"depth_clamp_W0_C0_ZB0_FR0_VSH1x", "depth_clamp_W2_C0_ZB0_FR0_VSH1"}},
        {"Front_face", {"FrontFace_0x64_CF_B", "FrontFace_CW_CF_", "FrontFace__CF_B"}},
        {"Window_clip",
         {"I_x0y0_w999999h1-x0y0_w0h0", "I_x0y0_w1h1", "I_x-1y0_w1h1-x0y0_w0h0", "I_x0y0_w1h1-x0y0_w0h0x"}},
        {"Clear", {"C00000002_Depth_n", "C_Depth_n", "SCF_R5G6B5x"}},
        {"Texture_shadow_comparator",
         {"4R16_0-100_80_EQ", "3R16f_0-100_80_EQ", "3R16_0-10000_80_EQ", "3F24f_10.00-20.00_15.0000_EQ",
          "3P16_-7-20_1_LT", "3P24_1-inf_nan_LT", "3F16_10.00_15.0000_EQ", "3F16_10.00-20.00_15.0000_"}},
        {"Combiner", {"Muxx", ""}},
        {"Pixel_shader", {"DotZW_", "dotst"}},
        {"Texture_perspective", {"tex_tex_pers_n_", "tex_tex_pers_x_quad", "tex_diff_pers_n_quads"}},
        {"Viewport", {"0.000_0.531-0.000_0.000", "0.000_0.000-3.000_0.000", "0.000"}},
        {"Surface_clip", {"x16y8_w640h384", "x16y8_w512h384_R5G6B5", "x-1y8_w512h384"}},
        {"W_buffering",
         {"ZBuf24D_Riddick_V1_ZB0_ZS0_ZB", "WBuf24D_Trunc0_V1_ZB0_ZS0_ZB", "XBuf24D_TriH_V1_ZB0_ZS0_ZB",
          "ZBuf32D_TriH_V1_ZB0_ZS0_ZB", "ZBuf24G_TriH_V1_ZB0_ZS0_ZB", "ZBuf24D_TriH-15-000_V1_ZB0_ZS0_ZB",
          "ZBuf24D_TriH_V2_ZB0_ZS0_ZB", "ZBuf24D_TriH_V1_ZB0_ZS0_ZB_"}},
        {"W_param",
         {"prog_w_zero_inf__quad_w", "prog_w_zero_inf__quad_wx", "prog_w_zero_inf__tri_w1.00",
          "prog_w_zero_inf__quad_w1e-30"}},
        {"ZMinMaxControl", {"Ctrl_", "Ctrl_ZCULLED", "Ctrl_NEARFAR_WBuf_ZCULL"}}};
    for (const auto& [suite, names] : wrong) CHECK(with_other_outcome(Outcome::unknown, suite, names) == "");
    CHECK(with_other_outcome(Outcome::not_modelled, "ZPass_pixel_count",
                             {"ZPassPointSize-0x0200", "ZPassPointSizeVS-0x0202", "ZPassLineWidth-0xFFFFFFFF"}) == "");
}
