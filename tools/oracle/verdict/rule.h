// tools/oracle/verdict/rule.h - what a port may do to a pixel's layers instead of compositing them: one mistake, the
// same at every pixel.
//
// Rule     A rule is a value: a kind and its parameters. StackMaker applies it to a pixel's list; `holds` for a whole
//          picture is judge.h's affair. Numbers of layers count from the near end from 0, or from the far end where the
//          kind says so.
// Tests    tests/tools/oracle/verdict/search_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strata::oracle::verdict {

enum class RuleKind : std::uint8_t {
    right,
    // How many layers. n: their number
    nearest_alone,      // the nearest n
    farthest_alone,     // the farthest n
    ends_alone,         // the nearest n and the farthest n, as n passes of a dual peel leave them
    nearest_lost,       // all but the nearest n
    farthest_lost,      // all but the farthest n
    rest_averaged,      // the nearest n, behind them one layer: the average of the others, with their alpha together;
                        // value: 1 with the mean alpha for each
    rest_as_submitted,  // the nearest n, behind them the others as they were submitted
    ends_rest_as_submitted,    // the nearest n, the others as they were submitted, the farthest n
    first_submitted,           // the first n submitted, sorted
    last_submitted,            // the last n submitted, sorted
    submitted_lost,            // all but number n of those submitted
    submitted_lost_from_last,  // the same, counted from the last
    odd_lost,                  // the second, the fourth ...
    even_lost,                 // the nearest, the third ...
    middle_lost,               // of an odd number
    middle_doubled,
    ended_early,  // none behind those that let less than `value` through
    // One layer: n is its number
    lost,
    lost_from_far,
    doubled,
    doubled_from_far,
    swapped,           // with the one behind it
    swapped_from_far,  // with the one before it
    merged,            // with the one behind it, by MAX
    mixed,             // with the one behind it: the average of the two
    color_of_next,     // it has the colour of the one behind it
    color_of_previous,
    // All layers
    colors_shifted,    // each has the colour of the one behind it
    alphas_shifted,    // each has the alpha of the one behind it
    nearest_repeated,  // each is the nearest
    nearest_behind,    // the nearest comes behind all others
    farthest_before,   // the farthest comes before all others
    pairs_swapped,     // each second one comes before the one that is nearer
    ordered_in_bits,   // by depths of n bits, equal ones as submitted
    lost_in_bits,      // all but the first of one depth of n bits
    sorted_once,       // as submitted, near to far, and neighbours exchanged in one walk
    all_doubled,
    reversed,
    near_reversed,  // the near half, as a peel from both ends divides them
    far_reversed,
    submitted_moved,  // n: 0 the first submitted before all others, 1 the last; 2 the first behind all others, 3 the
                      // last
    by_centroid,      // by depths of triangles; n: which point of them (setting.h)
    alphas_as_submitted,    // sorted, but alphas stay in the order of submission
    colors_as_submitted,    // the same of colours
    as_submitted,           // the last drawn in front; n: the drawing order (setting.h)
    as_submitted_reversed,  // the first drawn in front
    by_instance,            // the last instance in front, each one's layers sorted; n: the order of instances
    faces_apart,            // back faces behind all front faces, each sorted
    averaged,               // one layer, of a weighted average; n: which weights and which alpha (structure.cpp)
    added,                  // colours times alpha added to the background
    weighted_sum,           // colours times alpha, and the background times 1 less all alphas
    through_late,           // what a layer lets through counts for its own colour, too
    multiplied,             // the background times all colours
    greatest,               // MAX of all colours and the background; n: 1 of colours times alpha
    least,                  // MIN
    composed_twice,         // over nothing, and the result over the background by its alpha again
    nearest_of_instance,
    // Some layers, by what they are; `scope` says which, n its number
    some_lost,
    some_doubled,
    alpha_below_lost,  // with alpha below `value`
    alpha_below_kept,  // with alpha not below `value` lost
    behind_drawn,      // behind one that was drawn before: blended surfaces write depth; n: the drawing order
    before_drawn,      // before one that was drawn before
    close_lost,        // within n codes behind the one before it: lost
    close_merged,      // MAX
    close_swapped,
    within_lost,  // the same within `value` of the depth range
    within_merged,
    // Layers of another pixel: n says of which layers (0 all, else one by its number from 1), dx and dy of which pixel
    shifted,
    halved,    // of one pixel of each two by two: dx and dy from the first; n: from which layer on
    mirrored,  // dx 1: left and right exchanged, dy 1: above and below
    // Pixels whose centre lies on an edge
    edges_twice,  // both triangles beside it are drawn
    edges_never,  // neither is
    // The opaque surface and the background
    hidden_shown,      // those behind the opaque surface over it
    hidden_alone,      // those behind the opaque surface, and none before it
    at_opaque_shown,   // those within n codes behind the opaque surface, and at it, too: LEQUAL for LESS
    near_opaque_lost,  // those within n codes before it
    opaque_lost,       // the background behind what is visible
    opaque_ignored,    // the same, and hidden ones shown
    opaque_in_front,   // nothing blended over it
    background_lost,   // black behind all; n: 1 behind layers alone, in place of the opaque surface, too
    background_twice,  // added once more
    background_added,  // added to the layers, as if they let all of it through
    background_other,  // another colour, which the candidate has where nothing is
    surface_lost,      // black behind all, in place of the opaque surface, too
    surface_mixed,     // `value` of the opaque surface, the rest of the colour that was cleared to
    // How layers are blended (composite.h, Mixing)
    veiled,           // what is let through begins as `value`
    through_squared,  // a layer lets through 1 less the square of its alpha
    through_summed,   // 1 less the sum of alphas
    not_attenuated,   // layers are added as they are, the background attenuated
    behind_squared,   // what lies behind the front accumulator is attenuated twice
    behind_inverted,  // by what is not let through
    few_bits,  // n: bits of the accumulator's colours, times 256 those of what is let through, times 65536 of the
               // picture, too
    // Colours, of what `scope` says
    alpha_squared,
    alpha_inverted,
    alpha_ignored,  // 1
    alpha_times,    // `value`
    alpha_root,     // the square root
    color_squared,
    color_root,
    solid,  // alpha 1, colours times alpha as before
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
    turned  // by half a turn
};
inline constexpr std::size_t rule_kind_count = static_cast<std::size_t>(RuleKind::turned) + 1;

// Which layers a rule changes.
enum class Scope : std::uint8_t { all, instance, material, back_faces, front_faces, layer, layer_from_far };

// Pixels [x0, x1) x [y0, y1) of the frame, from the top left.
struct Region {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    [[nodiscard]] constexpr bool is_everywhere() const noexcept { return x1 == 0; }
    [[nodiscard]] constexpr bool has(int x, int y) const noexcept {
        return is_everywhere() || (x >= x0 && x < x1 && y >= y0 && y < y1);
    }
    friend bool operator==(const Region&, const Region&) = default;
};

struct Rule {
    RuleKind kind = RuleKind::right;
    std::uint32_t n = 0;
    float value = 0;
    Scope scope = Scope::all;
    std::uint32_t of = 0;  // the instance's, material's or layer's number
    int dx = 0, dy = 0;    // pixels to the right and down
    Region region{};       // where it goes by the rule
    friend bool operator==(const Rule&, const Rule&) = default;
};

// As JSON names it.
[[nodiscard]] std::string_view name(RuleKind kind) noexcept;

}  // namespace strata::oracle::verdict
