// tools/oracle/verdict/structure.h - which fragments of a pixel are composited, and in which order: layers over a background.
//
// Rule     A right structure has all visible fragments of a pixel, near to far. Of fragments at one depth peels keep the first, the last, all or a
//          mixture (keys-and-counts.md 2.2); each is right, and a picture goes by one of them. A wrong one comes from a rule (rule.h).
// Tests    tests/tools/oracle/verdict/structure_test.cpp, search_test.cpp
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "tools/oracle/verdict/composite.h"
#include "tools/oracle/verdict/fragments.h"
#include "tools/oracle/verdict/rule.h"

namespace strata::oracle::verdict {

enum class TieRule : std::uint8_t {
    first,           // all, the first submitted in front
    last,            // all, the last submitted in front
    unique,          // the first submitted alone
    unique_last,     // the last submitted alone
    merged,          // one layer, MAX of each channel: premultiplied in the near half, straight in the far half
    first_then_last  // `first` in the near half of the depths, `last` in the far half
};
enum class DepthKey : std::uint8_t {
    code,
    shader_z
};  // what is one depth: the stored code, or binary32 as a program sees it

struct Ties {
    TieRule rule = TieRule::first;
    DepthKey key = DepthKey::code;
    friend bool operator==(const Ties&, const Ties&) = default;
};
inline constexpr std::size_t ties_count = 12;
// All, in the order of the enums: number n has bit n in a mask of them.
[[nodiscard]] Ties ties_number(std::size_t number) noexcept;
[[nodiscard]] std::string_view describe(const Ties& ties) noexcept;

// Whether some of a pixel's visible fragments lie at one depth, or the two depths order them differently.
[[nodiscard]] bool has_ties(std::span<const Fragment> visible) noexcept;

class StackMaker {
  public:
    // Without geometry.
    explicit StackMaker(const Rgba& cleared) : cleared_{cleared} {}
    // The references hold until the next call.
    [[nodiscard]] const Stack& right(const PixelList& pixel, const Ties& ties) { return with({}, pixel, ties); }
    // Rules are applied one after the other.
    [[nodiscard]] const Stack& with(std::span<const Rule> rules, const PixelList& pixel, const Ties& ties);

  private:
    struct Item {
        Layer layer{};
        const Fragment* fragment = nullptr;  // the first, of a mixture
        std::size_t depth = 0;               // number of its depth, from the near end
    };

    void list(std::span<const Rule> rules, const PixelList& pixel, const Ties& ties);
    void apply(const Rule& rule, const PixelList& pixel);
    void add_group(std::span<const Fragment* const> group, TieRule rule, bool is_near, std::size_t depth);
    void choose(const Rule& rule, const PixelList& pixel);
    void keep(std::size_t first, std::size_t last);  // of the items
    void order(const Rule& rule);
    void edit_one(const Rule& rule);
    void edit_close(const Rule& rule);
    void combine(const Rule& rule, std::size_t from);  // items from number `from` on
    void recolor(const Rule& rule);
    void set_background(const Rule& rule, const PixelList& pixel);
    void finish(std::span<const Rule> rules);

    Rgba cleared_;
    Stack stack_{};
    std::size_t depths_ = 0;
    std::vector<const Fragment*> order_{};
    std::vector<Item> items_{};
};

}  // namespace strata::oracle::verdict
