// tools/oracle/rules/rule.h - the mistakes that a port may make with a pixel's layers; the same mistake at every
// pixel.
//
// Rule     A rule is a value: a kind and its parameters. StackMaker (structure.h) applies it to a pixel's list. Layers
//          are numbered from 0 at the near end, or from the far end if the kind says so.
// Tests    tests/tools/oracle/search/search_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strata::oracle::verdict {

enum class RuleKind : std::uint8_t {
    right,
    // The number of layers. n: how many
    nearest_alone,   // the nearest n
    farthest_alone,  // the farthest n
    ends_alone,      // the nearest n and the farthest n, as after n passes of a dual peel
    nearest_lost,    // all but the nearest n
    farthest_lost,   // all but the farthest n
    rest_averaged,   // the nearest n, and behind them one layer: the average of the others with their combined alpha;
                     // value: 1 with the mean alpha for each
    rest_as_submitted,       // the nearest n, and behind them the others in submission order
    ends_rest_as_submitted,  // the nearest n, the others in submission order, the farthest n
    first_submitted,         // the first n submitted, sorted
    last_submitted,          // the last n submitted, sorted
    ended_early,             // all behind a transmittance of less than `value`
    // One layer, with number n
    lost,
    lost_from_far,
    mixed,  // averaged with the layer behind it
    // All layers
    ordered_in_bits,  // ordered by depths of n bits, equal depths in submission order
    sorted_once,      // in submission order, with one pass of exchanges of neighbours from near to far
    reversed,
    by_centroid,          // by depths of triangles; n: the point of the triangle (setting.h)
    alphas_as_submitted,  // sorted, but with the alphas in submission order
    colors_as_submitted,  // sorted, but with the colours in submission order
    as_submitted,         // the last drawn is in front; n: the drawing order (setting.h)
    by_instance,          // the last instance is in front, with sorted layers; n: the order of instances
    averaged,             // one layer with a weighted average; n: the weights and the alpha (color_rules.cpp)
    added,                // premultiplied colours are added to the background
    weighted_sum,         // premultiplied colours, and the background times 1 - the sum of alphas
    multiplied,           // the background times all colours
    composed_twice,       // composited over nothing, and the result over the background by its alpha again
    nearest_of_instance,
    // Layers with a property. `scope` is the property, and its number is `of`
    some_lost,
    some_doubled,
    behind_drawn,  // those behind a layer drawn before, as if blended surfaces wrote depth; n: the drawing order
    before_drawn,  // those in front of a layer drawn before
    close_lost,    // those within n codes behind the layer before them are dropped
    close_merged,  // merged by MAX
    close_swapped,
    within_lost,  // the same within `value` of the depth range
    within_merged,
    // Layers of another pixel. n: 0 all layers, else one by its number from 1; dx and dy: the pixel
    shifted,
    halved,  // of one pixel of each 2 x 2 pixels: dx and dy from the first; n: from this layer on
    // Pixels whose centre lies on an edge
    edges_twice,  // both triangles at the edge are drawn
    edges_never,  // neither triangle is drawn
    // The opaque surface and the background
    hidden_shown,      // those behind the opaque surface are drawn over it
    hidden_alone,      // only those behind the opaque surface
    at_opaque_shown,   // also those up to n codes behind the opaque surface, as with LEQUAL instead of LESS
    near_opaque_lost,  // those up to n codes in front of it are dropped
    opaque_lost,       // the background replaces it behind visible layers
    opaque_ignored,    // the same, and hidden layers are drawn
    opaque_in_front,   // layers are not blended over it
    background_lost,   // black behind all; n 1: only behind layers, also instead of the opaque surface
    background_twice,  // added a second time
    background_other,  // another colour, which the candidate has where nothing is drawn
    surface_lost,      // black behind all, also instead of the opaque surface
    surface_mixed,     // `value` of the opaque surface, the rest of the clear colour
    // How layers are blended (composite.h, Mixing)
    through_squared,  // the transmittance of a layer is 1 - alpha^2
    through_summed,   // 1 - the sum of alphas
    not_attenuated,   // layers are added without transmittance; the background is attenuated
    behind_squared,   // the colour behind the front accumulator is multiplied by the transmittance twice
    behind_inverted,  // by 1 - the transmittance
    few_bits,  // n: bits of the accumulator's colours, plus 256 times those of the transmittance, plus 65536 if the
               // picture has them, too
    // Colours of the layers in `scope`
    alpha_squared,
    alpha_inverted,
    alpha_ignored,  // alpha is 1
    alpha_times,    // alpha times `value`
    solid,          // alpha is 1, with premultiplied colours unchanged
    premultiplied_twice,
    not_premultiplied,
    red_for_blue,
    channel_lost,    // n: 0 red, 1 green, 2 blue
    decoded,         // from sRGB to linear light
    encoded,         // from linear light to sRGB
    blended_linear,  // decoded, blended, encoded
    // The finished picture
    picture_encoded,  // from linear light to sRGB
    picture_decoded,
    rows_reversed,
    columns_reversed,
    turned  // rotated by 180 degrees
};
inline constexpr std::size_t rule_kind_count = static_cast<std::size_t>(RuleKind::turned) + 1;

// The layers that a rule changes.
enum class Scope : std::uint8_t { all, instance, material, back_faces, front_faces, layer, layer_from_far };

// Pixels [x0, x1) x [y0, y1) of the frame, from the top left corner.
struct RuleRegion {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    [[nodiscard]] constexpr bool is_everywhere() const noexcept { return x1 == 0; }
    [[nodiscard]] constexpr bool has(int x, int y) const noexcept {
        return is_everywhere() || (x >= x0 && x < x1 && y >= y0 && y < y1);
    }
    friend bool operator==(const RuleRegion&, const RuleRegion&) = default;
};

struct Rule {
    RuleKind kind = RuleKind::right;
    std::uint32_t n = 0;
    float value = 0;
    Scope scope = Scope::all;
    std::uint32_t of = 0;  // the number of the instance, material or layer
    int dx = 0, dy = 0;    // pixels to the right and down
    RuleRegion region{};   // the pixels at which the rule applies
    friend bool operator==(const Rule&, const Rule&) = default;
};

// The name of the kind in JSON.
[[nodiscard]] std::string_view name(RuleKind kind) noexcept;

}  // namespace strata::oracle::verdict
