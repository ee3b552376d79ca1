// tools/oracle/program/drawing/lookups.h - where a port reads what another pass has written: its own pixel, or another.
//
// Rule     A place is moved by some pixels, mirrored, or that of the first pixel of a block of two by two; a filtered
//          one is the mean of the pixels between which it lies. Outside of the frame is the nearest pixel inside, or
//          nothing.
// Tests    tests/tools/oracle/program/drawing_test.cpp
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "tools/oracle/program/drawing/opaque_pass.h"

namespace strata::oracle::program {

struct Lookup {
    std::string_view words{};  // "upside down"
    int right = 0, down = 0;
    bool mirrors_x = false, mirrors_y = false, is_half_size = false;
    bool is_filtered = false;  // half of `right` and `down`
    bool clamps = true;
    [[nodiscard]] bool moves() const noexcept { return right != 0 || down != 0; }
};
[[nodiscard]] std::span<const Lookup> lookups();
inline constexpr double price_of_lookup = 6;

// Some layers of every pixel.
struct LayerChoice {
    std::string_view words{};
    double price = 0;
    bool is_one = false;  // "is", not "are"
    bool (*has)(const ListPixel& pixel, std::size_t rank) = nullptr;
};
[[nodiscard]] std::span<const LayerChoice> layer_choices();
[[nodiscard]] Lists empty_like(const Lists& given);
// A pixel without fragments, to which the next fragments of `made` belong.
ListPixel& add_like(const ListPixel& pixel, Lists& made);

// The pixels of lists by their place.
class PixelPlaces {
  public:
    explicit PixelPlaces(const Lists& lists) : lists_{&lists} {}
    [[nodiscard]] const Lists& lists() const noexcept { return *lists_; }
    // The pixels that are read at a pixel, by number; fewer are left where it lies outside.
    void read(const Lookup& lookup, const ListPixel& pixel, std::vector<std::size_t>& found) const;
    [[nodiscard]] static double weight(const Lookup& lookup) noexcept;  // of each

  private:
    const Lists* lists_;
};

// Of lists that are tried on some pixels, the few that cost least.
class CheapLists {
  public:
    explicit CheapLists(const Lists& given);
    // `make(step)`: the lists of every `step`th pixel. Returns false if a few pixels show that they do not help.
    template <class Make>
    bool add(std::string words, double price, const Make& make) {
        if (cost_of(make(coarse_.step)) > 0.9 * coarse_.right) return false;
        const double cost = cost_of(make(fine_.step)) + price;
        if (is_kept(cost)) keep(cost, {std::move(words), price, make(1)});
        return true;
    }
    [[nodiscard]] std::vector<OtherLists> best() &&;

  private:
    [[nodiscard]] double cost_of(const Lists& lists) const;
    [[nodiscard]] bool is_kept(double cost) const;
    void keep(double cost, OtherLists lists);

    struct Some {
        std::size_t step = 1;
        double right = 0;  // cost of the given lists
    };
    [[nodiscard]] static Some some_of(const Lists& given, std::size_t pixels);

    Some coarse_, fine_;
    std::vector<std::pair<double, OtherLists>> kept_{};
};

// Textures of layers that are read at other places.
[[nodiscard]] std::vector<OtherLists> other_lookups(const Lists& given);
// Layers with colours that the scene has without fog, without light, without textures, or on the other side.
[[nodiscard]] std::vector<OtherLists> other_colors(const peeling::FrameRequest& input, const Lists& given,
                                                   const verdict::Colors& candidate);
// Peels that compare with another depth than that of the layer before.
[[nodiscard]] std::vector<OtherLists> other_peels(const Lists& given);

}  // namespace strata::oracle::program
