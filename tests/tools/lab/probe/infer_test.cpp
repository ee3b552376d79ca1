// Tests inference against the profile that gave the answers, which the search does not see, and with one pixel changed.
#include "tools/lab/probe/search/infer.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tools/lab/probe/kit/draw_item.h"
#include "tools/lab/probe/kit/kit.h"

using namespace strata;
using namespace strata::probe;

namespace {

const FieldFinding& finding(const Inference& found, std::string_view key) {
    return *std::ranges::find(found.fields, key, &FieldFinding::key);
}

}  // namespace

TEST_CASE("every built-in device is found and no scene is unexplained") {
    for (const DeviceProfile& device : pipeline::builtin_profiles()) {
        const Inference found = infer(answer(device, kit(), {YDirection::up}), kit(), YDirection::up);
        INFO(device.name);
        CHECK(found.tally.equal == found.tally.all);
        CHECK(found.unexplained.empty());
        for (const FieldFinding& f : found.fields) {
            CHECK(f.state != FieldState::broken);
            if (f.state != FieldState::inferred) continue;
            INFO(f.key);
            CHECK(f.value == pipeline::text_of(field(f.key), device));
            CHECK(f.agree == f.places);
        }
    }
}

TEST_CASE("fields without a scene have their ordinary values and not those of the nearest built-in device") {
    const DeviceProfile& device = *pipeline::find_profile("llvmpipe");
    REQUIRE(device.texture_filter != DeviceProfile{}.texture_filter);
    const Inference found = infer(answer(device, kit(), {YDirection::up}), kit(), YDirection::up);
    CHECK(found.profile.texture_filter == DeviceProfile{}.texture_filter);
    CHECK(found.profile.alpha_to_coverage == DeviceProfile{}.alpha_to_coverage);
    CHECK(finding(found, "texture_filter").state == FieldState::unprobed);
}

TEST_CASE("one changed pixel contradicts the field that it decides and is reported with its scene and position") {
    const DeviceProfile& device = *pipeline::find_profile("llvmpipe");
    ProbePack pack = answer(device, kit(), {YDirection::up});
    // A pixel whose centre is on an edge, which the tie rule decides.
    DeviceProfile other = device;
    other.raster.tie_rule = rasterizer::TieRule::top_right;
    const Item& ties = *std::ranges::find(kit(), "coverage.ties", &Item::name);
    pipeline::Image& color = pack.answers[YDirection::up]["coverage.ties"].answer->color;
    const pipeline::Image turned = draw_item(other, ties, YDirection::up).answer->color;
    std::size_t at = 0;
    while (color.codes[at] == turned.codes[at]) ++at;
    color.codes[at] ^= 0x55u;
    const Inference found = infer(pack, kit(), YDirection::up);
    const FieldFinding& tie = finding(found, "raster.tie_rule");
    CHECK(tie.value == "bottom_left");
    CHECK(tie.state == FieldState::broken);
    CHECK(tie.agree + 1 == tie.places);
    REQUIRE(tie.broken.has_value());
    CHECK(tie.broken->item == "coverage.ties");
    const int pixel = static_cast<int>(at / 4);
    CHECK(tie.broken->x == pixel % ties.width);
    CHECK(tie.broken->y == pixel / ties.width);
    REQUIRE(found.unexplained.size() == 1);
    CHECK(found.unexplained[0].tally.all - found.unexplained[0].tally.equal == 1);
    CHECK(finding(found, "blend_rounding").broken == std::nullopt);
}

TEST_CASE("a field is open if the device drew none of its scenes") {
    ProbePack pack = answer(*pipeline::find_profile("llvmpipe"), kit(), {YDirection::up});
    for (auto& [name, reply] : pack.answers[YDirection::up])
        if (name.starts_with("blend.")) reply = {.answer = std::nullopt, .refusal = "no blending here"};
    const Inference found = infer(pack, kit(), YDirection::up);
    CHECK(finding(found, "blend_rounding").state == FieldState::open);
    CHECK(finding(found, "raster.tie_rule").state == FieldState::inferred);
    CHECK(found.missing.size() > 3);
}
