// Tests which name a pattern finds in a path. The names are those that a reader takes from the pattern.
#include "tools/oracle/folders/name_pattern.h"

#include <catch2/catch.hpp>

using namespace strata::oracle;

namespace {

// "-": the pattern does not fit.
std::string found(const char* pattern, const char* path) {
    const auto parsed = name_pattern(pattern);
    REQUIRE(parsed);
    return name_in(path, *parsed).value_or("-");
}

}  // namespace

TEST_CASE("a pattern has one name") {
    CHECK_FALSE(name_pattern("*.png"));
    CHECK_FALSE(name_pattern("{name}{name}"));
    CHECK_FALSE(name_pattern("{nam}.png"));
    CHECK(name_pattern("{name}"));
}

TEST_CASE("the name is what remains of a path that the pattern fits") {
    CHECK(found("{name}-actual.png", "menu-actual.png") == "menu");
    CHECK(found("{name}-actual.png", "ui/menu-actual.png") == "ui/menu");
    CHECK(found("{name}-actual.png", "menu-diff.png") == "-");
    CHECK(found("{name}-actual.png", "-actual.png") == "-");
    CHECK(found("{name}-actual.png", "menu-actual.png.bak") == "-");
    CHECK(found("new/{name}.png", "new/menu.png") == "menu");
    CHECK(found("new/{name}.png", "old/menu.png") == "-");
    CHECK(found("{name}", "ui/menu.png") == "ui/menu.png");
    CHECK(found("menu{name}menu", "menumenu") == "-");
    CHECK(found("ab{name}bc", "abc") == "-");
}

TEST_CASE("a star fits any characters of one folder, also none, and the name is as long as it can be") {
    CHECK(found("{name}@*.png", "menu@mac.png") == "menu");
    CHECK(found("{name}@*.png", "menu@2x@mac.png") == "menu@2x");
    CHECK(found("{name}@*.png", "menu@.png") == "menu");
    CHECK(found("{name}@*.png", "menu@mac/one.png") == "-");
    CHECK(found("platform/*/{name}.png", "platform/mac/ui/menu.png") == "ui/menu");
    CHECK(found("*/{name}.png", "a/b/c.png") == "b/c");
    CHECK(found("run*-{name}.*", "run12-menu.tif") == "menu");
    CHECK(found("*a*/{name}", "xbax/y") == "y");
    CHECK(found("*a*/{name}", "xbx/y") == "-");
}
