// Tests that the names of enums that users read are unique, and that every feature is rejected with its own name.
// profile_table_test.cpp tests the names of a profile's choices.
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

// Checks that the names differ from one another and from "".
template <class Enum>
bool names_differ(auto name_of) {
    std::set<std::string_view> seen{""};
    for (const Enum value : enum_values<Enum>)
        if (!seen.insert(name_of(value)).second) return false;
    return true;
}

}  // namespace

TEST_CASE("every format or fault or vertex path or feature has a unique name") {
    CHECK(names_differ<Format>([](Format f) { return info(f).name; }));
    CHECK(names_differ<Fault>([](Fault f) { return name(f); }));
    CHECK(names_differ<VertexPath>([](VertexPath p) { return vertex_path_names[static_cast<std::size_t>(p)]; }));
    DeviceProfile nothing = *find_profile("geforce3");
    for (const ProfileField& field : profile_fields())
        if (field.kind == FieldKind::boolean && field.key.starts_with("has_")) field.set(nothing, 0);
    std::set<std::string> words{""};
    for (const Feature feature : enum_values<Feature>) {
        const std::optional<Refusal> refusal = check(nothing, feature);
        REQUIRE(refusal);
        CHECK(words.insert(refusal->feature).second);
        CHECK(has(*find_profile("ideal"), feature) == !check(*find_profile("ideal"), feature));
    }
    CHECK(enum_values<Format>.size() == 20);
    CHECK(enum_values<Feature>.size() == 19);
}
