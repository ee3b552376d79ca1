// Names of enums that users read tell their values apart, and every feature can be refused by its own. The names of a
// profile's choices stand in profile_table_test.cpp.
#include <catch2/catch.hpp>
#include <set>

#include "pipeline/device/check.h"
#include "pipeline/device/profile_fields.h"
#include "pipeline/device/vertex_path.h"
#include "pipeline/frame/diagnostics.h"
#include "rasterizer/base/enum_values.h"

using namespace strata::pipeline;
using strata::enum_values;

namespace {

// Names that differ from one another and from "".
template <class Enum>
bool names_differ(auto name_of) {
    std::set<std::string_view> seen{""};
    for (const Enum value : enum_values<Enum>)
        if (!seen.insert(name_of(value)).second) return false;
    return true;
}

}  // namespace

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
    CHECK(enum_values<Format>.size() == 17);
    CHECK(enum_values<Feature>.size() == 18);
}
