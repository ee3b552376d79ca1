// Tests the list of an enum's values and names on enums defined here.
#include "rasterizer/base/enum_values.h"

#include <catch2/catch.hpp>
#include <cstdint>

namespace {

enum class Fruit : std::uint8_t { apple, pear, sour_cherry_2 };
enum class Lone : std::uint8_t { only };
enum class Empty : std::uint8_t {};
struct Scope {
    enum class Inner : std::uint8_t { a, b };
};

using strata::enum_named;
using strata::enum_names;
using strata::enum_values;

static_assert(enum_values<Fruit> == std::array{Fruit::apple, Fruit::pear, Fruit::sour_cherry_2});
static_assert(enum_values<Lone>.size() == 1 && enum_values<Empty>.empty());
static_assert(enum_values<Scope::Inner> == std::array{Scope::Inner::a, Scope::Inner::b});

}  // namespace

TEST_CASE("the list of an enum ends at its last value and each value has its identifier as name") {
    CHECK(enum_names<Fruit> == std::array<std::string_view, 3>{"apple", "pear", "sour_cherry_2"});
    CHECK(enum_names<Lone> == std::array<std::string_view, 1>{"only"});
    CHECK(enum_names<Scope::Inner> == std::array<std::string_view, 2>{"a", "b"});
}

TEST_CASE("a name is read back as its value and no other text is accepted") {
    for (std::size_t i = 0; i < enum_values<Fruit>.size(); ++i)
        CHECK(enum_named<Fruit>(enum_names<Fruit>[i]) == enum_values<Fruit>[i]);
    for (const char* text : {"", "apples", "Pear", "sour_cherry_", "Fruit::pear"}) CHECK_FALSE(enum_named<Fruit>(text));
    CHECK(strata::enum_name(Fruit::pear) == "pear");
    CHECK(strata::enum_name(static_cast<Fruit>(3)).empty());
    CHECK(strata::is_listed(Fruit::sour_cherry_2));
    CHECK_FALSE(strata::is_listed(static_cast<Fruit>(3)));
    CHECK_FALSE(strata::is_listed(static_cast<Fruit>(255)));
}
