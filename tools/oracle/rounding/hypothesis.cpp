// tools/oracle/rounding/hypothesis.cpp - lists the hypotheses that are tried: combinations of formats, orders and
// roundings, with their words (hypothesis.h).
#include "tools/oracle/rounding/hypothesis.h"

#include <fmt/format.h>

#include <algorithm>

namespace strata::oracle::verdict {

std::string_view name(Storage storage) noexcept {
    switch (storage) {
        case Storage::unorm8: return "8-bit";
        case Storage::unorm10: return "10-bit";
        case Storage::unorm16: return "16-bit";
        case Storage::half: return "binary16";
        case Storage::single: break;
    }
    return "binary32";
}

std::optional<Storage> layer_storage(SourceRounding source) noexcept {
    using enum SourceRounding;
    if (source == stored_half || source == premultiplied_half) return Storage::half;
    if (source == stored_unorm8 || source == premultiplied_unorm8) return Storage::unorm8;
    return std::nullopt;
}

Storage storage_of(Code code) noexcept {
    switch (code) {
        case Code::unorm8: return Storage::unorm8;
        case Code::unorm10: return Storage::unorm10;
        case Code::unorm16:
        case Code::unorm24: return Storage::unorm16;
        case Code::half: return Storage::half;
        case Code::single:
        case Code::integer: break;
    }
    return Storage::single;
}

std::string_view name(Order order) noexcept {
    switch (order) {
        case Order::over: return "back to front";
        case Order::over_apart: return "back to front, apart from the background";
        case Order::under: return "front to back";
        case Order::both_ends: return "from both ends";
        case Order::both_ends_far: return "from both ends, the middle layer behind";
        case Order::both_ends_apart: break;
    }
    return "from both ends, apart from the background";
}

namespace {

std::string_view words(Rounding rounding) noexcept {
    switch (rounding) {
        case Rounding::nearest: return "rounded to nearest";
        case Rounding::truncated: return "cut";
        case Rounding::products: return "each product rounded";
        case Rounding::held: return "rounded to nearest or kept in binary32 for a pass";
        case Rounding::held_then_nearest: return "rounded to nearest or at the end of a pass";
        case Rounding::any: break;
    }
    return "rounded within one code";
}

std::string_view words(SourceRounding source) noexcept {
    switch (source) {
        case SourceRounding::stored:
        case SourceRounding::stored_half:
        case SourceRounding::stored_unorm8:
        case SourceRounding::stored_either_way: return "";
        case SourceRounding::premultiplied_half:
        case SourceRounding::premultiplied_unorm8:
        case SourceRounding::premultiplied:
        case SourceRounding::premultiplied_either_way: return ", premultiplied layers";
        case SourceRounding::premultiplied_truncated: return ", premultiplied layers that are cut";
        case SourceRounding::unrounded: return ", sources not rounded";
        case SourceRounding::any: break;
    }
    return ", sources rounded or not";
}

std::string words(const End& end) {
    if (end.storage == Storage::single)
        return layer_storage(end.source) ? fmt::format("binary32, layers {}", name(*layer_storage(end.source)))
                                         : "binary32";
    if (end.storage == Storage::half && end.rounding != Rounding::any)
        return fmt::format("binary16{}{}", end.rounding == Rounding::truncated ? " that is cut" : "",
                           end.source == SourceRounding::stored ? ", layers too" : "");
    if (end.storage == Storage::half) return "binary16, rounded or cut";
    return fmt::format("{} {}{}", name(end.storage), words(end.rounding), words(end.source));
}

// The ends with this storage, the most general last.
std::vector<End> ends(Storage storage) {
    using enum SourceRounding;
    using R = Rounding;
    if (storage == Storage::half)
        return {{storage, unrounded, R::nearest},
                {storage, unrounded, R::truncated},
                {storage, stored, R::nearest},
                {storage, stored, R::truncated},
                {storage, any, R::any}};
    if (storage == Storage::single) return {{storage, unrounded, R::nearest}};
    return {{storage, stored, R::nearest},
            {storage, stored_either_way, R::nearest},
            {storage, premultiplied, R::nearest},
            {storage, premultiplied_either_way, R::nearest},
            {storage, unrounded, R::nearest},
            {storage, stored, R::truncated},
            {storage, premultiplied_either_way, R::truncated},
            {storage, unrounded, R::truncated},
            {storage, premultiplied_truncated, R::truncated},
            {storage, stored_either_way, R::products},
            {storage, premultiplied_either_way, R::products},
            {storage, unrounded, R::held_then_nearest},
            {storage, unrounded, R::held},
            {storage, any, R::any}};
}

// The ends for combinations of two ends: fewer, because the number of combinations is squared.
std::vector<End> ends_of_pairs(Storage storage) {
    using enum SourceRounding;
    using R = Rounding;
    if (storage == Storage::half) return {{storage, unrounded, R::nearest}, {storage, unrounded, R::truncated}};
    if (storage != Storage::unorm8) return {ends(storage).front()};
    return {{storage, stored, R::nearest},
            {storage, stored_either_way, R::nearest},
            {storage, premultiplied, R::nearest},
            {storage, premultiplied_either_way, R::nearest},
            {storage, unrounded, R::nearest},
            {storage, unrounded, R::truncated},
            {storage, stored, R::truncated},
            {storage, premultiplied_either_way, R::truncated},
            {storage, premultiplied_truncated, R::truncated},
            {storage, stored_either_way, R::products},
            {storage, premultiplied_either_way, R::products}};
}

}  // namespace

std::string describe(const Hypothesis& h) {
    std::string text;
    if (!has_back(h.order))
        text = words(h.front);
    else if (!has_front(h.order) || h.front == h.back)
        text = words(h.back);
    else
        text = fmt::format("{} in front and {} behind", words(h.front), words(h.back));
    text = fmt::format("accumulators {}, {}", text, name(h.order));
    const bool converts = h.result.storage != (has_front(h.order) ? h.front.storage : h.back.storage);
    if (converts) text += fmt::format(", stored in {}", name(h.result.storage));
    if (h.result.rounding == Rounding::truncated) text += ", cut";
    if (h.is_divided) text += ", divided by alpha";
    if (h.slack > 0) text += fmt::format(", colours within {:.3g} of a code of 255", h.slack * 255);
    return text;
}

namespace {

constexpr End anyhow{Storage::unorm8, SourceRounding::any, Rounding::any};

End widest_of(const std::vector<End>& ends) {
    if (ends.size() == 1) return ends[0];
    const Storage storage = ends[0].storage;
    return {storage, storage == Storage::single ? SourceRounding::unrounded : SourceRounding::any,
            storage == Storage::single ? Rounding::nearest : Rounding::any};
}

class FamilyMaker {
  public:
    FamilyMaker(Storage result, const std::vector<double>& slacks, Looseness looseness, bool is_divided)
        : result_{result}, slacks_{slacks}, looseness_{looseness}, is_divided_{is_divided} {}

    void add(Order order, const std::vector<End>& fronts, const std::vector<End>& backs) {
        HypothesisFamily family;
        family.widest = {.order = order,
                         .front = widest_of(fronts),
                         .back = widest_of(backs),
                         .result = {result_, SourceRounding::any, Rounding::any},
                         .slack = slacks_.back(),
                         .is_divided = is_divided_};
        for (const double slack : slacks_)
            for (const End& front : fronts)
                for (const End& back : backs) add(order, front, back, slack, family);
        if (!family.members.empty()) made_.push_back(std::move(family));
    }
    // For `over` and `under`, which have the same end in front and behind.
    void add(Order order, const std::vector<End>& ends) {
        HypothesisFamily family;
        const End widest = widest_of(ends);
        family.widest = {.order = order,
                         .front = widest,
                         .back = widest,
                         .result = {result_, SourceRounding::any, Rounding::any},
                         .slack = slacks_.back(),
                         .is_divided = is_divided_};
        for (const double slack : slacks_)
            for (const End& end : ends) add(order, end, end, slack, family);
        if (!family.members.empty()) made_.push_back(std::move(family));
    }
    [[nodiscard]] Families made() && { return std::move(made_); }

  private:
    void add(Order order, const End& front, const End& back, double slack, HypothesisFamily& family) const {
        const auto is_loose = [](const End& end) { return end.rounding == Rounding::any && has_codes(end.storage); };
        if (looseness_ == Looseness::definite && (is_loose(front) || is_loose(back))) return;
        // What a pass keeps in binary32 is in a picture of floats only if one program composites all layers.
        if (!has_codes(result_) && (front.rounding == Rounding::held || back.rounding == Rounding::held)) return;
        // Codes show nothing of how halves were rounded, so that these hypotheses would only fit more mistakes.
        const auto is_fine = [](const End& end) {
            return end.storage == Storage::half && end.rounding != Rounding::any &&
                   (end.rounding == Rounding::truncated || end.source == SourceRounding::stored);
        };
        if (has_codes(result_) && (is_fine(front) || is_fine(back))) return;
        const End nearest{result_, SourceRounding::unrounded, Rounding::nearest};
        family.members.push_back({.order = order,
                                  .front = front,
                                  .back = back,
                                  .result = nearest,
                                  .slack = slack,
                                  .is_divided = is_divided_});
        // A device that cuts the results of blends also cuts the final sum, which `over` does not have.
        const bool is_cut = order != Order::over && front.rounding == Rounding::truncated;
        const bool may_cut =
            has_codes(result_) || (result_ == Storage::half && (front.storage == Storage::single || is_cut));
        if (!may_cut || has_codes(front.storage)) return;
        family.members.push_back(family.members.back());
        family.members.back().result.rounding = Rounding::truncated;
    }

    Storage result_;
    std::vector<double> slacks_;
    Looseness looseness_;
    bool is_divided_;
    Families made_{};
};

}  // namespace

Families families(Storage result, const std::vector<double>& slacks, Looseness looseness, bool is_divided) {
    constexpr Storage storages[] = {Storage::unorm8, Storage::single, Storage::half, Storage::unorm10};
    FamilyMaker maker{result, slacks, looseness, is_divided};
    for (const Storage storage : storages) {
        for (const Order order : {Order::over, Order::over_apart, Order::under}) maker.add(order, ends(storage));
        // A port may keep the opaque scene in 8 bits while other accumulators have another format.
        if (storage != Storage::unorm8)
            maker.add(Order::under, ends(storage), {{Storage::unorm8, SourceRounding::stored, Rounding::nearest}});
        if (storage == Storage::single) maker.add(Order::under, ends(storage), ends(Storage::half));  // or in binary16
        // A port may store layers as halves or codes and composite all of them in one program.
        using enum SourceRounding;
        if (storage == Storage::single && !has_codes(result))
            for (const Order order : {Order::over, Order::under})
                for (const SourceRounding source :
                     {stored_half, premultiplied_half, stored_unorm8, premultiplied_unorm8})
                    maker.add(order, {{storage, source, Rounding::nearest}});
    }
    for (const Order order : {Order::both_ends, Order::both_ends_far, Order::both_ends_apart})
        for (const Storage front : storages)
            for (const Storage back : storages) maker.add(order, ends_of_pairs(front), ends_of_pairs(back));
    return std::move(maker).made();
}

std::vector<Hypothesis> widest(const Families& all) {
    std::vector<Hypothesis> one_an_order;
    for (const HypothesisFamily& family : all) {
        const auto is_there = std::ranges::find(one_an_order, family.widest.order, &Hypothesis::order);
        if (is_there != one_an_order.end()) continue;
        // Every storage has at least 8 bits, so 8-bit ends include the errors of all.
        Hypothesis wide = family.widest;
        wide.front = wide.back = anyhow;
        one_an_order.push_back(wide);
    }
    return one_an_order;
}

}  // namespace strata::oracle::verdict
