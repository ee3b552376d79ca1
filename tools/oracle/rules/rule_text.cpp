// tools/oracle/rules/rule_text.cpp - the sentence of every rule, as verdicts show it.
#include <fmt/format.h>

#include "pipeline/vertices/draw_list.h"
#include "tools/oracle/fragments/setting.h"
#include "tools/oracle/rules/rules.h"

namespace strata::oracle::verdict {

std::string instance_name(std::uint32_t n, const pipeline::DrawList& list) {
    const std::string& mesh = list.meshes[list.instances[n].mesh].name;
    return mesh.empty() ? fmt::format("instance {}", n) : fmt::format("instance {} (mesh {})", n, mesh);
}

namespace {

std::string ordinal(std::uint32_t n, std::string_view end) {
    if (n == 0) return std::string{end};
    constexpr std::string_view words[] = {"second", "third", "fourth", "fifth", "sixth", "seventh", "eighth"};
    const std::string number = n <= 7 ? std::string{words[n - 1]} : fmt::format("{}th", n + 1);
    return fmt::format("{} {}", number, end);
}

std::string layers(std::uint32_t n) { return n == 1 ? "layer" : fmt::format("{} layers", n); }

std::string material_name(std::uint32_t n, const pipeline::DrawList& list) {
    const std::string& material = list.materials[n].name;
    return material.empty() ? fmt::format("material {}", n) : fmt::format("material {}", material);
}

std::string codes(std::uint32_t n) { return n == 1 ? "one code" : fmt::format("{} codes", n); }

// "back faces", "what has material glass"; empty for all layers.
std::string some(const Rule& rule, const pipeline::DrawList& list) {
    switch (rule.scope) {
        case Scope::all: return "";
        case Scope::instance: return instance_name(rule.of, list);
        case Scope::material: return "what has " + material_name(rule.of, list);
        case Scope::back_faces: return "back faces";
        case Scope::front_faces: return "front faces";
        case Scope::layer: return fmt::format("the {} layer", ordinal(rule.of, "nearest"));
        case Scope::layer_from_far: break;
    }
    return fmt::format("the {} layer", ordinal(rule.of, "farthest"));
}

std::string_view point(std::uint32_t n) {
    switch (static_cast<TrianglePoint>(n)) {
        case TrianglePoint::mean: return "their centroids";
        case TrianglePoint::window_mean: return "the mean of their corners' window depths";
        case TrianglePoint::nearest: return "their nearest corners";
        case TrianglePoint::farthest: break;
    }
    return "their farthest corners";
}

// The subject of a sentence about rules that read another pixel.
std::string whose(std::uint32_t n) {
    return n == 0 ? "layers are" : fmt::format("the {} layer is", ordinal(n - 1, "nearest"));
}

std::string_view weights(std::uint32_t n) {
    switch (n) {
        case 0: return "weighted by alpha, 1 - (1 - the mean alpha)^n for their alpha";
        case 1: return "weighted by alpha";
        case 2: return "weighted by alpha^2 (1 - z)^2";
        case 3: return "weighted by alpha^2 (1 - z)^3";
        case 5: return "weighted by alpha 0.03 / (1e-5 + (0.8 z)^4)";
        case 6: return "weighted as weighted, blended transparency (LearnOpenGL) does";
        default: return "weighted by alpha (1 - z)^3";
    }
}

}  // namespace

std::string description(const std::vector<Rule>& rules, const SceneFacts& facts, const pipeline::DrawList& list) {
    std::string text;
    for (const Rule& rule : rules) text += (text.empty() ? "" : "; and ") + description(rule, facts, list);
    return text;
}

std::string description(const Rule& rule, const SceneFacts& facts, const pipeline::DrawList& list) {
    if (!rule.region.is_everywhere()) {
        Rule everywhere = rule;
        everywhere.region = {};
        const RuleRegion& r = rule.region;
        return fmt::format("within x {} to {} and y {} to {}: {}", r.x0, r.x1 - 1, r.y0, r.y1 - 1,
                           description(everywhere, facts, list));
    }
    if (rule.scope != Scope::all && rule.kind != RuleKind::some_lost && rule.kind != RuleKind::some_doubled) {
        Rule of_all = rule;
        of_all.scope = Scope::all;
        return fmt::format("of {} {}", some(rule, list), description(of_all, facts, list));
    }
    const std::uint32_t n = rule.n;
    const auto of = [&] { return fmt::format("of up to {}", facts.most_layers); };
    switch (rule.kind) {
        case RuleKind::right: return "all layers are composited in their order";
        case RuleKind::nearest_alone:
            return n == 0 ? "no layer is composited"
                          : fmt::format("only the nearest {} {} are composited", layers(n), of());
        case RuleKind::farthest_alone: return fmt::format("only the farthest {} {} are composited", layers(n), of());
        case RuleKind::ends_alone:
            return fmt::format(
                "only the nearest {0} and the farthest {0} {1} are composited, as {2} of a dual peel leave them",
                layers(n), of(), n == 1 ? "one pass" : fmt::format("{} passes", n));
        case RuleKind::nearest_lost:
            return fmt::format("the nearest {} missing", n == 1 ? "layer is" : layers(n) + " are");
        case RuleKind::farthest_lost:
            return fmt::format("the farthest {} missing", n == 1 ? "layer is" : layers(n) + " are");
        case RuleKind::rest_averaged: return fmt::format("behind the nearest {} the others are averaged", layers(n));
        case RuleKind::rest_as_submitted:
            return fmt::format("behind the nearest {} the others are composited in the order of submission", layers(n));
        case RuleKind::ends_rest_as_submitted:
            return fmt::format(
                "between the nearest {0} and the farthest {0} the others are composited in the order of submission, as "
                "{1} of a dual peel leave them",
                layers(n), n == 1 ? "one pass" : fmt::format("{} passes", n));
        case RuleKind::odd_lost: return "every second layer is missing: the second, the fourth ...";
        case RuleKind::even_lost: return "every second layer is missing: the nearest, the third ...";
        case RuleKind::ended_early:
            return fmt::format("layers behind a transmittance below {:.3g} are missing: early termination", rule.value);
        case RuleKind::first_submitted:
            return fmt::format("only the first {} submitted are composited: a buffer is full", layers(n));
        case RuleKind::last_submitted: return fmt::format("only the last {} submitted are composited", layers(n));
        case RuleKind::lost: return fmt::format("the {} layer is missing", ordinal(n, "nearest"));
        case RuleKind::lost_from_far: return fmt::format("the {} layer is missing", ordinal(n, "farthest"));
        case RuleKind::doubled: return fmt::format("the {} layer is composited twice", ordinal(n, "nearest"));
        case RuleKind::doubled_from_far: return fmt::format("the {} layer is composited twice", ordinal(n, "farthest"));
        case RuleKind::swapped:
            return fmt::format("the {} layer is exchanged with the one behind it", ordinal(n, "nearest"));
        case RuleKind::swapped_from_far:
            return fmt::format("the {} layer is exchanged with the one before it", ordinal(n, "farthest"));
        case RuleKind::merged:
            return fmt::format("the {} layer and the one behind it are merged by MAX", ordinal(n, "nearest"));
        case RuleKind::mixed:
            return fmt::format("the {} layer and the one behind it are averaged", ordinal(n, "nearest"));
        case RuleKind::color_of_next:
            return fmt::format("the {} layer has the colour of the one behind it", ordinal(n, "nearest"));
        case RuleKind::color_of_previous:
            return fmt::format("the {} layer has the colour of the one before it", ordinal(n, "nearest"));
        case RuleKind::all_doubled: return "every layer is composited twice";
        case RuleKind::reversed: return "layers are composited in the reverse order";
        case RuleKind::as_submitted:
            return fmt::format("layers are composited in the order of {}: nothing is sorted",
                               n == 0 ? "submission" : fmt::format("drawing ({})", describe(drawing_order(n))));
        case RuleKind::as_submitted_reversed: return "layers are composited in the reverse order of submission";
        case RuleKind::by_instance:
            if (n == 0) return "instances are composited as they are submitted, each one sorted by itself";
            return fmt::format("instances are composited one after the other ({}), each one sorted by itself",
                               describe({static_cast<InstanceOrder>(n), FaceOrder::listed}));
        case RuleKind::faces_apart: return "all back faces are composited behind all front faces";
        case RuleKind::averaged: return fmt::format("layers are averaged, {}: nothing is sorted", weights(n));
        case RuleKind::middle_lost: return "of an odd number of layers the middle one is missing";
        case RuleKind::middle_doubled: return "of an odd number of layers the middle one is composited twice";
        case RuleKind::colors_shifted: return "each layer has the colour of the one behind it";
        case RuleKind::alphas_shifted: return "each layer has the alpha of the one behind it";
        case RuleKind::nearest_repeated: return "the nearest layer is composited in place of every other one";
        case RuleKind::nearest_behind: return "the nearest layer is composited behind all others";
        case RuleKind::farthest_before: return "the farthest layer is composited before all others";
        case RuleKind::pairs_swapped:
            return "neighbouring layers are exchanged in pairs: 2, 1, 4, 3 ... from the nearest";
        case RuleKind::ordered_in_bits:
            return fmt::format("layers are ordered by depths of {} bits, equal ones as submitted", n);
        case RuleKind::lost_in_bits:
            return fmt::format("of layers at one depth of {} bits the nearest alone is composited", n);
        case RuleKind::sorted_once: return "layers are sorted by a single bubble-sort pass";
        case RuleKind::through_late:
            return "a layer's colour is multiplied by its own transmittance, too: the product is updated too early";
        case RuleKind::multiplied: return "the background is multiplied by the layers' colours";
        case RuleKind::greatest: return "each channel is the maximum of all colours: MAX blending";
        case RuleKind::least: return "each channel is the minimum of all colours: MIN blending";
        case RuleKind::composed_twice:
            return "layers are composited over transparent black, and the result is multiplied by its alpha again over "
                   "the background";
        case RuleKind::added: return "layers are added to the background";
        case RuleKind::weighted_sum:
            return "layers are added, and the background is multiplied by 1 - the sum of all alphas: weighted sum";
        case RuleKind::nearest_of_instance: return "only the nearest layer of each instance is composited";
        case RuleKind::alpha_below_lost: return fmt::format("layers with alpha below {:.4g} are missing", rule.value);
        case RuleKind::alpha_below_kept:
            return fmt::format("layers with alpha of {:.4g} and more are missing", rule.value);
        case RuleKind::some_lost:
            return fmt::format("{} {} missing", some(rule, list),
                               rule.scope == Scope::back_faces || rule.scope == Scope::front_faces ? "are" : "is");
        case RuleKind::some_doubled:
            return fmt::format("{} {} composited twice", some(rule, list),
                               rule.scope == Scope::back_faces || rule.scope == Scope::front_faces ? "are" : "is");
        case RuleKind::behind_drawn:
            return fmt::format(
                "a layer is missing where a nearer one was drawn before it ({}): blended surfaces write depth",
                describe(drawing_order(n)));
        case RuleKind::before_drawn: return "a layer is missing where a farther one was drawn before it";
        case RuleKind::close_lost:
            return fmt::format("of layers within {} of depth the farther one is missing", codes(n));
        case RuleKind::within_lost:
            return fmt::format("of layers within {:.0e} of the depth range the farther one is missing: an epsilon",
                               rule.value);
        case RuleKind::within_merged:
            return fmt::format(
                "layers whose depths differ by at most {:.0e} of the depth range are merged by MAX: an epsilon",
                rule.value);
        case RuleKind::close_merged:
            return fmt::format("layers whose depths differ by at most {} are merged by MAX", codes(n));
        case RuleKind::close_swapped:
            return fmt::format("layers whose depths differ by at most {} are composited in exchanged order", codes(n));
        case RuleKind::edges_twice: return "a centre on an edge is drawn by both triangles beside it";
        case RuleKind::edges_never: return "a centre on an edge is drawn by neither triangle beside it";
        case RuleKind::hidden_shown: return "layers behind opaque surfaces are composited: they are not hidden";
        case RuleKind::hidden_alone:
            return "layers behind opaque surfaces are composited, and those before them are missing";
        case RuleKind::at_opaque_shown:
            return n == 0 ? "layers at the depth of an opaque surface are composited: LEQUAL for LESS"
                          : fmt::format("layers within {} behind an opaque surface are composited", codes(n));
        case RuleKind::near_opaque_lost:
            return fmt::format("layers within {} before an opaque surface are missing", codes(n));
        case RuleKind::opaque_lost: return "opaque surfaces are missing behind the layers";
        case RuleKind::opaque_ignored: return "opaque surfaces are missing, and layers behind them are composited";
        case RuleKind::opaque_in_front: return "opaque surfaces cover the layers before them";
        case RuleKind::background_lost:
            return n != 0 ? "the background and opaque surfaces are black behind layers"
                          : "the background is missing: black behind the layers";
        case RuleKind::background_twice: return "the background is added twice";
        case RuleKind::background_added: return "the background is added without the transmittance of the layers";
        case RuleKind::background_other:
            return fmt::format("the background is {:.0f}, {:.0f}, {:.0f} of 255", facts.background[0] * 255,
                               facts.background[1] * 255, facts.background[2] * 255);
        case RuleKind::surface_lost: return "the background and opaque surfaces are missing: black behind the layers";
        case RuleKind::alpha_squared: return "alpha is squared";
        case RuleKind::alpha_inverted: return "alpha is replaced by 1 - alpha";
        case RuleKind::alpha_ignored: return "alpha is replaced by 1: nothing is blended";
        case RuleKind::alpha_times: return fmt::format("alpha is multiplied by {:.3g}", rule.value);
        case RuleKind::alpha_root: return "alpha is replaced by its square root";
        case RuleKind::channel_lost:
            return fmt::format("{} is missing in the layers", n == 0 ? "red" : n == 1 ? "green" : "blue");
        case RuleKind::premultiplied_twice: return "colours are multiplied by alpha twice";
        case RuleKind::not_premultiplied: return "colours are not multiplied by alpha";
        case RuleKind::red_for_blue: return "red and blue are exchanged in the layers";
        case RuleKind::decoded:
            return fmt::format("colours{} are decoded from sRGB before they are blended, and not encoded again",
                               n == 0   ? ""
                               : n == 1 ? ", of opaque surfaces, too,"
                                        : ", of opaque surfaces and the background, too,");
        case RuleKind::encoded: return "colours are encoded to sRGB before they are blended";
        case RuleKind::picture_encoded: return "the finished picture is encoded to sRGB again";
        case RuleKind::picture_decoded: return "the finished picture is decoded from sRGB again, or not encoded";
        case RuleKind::rows_reversed: return "the picture is upside down";
        case RuleKind::columns_reversed: return "left and right are exchanged";
        case RuleKind::turned: return "the picture is rotated by 180 degrees";
        case RuleKind::submitted_lost:
            return fmt::format("the {} layer is missing", n == 0 ? "first submitted" : ordinal(n, "submitted"));
        case RuleKind::submitted_lost_from_last:
            return fmt::format("the {} layer that was submitted is missing", ordinal(n, "last"));
        case RuleKind::near_reversed: return "the near half of the layers is composited in the reverse order";
        case RuleKind::far_reversed: return "the far half of the layers is composited in the reverse order";
        case RuleKind::submitted_moved:
            return fmt::format("the layer that is submitted {} is composited {} all others",
                               n % 2 == 0 ? "first" : "last", n < 2 ? "in front of" : "behind");
        case RuleKind::by_centroid: return fmt::format("triangles are sorted by {}, not fragments by depth", point(n));
        case RuleKind::alphas_as_submitted:
            return fmt::format("layers are sorted, but their alphas stay in the {}order of submission",
                               n == 0 ? "" : "reverse ");
        case RuleKind::colors_as_submitted:
            return fmt::format("layers are sorted, but their colours stay in the {}order of submission",
                               n == 0 ? "" : "reverse ");
        case RuleKind::shifted:
            return fmt::format("{} read {},{} pixels to the right and down", whose(n), rule.dx, rule.dy);
        case RuleKind::halved:
            return fmt::format(
                "layers{} are those of one pixel in two by two, {},{} from the first: textures of half size",
                n == 0 ? "" : fmt::format(" behind the nearest {}", layers(n)), rule.dx, rule.dy);
        case RuleKind::mirrored:
            return fmt::format("{} read {}", whose(n),
                               rule.dx == 0   ? "upside down"
                               : rule.dy == 0 ? "with left and right exchanged"
                                              : "turned by half a turn");
        case RuleKind::surface_mixed:
            return fmt::format("opaque surfaces are mixed with the clear colour: {:.3g} of the surface", rule.value);
        case RuleKind::veiled: return fmt::format("transmittance starts at {:.3g} instead of 1", rule.value);
        case RuleKind::through_squared: return "a layer's transmittance is 1 - alpha^2 instead of 1 - alpha";
        case RuleKind::through_summed: return "transmittance is 1 - the sum of alphas";
        case RuleKind::not_attenuated: return "layers are added without the transmittance of those before them";
        case RuleKind::behind_squared: return "the transmittance is applied twice to the background";
        case RuleKind::behind_inverted: return "the background is weighted by 1 - transmittance";
        case RuleKind::few_bits:
            return fmt::format("the accumulator stores colours with {} bits and transmittance with {}{}", n & 0xff,
                               n >> 8 & 0xff, n >> 16 != 0 ? ", and the picture is stored with as few" : "");
        case RuleKind::color_squared: return "colours are squared";
        case RuleKind::color_root: return "colours are replaced by their square roots";
        case RuleKind::solid: return "transmittance is 0 although colours are premultiplied";
        case RuleKind::blended_linear: break;
    }
    return "colours are decoded from sRGB, blended in linear light and encoded again";
}

}  // namespace strata::oracle::verdict
