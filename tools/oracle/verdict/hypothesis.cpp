#include "tools/oracle/verdict/hypothesis.h"

#include <fmt/format.h>

#include <algorithm>

namespace strata::oracle::verdict {

std::string_view name(Storage storage) noexcept {
    switch (storage) {
        case Storage::unorm8: return "8-bit";
        case Storage::unorm10: return "10-bit";
        case Storage::unorm16: return "16-bit";
        case Storage::half: return "binary16";
        case Storage::single: return "binary32";
    }
    return "";  // unreachable: the enum is closed
}

Storage storage_of(Code code) noexcept {
    switch (code) {
        case Code::unorm8: return Storage::unorm8;
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
        case Order::both_ends_apart: return "from both ends, apart from the background";
    }
    return "";  // unreachable: the enum is closed
}

namespace {

std::string_view words(Rounding rounding) noexcept {
    switch (rounding) {
        case Rounding::nearest: return "rounded to nearest";
        case Rounding::cut: return "cut";
        case Rounding::products: return "each product rounded";
        case Rounding::held: return "rounded to nearest or kept in binary32 for a pass";
        case Rounding::any: return "rounded within one code";
    }
    return "";  // unreachable: the enum is closed
}

std::string_view words(Source source) noexcept {
    switch (source) {
        case Source::stored:
        case Source::stored_either_way: return "";
        case Source::premultiplied:
        case Source::premultiplied_either_way: return ", premultiplied layers";
        case Source::unrounded: return ", sources not rounded";
        case Source::any: return ", sources rounded or not";
    }
    return "";  // unreachable: the enum is closed
}

std::string words(const End& end) {
    if (end.storage == Storage::single) return "binary32";
    if (end.storage == Storage::half) return end.rounding == Rounding::any ? "binary16, rounded or cut" : "binary16";
    return fmt::format("{} {}{}", name(end.storage), words(end.rounding), words(end.source));
}

// Ends that keep colours in `storage`, the widest last.
std::vector<End> ends(Storage storage) {
    using enum Source;
    using R = Rounding;
    if (storage == Storage::half) return {{storage, unrounded, R::nearest}, {storage, any, R::any}};
    if (storage == Storage::single) return {{storage, unrounded, R::nearest}};
    return {{storage, stored, R::nearest},
            {storage, stored_either_way, R::nearest},
            {storage, premultiplied, R::nearest},
            {storage, premultiplied_either_way, R::nearest},
            {storage, unrounded, R::nearest},
            {storage, stored, R::cut},
            {storage, premultiplied_either_way, R::cut},
            {storage, unrounded, R::cut},
            {storage, stored_either_way, R::products},
            {storage, unrounded, R::held},
            {storage, any, R::any}};
}

// Of two ends that meet in one picture: fewer kinds, for their number is squared.
std::vector<End> ends_of_pairs(Storage storage) {
    using enum Source;
    using R = Rounding;
    if (storage != Storage::unorm8) return {ends(storage).front()};
    return {{storage, stored, R::nearest},
            {storage, stored_either_way, R::nearest},
            {storage, premultiplied, R::nearest},
            {storage, premultiplied_either_way, R::nearest},
            {storage, unrounded, R::nearest},
            {storage, unrounded, R::cut},
            {storage, stored, R::cut},
            {storage, premultiplied_either_way, R::cut},
            {storage, stored_either_way, R::products}};
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
    if (h.result.rounding == Rounding::cut) text += ", cut";
    if (h.slack > 0) text += fmt::format(", colours within {:.3g} of a code of 255", h.slack * 255);
    return text;
}

std::vector<Hypothesis> hypotheses(Storage result) {
    const std::vector<Storage> storages{Storage::unorm8, Storage::unorm10, Storage::half, Storage::single};
    const End nearest{result, Source::unrounded, Rounding::nearest};
    const End cut{result, Source::unrounded, Rounding::cut};
    const bool has_codes = result == Storage::unorm8 || result == Storage::unorm10 || result == Storage::unorm16;
    // The least that any of the others keeps: what an 8-bit accumulator or the result itself may lose.
    const End widest{Storage::unorm8, Source::any, Rounding::any};
    std::vector<Hypothesis> all;
    const auto add = [&](Order order, const End& front, const End& back) {
        all.push_back({.order = order, .front = front, .back = back, .result = nearest});
        const bool is_float = front.storage == Storage::half || front.storage == Storage::single;
        if (has_codes && is_float) all.push_back({.order = order, .front = front, .back = back, .result = cut});
    };
    const auto add_widest = [&](Order order) {
        all.push_back(
            {.order = order, .front = widest, .back = widest, .result = {result, Source::any, Rounding::any}});
    };
    for (const Order order : {Order::over, Order::over_apart}) {
        for (const Storage storage : storages)
            for (const End& end : ends(storage)) add(order, end, end);
        add_widest(order);
    }
    for (const Storage storage : storages)
        for (const End& end : ends(storage)) {
            add(Order::under, end, end);
            // The opaque scene may be kept in 8 bits beside float accumulators.
            if (storage != Storage::unorm8)
                add(Order::under, end, {Storage::unorm8, Source::stored, Rounding::nearest});
        }
    add_widest(Order::under);
    for (const Order order : {Order::both_ends, Order::both_ends_far, Order::both_ends_apart}) {
        for (const Storage front : storages)
            for (const Storage back : storages)
                for (const End& f : ends_of_pairs(front))
                    for (const End& b : ends_of_pairs(back)) add(order, f, b);
        add_widest(order);
    }
    return all;
}

std::vector<Hypothesis> widest(const std::vector<Hypothesis>& all) {
    std::vector<Hypothesis> last;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (i + 1 == all.size() || all[i + 1].order != all[i].order) last.push_back(all[i]);
    return last;
}

}  // namespace strata::oracle::verdict
