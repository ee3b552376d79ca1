// tools/oracle/rules/rule_text.cpp - the table of the kinds of rules: how often ports make the mistake, and its
// sentence, as verdicts show it.
#include <fmt/format.h>

#include <algorithm>
#include <array>

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

bool is_of_faces(const Rule& rule) { return rule.scope == Scope::back_faces || rule.scope == Scope::front_faces; }

constexpr std::string_view points[] = {"their centroids", "the mean of their corners' window depths",
                                       "their nearest corners", "their farthest corners"};
constexpr std::string_view weights[] = {"weighted by alpha, 1 - (1 - the mean alpha)^n for their alpha",
                                        "weighted by alpha",
                                        "weighted by alpha^2 (1 - z)^2",
                                        "weighted by alpha^2 (1 - z)^3",
                                        "weighted by alpha (1 - z)^3",
                                        "weighted by alpha 0.03 / (1e-5 + (0.8 z)^4)",
                                        "weighted as weighted, blended transparency (LearnOpenGL) does"};
constexpr std::string_view channels[] = {"red", "green", "blue"};
// What is decoded besides the layers' colours.
constexpr std::string_view also_decoded[] = {"", ", of opaque surfaces, too,",
                                             ", of opaque surfaces and the background, too,"};

// The subject of a sentence about rules that read another pixel.
std::string whose(std::uint32_t n) {
    return n == 0 ? "layers are" : fmt::format("the {} layer is", ordinal(n - 1, "nearest"));
}

std::string codes_of(const Rgba& c) {
    return fmt::format("{:.0f}, {:.0f}, {:.0f}", c[0] * 255, c[1] * 255, c[2] * 255);
}

// What a sentence is asked about.
struct AskedRule {
    const Rule& rule;
    const SceneFacts& facts;
    const pipeline::DrawList& list;
};

// A part of a sentence that depends on the rule's numbers. Its name stands in braces in the table.
struct SentencePart {
    std::string_view name;
    std::string (*words)(const AskedRule&);
};
const SentencePart parts[] = {
    {"n", [](const AskedRule& a) { return fmt::format("{}", a.rule.n); }},
    {"layers", [](const AskedRule& a) { return layers(a.rule.n); }},
    {"layers are", [](const AskedRule& a) { return layers(a.rule.n) + (a.rule.n == 1 ? " is" : " are"); }},
    {"of all", [](const AskedRule& a) { return fmt::format("of up to {}", a.facts.most_layers); }},
    {"passes", [](const AskedRule& a) { return a.rule.n == 1 ? "one pass" : fmt::format("{} passes", a.rule.n); }},
    {"nearest", [](const AskedRule& a) { return ordinal(a.rule.n, "nearest"); }},
    {"farthest", [](const AskedRule& a) { return ordinal(a.rule.n, "farthest"); }},
    {"codes", [](const AskedRule& a) { return a.rule.n == 1 ? "one code" : fmt::format("{} codes", a.rule.n); }},
    {"value", [](const AskedRule& a) { return fmt::format("{:.3g}", a.rule.value); }},
    {"power", [](const AskedRule& a) { return fmt::format("{:.0e}", a.rule.value); }},
    {"some are", [](const AskedRule& a) { return some(a.rule, a.list) + (is_of_faces(a.rule) ? " are" : " is"); }},
    {"drawing", [](const AskedRule& a) { return describe(drawing_order(a.rule.n)); }},
    {"instances",
     [](const AskedRule& a) {
         return describe({static_cast<InstanceOrder>(a.rule.n), FaceOrder::listed});
     }},
    {"reverse", [](const AskedRule& a) { return std::string{a.rule.n == 0 ? "" : "reverse "}; }},
    {"moved", [](const AskedRule& a) { return fmt::format("{},{} pixels", a.rule.dx, a.rule.dy); }},
    {"first", [](const AskedRule& a) { return fmt::format("{},{} from the first", a.rule.dx, a.rule.dy); }},
    {"read", [](const AskedRule& a) { return whose(a.rule.n); }},
    {"channel", [](const AskedRule& a) { return std::string{channels[a.rule.n % 3]}; }},
    {"weights", [](const AskedRule& a) { return std::string{weights[a.rule.n % std::size(weights)]}; }},
    {"point", [](const AskedRule& a) { return std::string{points[a.rule.n % triangle_point_count]}; }},
    {"background", [](const AskedRule& a) { return codes_of(a.facts.background); }},
    {"also decoded", [](const AskedRule& a) { return std::string{also_decoded[a.rule.n % 3]}; }},
    {"picture too",
     [](const AskedRule& a) {
         return std::string{a.rule.n >> 16 != 0 ? ", and the picture is stored with as few" : ""};
     }},
    {"color bits", [](const AskedRule& a) { return fmt::format("{}", a.rule.n & 0xff); }},
    {"weight bits", [](const AskedRule& a) { return fmt::format("{}", a.rule.n >> 8 & 0xff); }},
};

struct RuleEntry {
    RuleKind kind = RuleKind::right;
    int commonness = 1;
    std::string_view words;
    std::string_view words_of_none = {};  // if the rule's number is 0
};
constexpr auto entries = [] {
    using enum RuleKind;
    return std::to_array<RuleEntry>({
        {right, 1, "all layers are composited in their order"},
        {nearest_alone, 0, "only the nearest {layers} {of all} are composited", "no layer is composited"},
        {farthest_alone, 1, "only the farthest {layers} {of all} are composited"},
        {ends_alone, 0,
         "only the nearest {layers} and the farthest {layers} {of all} are composited, as {passes} of a dual peel "
         "leave them"},
        {nearest_lost, 1, "the nearest {layers are} missing"},
        {farthest_lost, 1, "the farthest {layers are} missing"},
        {rest_averaged, 1, "behind the nearest {layers} the others are averaged"},
        {rest_as_submitted, 1, "behind the nearest {layers} the others are composited in the order of submission"},
        {ends_rest_as_submitted, 1,
         "between the nearest {layers} and the farthest {layers} the others are composited in the order of submission, "
         "as {passes} of a dual peel leave them"},
        {first_submitted, 1, "only the first {layers} submitted are composited: a buffer is full"},
        {last_submitted, 1, "only the last {layers} submitted are composited"},
        {ended_early, 1, "layers behind a transmittance below {value} are missing: early termination"},
        {lost, 0, "the {nearest} layer is missing"},
        {lost_from_far, 1, "the {farthest} layer is missing"},
        {mixed, 1, "the {nearest} layer and the one behind it are averaged"},
        {ordered_in_bits, 1, "layers are ordered by depths of {n} bits, equal ones as submitted"},
        {sorted_once, 1, "layers are sorted by a single bubble-sort pass"},
        {reversed, 0, "layers are composited in the reverse order"},
        {by_centroid, 2, "triangles are sorted by {point}, not fragments by depth"},
        {alphas_as_submitted, 2, "layers are sorted, but their alphas stay in the {reverse}order of submission"},
        {colors_as_submitted, 2, "layers are sorted, but their colours stay in the {reverse}order of submission"},
        {as_submitted, 0, "layers are composited in the order of drawing ({drawing}): nothing is sorted",
         "layers are composited in the order of submission: nothing is sorted"},
        {by_instance, 1, "instances are composited one after the other ({instances}), each one sorted by itself",
         "instances are composited as they are submitted, each one sorted by itself"},
        {averaged, 0, "layers are averaged, {weights}: nothing is sorted"},
        {added, 1, "layers are added to the background"},
        {weighted_sum, 1,
         "layers are added, and the background is multiplied by 1 - the sum of all alphas: weighted sum"},
        {multiplied, 1, "the background is multiplied by the layers' colours"},
        {composed_twice, 1,
         "layers are composited over transparent black, and the result is multiplied by its alpha again over the "
         "background"},
        {nearest_of_instance, 1, "only the nearest layer of each instance is composited"},
        {some_lost, 1, "{some are} missing"},
        {some_doubled, 1, "{some are} composited twice"},
        {behind_drawn, 1,
         "a layer is missing where a nearer one was drawn before it ({drawing}): blended surfaces write depth"},
        {before_drawn, 1, "a layer is missing where a farther one was drawn before it"},
        {close_lost, 1, "of layers within {codes} of depth the farther one is missing"},
        {close_merged, 1, "layers whose depths differ by at most {codes} are merged by MAX"},
        {close_swapped, 1, "layers whose depths differ by at most {codes} are composited in exchanged order"},
        {within_lost, 1, "of layers within {power} of the depth range the farther one is missing: an epsilon"},
        {within_merged, 1,
         "layers whose depths differ by at most {power} of the depth range are merged by MAX: an epsilon"},
        {shifted, 1, "{read} read {moved} to the right and down"},
        {halved, 1,
         "layers behind the nearest {layers} are those of one pixel in two by two, {first}: textures of half size",
         "layers are those of one pixel in two by two, {first}: textures of half size"},
        {edges_twice, 1, "a centre on an edge is drawn by both triangles beside it"},
        {edges_never, 1, "a centre on an edge is drawn by neither triangle beside it"},
        {hidden_shown, 1, "layers behind opaque surfaces are composited: they are not hidden"},
        {hidden_alone, 1, "layers behind opaque surfaces are composited, and those before them are missing"},
        {at_opaque_shown, 1, "layers within {codes} behind an opaque surface are composited",
         "layers at the depth of an opaque surface are composited: LEQUAL for LESS"},
        {near_opaque_lost, 1, "layers within {codes} before an opaque surface are missing"},
        {opaque_lost, 1, "opaque surfaces are missing behind the layers"},
        {opaque_ignored, 1, "opaque surfaces are missing, and layers behind them are composited"},
        {opaque_in_front, 1, "opaque surfaces cover the layers before them"},
        {background_lost, 0, "the background and opaque surfaces are black behind layers",
         "the background is missing: black behind the layers"},
        {background_twice, 1, "the background is added twice"},
        {background_other, 0, "the background is {background} of 255"},
        {surface_lost, 1, "the background and opaque surfaces are missing: black behind the layers"},
        {surface_mixed, 1, "opaque surfaces are mixed with the clear colour: {value} of the surface"},
        {through_squared, 1, "a layer's transmittance is 1 - alpha^2 instead of 1 - alpha"},
        {through_summed, 1, "transmittance is 1 - the sum of alphas"},
        {not_attenuated, 1, "layers are added without the transmittance of those before them"},
        {behind_squared, 1, "the transmittance is applied twice to the background"},
        {behind_inverted, 1, "the background is weighted by 1 - transmittance"},
        {few_bits, 2,
         "the accumulator stores colours with {color bits} bits and transmittance with {weight bits}{picture too}"},
        {alpha_squared, 0, "alpha is squared"},
        {alpha_inverted, 1, "alpha is replaced by 1 - alpha"},
        {alpha_ignored, 0, "alpha is replaced by 1: nothing is blended"},
        {alpha_times, 1, "alpha is multiplied by {value}"},
        {solid, 1, "transmittance is 0 although colours are premultiplied"},
        {premultiplied_twice, 0, "colours are multiplied by alpha twice"},
        {not_premultiplied, 0, "colours are not multiplied by alpha"},
        {red_for_blue, 1, "red and blue are exchanged in the layers"},
        {channel_lost, 1, "{channel} is missing in the layers"},
        {decoded, 0, "colours{also decoded} are decoded from sRGB before they are blended, and not encoded again"},
        {encoded, 1, "colours are encoded to sRGB before they are blended"},
        {blended_linear, 0, "colours are decoded from sRGB, blended in linear light and encoded again"},
        {picture_encoded, 1, "the finished picture is encoded to sRGB again"},
        {picture_decoded, 1, "the finished picture is decoded from sRGB again, or not encoded"},
        {rows_reversed, 1, "the picture is upside down"},
        {columns_reversed, 1, "left and right are exchanged"},
        {turned, 1, "the picture is rotated by 180 degrees"},
    });
}();
static_assert([] {
    std::size_t number = 0;
    return entries.size() == rule_kind_count && std::ranges::all_of(entries, [&](const RuleEntry& e) {
               return static_cast<std::size_t>(e.kind) == number++;
           });
}());

const RuleEntry& entry_of(RuleKind kind) { return entries[static_cast<std::size_t>(kind)]; }

// The words with their parts filled in.
std::string filled(std::string_view words, const AskedRule& asked) {
    std::string text;
    while (true) {
        const std::size_t open = words.find('{');
        text += words.substr(0, open);
        if (open == std::string_view::npos) return text;
        const std::size_t close = words.find('}', open);
        const std::string_view name = words.substr(open + 1, close - open - 1);
        text += std::ranges::find(parts, name, &SentencePart::name)->words(asked);
        words.remove_prefix(close + 1);
    }
}

}  // namespace

int commonness_of(RuleKind kind) noexcept { return entry_of(kind).commonness; }

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
    const RuleEntry& entry = entry_of(rule.kind);
    const bool is_none = rule.n == 0 && !entry.words_of_none.empty();
    const std::string words = filled(is_none ? entry.words_of_none : entry.words, {rule, facts, list});
    const bool names_scope = rule.kind == RuleKind::some_lost || rule.kind == RuleKind::some_doubled;
    return rule.scope == Scope::all || names_scope ? words : fmt::format("of {} {}", some(rule, list), words);
}

}  // namespace strata::oracle::verdict
