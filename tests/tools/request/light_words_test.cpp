// Tests how lights and a lighting model are read from words and written: every part by its meaning, and the texts that
// are none.
#include "tools/request/light_words.h"

#include <catch2/catch.hpp>
#include <limits>

namespace {

using namespace strata;
using pipeline::Light;
using pipeline::LightModel;
using pipeline::LightType;
using tools::light_model_text;
using tools::lights_text;
using tools::to_light_model;
using tools::to_lights;

}  // namespace

TEST_CASE("each kind of light is read with its numbers in their order and its named parts in any") {
    const auto lights = to_lights(
        "directional,1,-2,3,ambient=0.5:0:0/point,4,5,6,0,1,2,range=9,color=1:0.5:0.25/"
        "spot,1,2,3,0,-1,0,20,8,1,0.5,0.25,specular=0:0:1,diffuse=0:1:0");
    REQUIRE(lights);
    REQUIRE(lights->size() == 3);
    CHECK((*lights)[0] == Light{.ambient = {0.5f, 0, 0}, .direction = {1, -2, 3}});
    CHECK((*lights)[1] == Light{.type = LightType::point,
                                .diffuse = {1, 0.5f, 0.25f},
                                .specular = {1, 0.5f, 0.25f},
                                .position = {4, 5, 6},
                                .attenuation = {0, 1, 2},
                                .range = 9});
    CHECK((*lights)[2] == Light{.type = LightType::spot,
                                .diffuse = {0, 1, 0},
                                .specular = {0, 0, 1},
                                .position = {1, 2, 3},
                                .direction = {0, -1, 0},
                                .attenuation = {1, 0.5f, 0.25f},
                                .cutoff = 20,
                                .exponent = 8});
    CHECK(to_lights("none") == std::vector<Light>{});
}

TEST_CASE("lights are written without what is as usual, and read back") {
    CHECK(lights_text({}) == "none");
    CHECK(lights_text({Light{}}) == "directional,0,0,-1");
    CHECK(lights_text({Light{.type = LightType::point, .attenuation = {0, 0, 1}, .range = 5}}) ==
          "point,0,0,0,0,0,1,range=5");
    CHECK(lights_text({Light{.type = LightType::spot}, Light{.diffuse = {2, 2, 2}}}) ==
          "spot,0,0,0,0,0,-1,45/directional,0,0,-1,diffuse=2:2:2");
    // An attenuation stands behind the exponent.
    CHECK(lights_text({Light{.type = LightType::spot, .attenuation = {1, 1, 0}}}) == "spot,0,0,0,0,0,-1,45,0,1,1,0");
    CHECK(lights_text(*to_lights("point,1e+20,0.1,-3,color=3:2:1")) == "point,1e+20,0.1,-3,color=3:2:1");
}

TEST_CASE("values that lights may not have are read, so that the renderer can name their place") {
    CHECK(to_lights("directional,0,0,0"));
    CHECK(to_lights("spot,0,0,0,0,0,1,91"));
    CHECK_FALSE(to_lights("directional,0,0,inf"));
    CHECK_FALSE(to_lights("directional,0,0,1;point,0,0,0"));
}

TEST_CASE("a lighting model is read from its parts in any order and written in one") {
    const auto model = to_light_model("two-sided,shininess=12.5,specular=1:0.5:0,ambient=0:0:0,local-viewer");
    REQUIRE(model);
    CHECK(*model == LightModel{.ambient = {0, 0, 0},
                               .has_local_viewer = true,
                               .is_two_sided = true,
                               .specular = {1, 0.5f, 0},
                               .shininess = 12.5f});
    CHECK(light_model_text(*model) == "ambient=0:0:0,specular=1:0.5:0,shininess=12.5,local-viewer,two-sided");
    CHECK(light_model_text({}) == "ambient=0.2:0.2:0.2");
    CHECK_FALSE(to_light_model("two-sided=1"));
}
