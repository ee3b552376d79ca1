// Every enumerator of a list that users read has a name that reads back. The model is the names written out: they stand in users'
// files, so a renamed or moved enumerator must fail here.
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "pipeline/device/check.h"
#include "pipeline/device/profile_fields.h"
#include "pipeline/device/vertex_path.h"
#include "pipeline/frame/diagnostics.h"
#include "rasterizer/base/enum_values.h"

using namespace strata::pipeline;
using strata::enum_values;

namespace {

using Names = std::vector<std::string_view>;

const std::map<std::string_view, Names>& written_names() {
    static const std::map<std::string_view, Names> names{
        {"raster.snap", {"toward_zero", "nearest_even"}},
        {"raster.tie_rule", {"top_left", "bottom_left", "top_right", "bottom_right"}},
        {"raster.z_clip", {"per_primitive", "per_fragment"}},
        {"raster.w_clip", {"clip", "drop"}},
        {"raster.w_divide", {"quotient", "reciprocal", "nv20"}},
        {"raster.viewport", {"separate", "fused"}},
        {"raster.plane_origin", {"snapped", "unsnapped"}},
        {"raster.window_z", {"unit_interval", "buffer_units"}},
        {"raster.depth_path", {"window_z", "perspective_rq", "depth_replace", "float32", "float32_plane", "exact"}},
        {"raster.depth_rounding", {"floor", "nearest"}},
        {"raster.offset_unit", {"format", "float_exponent"}},
        {"raster.color", {"exact_plane", "weights_8bit"}},
        {"raster.interpolant_bits", {"16", "17", "18", "19", "20", "21", "22", "23", "24", "double"}},
        {"raster.divide", {"exact", "cut_reciprocal", "low_reciprocal"}},
        {"raster.window_z_rule", {"chip", "exact", "float32"}},
        {"raster.plane_anchor", {"first_vertex", "window_corner"}},
        {"raster.perspective_color", {"edge_products", "weight_products"}},
        {"raster.texture_coordinates", {"exact_plane", "cut_weights"}},
        {"alpha_test", {"unorm8", "by_target"}},
        {"blend_rounding", {"nearest", "truncate"}},
        {"half_rounding", {"nearest_even", "toward_zero"}},
        {"min_max_nan", {"other_operand", "propagate"}},
        {"denormals", {"flush", "keep"}},
        {"texture_filter", {"unorm8", "single"}}};
    return names;
}

// Names that differ from one another and from "".
template <class Enum>
bool names_differ(auto name_of) {
    std::set<std::string_view> seen{""};
    for (const Enum value : enum_values<Enum>)
        if (!seen.insert(name_of(value)).second) return false;
    return true;
}

}  // namespace

TEST_CASE("every choice of a profile has the names that profiles in files use, in the order of its enum") {
    std::size_t choices = 0;
    for (const ProfileField& field : profile_fields()) {
        INFO(field.key);
        CHECK((field.kind == FieldKind::choice) == written_names().contains(field.key));
        if (field.kind != FieldKind::choice) continue;
        CHECK(Names(field.choices.begin(), field.choices.end()) == written_names().at(field.key));
        ++choices;
    }
    CHECK(choices == written_names().size());
}

TEST_CASE("a choice of a profile holds every value of its enum, and each is told from the others by its text") {
    for (const ProfileField& field : profile_fields()) {
        if (field.kind != FieldKind::choice) continue;
        INFO(field.key);
        DeviceProfile profile;
        std::set<std::string> texts;
        for (int value = 0; value <= field.highest; ++value) {
            field.set(profile, value);
            CHECK(texts.insert(text_of(field, profile)).second);
        }
        CHECK(static_cast<int>(texts.size()) == static_cast<int>(written_names().at(field.key).size()));
    }
}

TEST_CASE("every format, fault, vertex path and feature has a name of its own") {
    CHECK(names_differ<Format>([](Format f) { return info(f).name; }));
    CHECK(names_differ<Fault>([](Fault f) { return name(f); }));
    CHECK(names_differ<VertexPath>([](VertexPath p) { return vertex_path_names[static_cast<std::size_t>(p)]; }));
    DeviceProfile nothing = *find_profile("geforce3");
    for (const ProfileField& field : profile_fields())
        if (field.kind == FieldKind::boolean && field.key.starts_with("has_")) field.set(nothing, 0);
    std::set<std::string> words{""};
    for (const Feature feature : enum_values<Feature>) {
        const Verdict refusal = check(nothing, feature);
        REQUIRE(refusal);
        CHECK(words.insert(refusal->feature).second);
        CHECK(has(*find_profile("ideal"), feature) == !check(*find_profile("ideal"), feature));
    }
    CHECK(enum_values<Format>.size() == 16);
    CHECK(enum_values<Feature>.size() == 16);
}
