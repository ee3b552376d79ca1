// tests/tools/oracle/verdict/port_model.h - a model of a port: composites layers step by step in the formats that a
// hypothesis states. It shares no function and no constant with the product. Where the hypothesis leaves a choice, a
// random generator decides.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tools/oracle/rounding/composite.h"

namespace strata::test {

class PortModel {
  public:
    using Hypothesis = oracle::verdict::Hypothesis;
    using End = oracle::verdict::End;
    using SourceRounding = oracle::verdict::SourceRounding;
    using Rounding = oracle::verdict::Rounding;
    using Storage = oracle::verdict::Storage;
    using Order = oracle::verdict::Order;
    using Color = std::array<double, 4>;

    PortModel(const Hypothesis& h, std::uint64_t seed) : h_{h}, random_{seed} {}

    // The finished pixel as values.
    [[nodiscard]] Color composite(const oracle::verdict::Stack& stack) {
        const auto& layers = stack.layers;
        const bool is_under = h_.order == Order::under;
        const bool is_over = h_.order == Order::over || h_.order == Order::over_apart;
        const bool is_apart = h_.order == Order::over_apart || h_.order == Order::both_ends_apart;
        std::size_t near = is_under ? layers.size() : is_over ? 0 : stack.near;
        if (h_.order == Order::both_ends_far) near = stack.near_without_middle;
        const Color behind = background(h_.back, stack.background);
        Color back = is_apart ? Color{0, 0, 0, 0} : behind;
        for (std::size_t i = layers.size(); i-- > near;) over(h_.back, layers[i], back);
        end_pass(h_.back, back);
        if (is_apart) {
            const double through = 1 - back[3];
            for (std::size_t c = 0; c < 4; ++c) back[c] = as_single(back[c] + as_single(through * behind[c]));
            if (is_over) return published(back);
        }
        if (is_over) return h_.result.storage == h_.back.storage && !is_held(h_.back) ? back : published(back);
        Color front{0, 0, 0, 1};
        for (std::size_t i = 0; i < near; ++i) under(h_.front, layers[i], front);
        end_pass(h_.front, front);
        Color sum;
        for (std::size_t c = 0; c < 3; ++c) sum[c] = as_single(front[c] + as_single(front[3] * back[c]));
        sum[3] = 1 - front[3] * (1 - back[3]);
        return published(sum);
    }

  private:
    static bool is_held(const End& end) {
        return end.rounding == Rounding::held || end.rounding == Rounding::held_then_nearest ||
               end.rounding == Rounding::any;
    }
    bool flips() { return (random_() >> 17 & 1) != 0; }
    static double as_single(double v) { return static_cast<float>(v); }
    static int levels(Storage s) {
        return s == Storage::unorm8 ? 255 : s == Storage::unorm10 ? 1023 : s == Storage::unorm16 ? 65535 : 0;
    }

    // Rounds to 11 bits: to nearest with ties to even, or truncated.
    static double as_half(double v, bool truncates) {
        if (v == 0) return 0;
        int exponent = 0;
        static_cast<void>(std::frexp(v, &exponent));
        const double unit = std::ldexp(1.0, std::max(exponent - 11, -24));
        const double n = v / unit;
        return unit * (truncates ? std::trunc(n) : std::nearbyint(n));
    }

    // Stores a blend's result, which is exact or nearly so, in the format of the end.
    double kept(const End& end, double v) {
        const int top = levels(end.storage);
        if (end.storage == Storage::single) return as_single(v);
        const bool truncates = end.rounding == Rounding::truncated || (end.rounding == Rounding::any && flips());
        if (end.storage == Storage::half) return as_half(as_single(v), truncates);
        const double code = std::min(std::max(v, 0.0), 1.0) * top;
        switch (end.rounding) {
            case Rounding::nearest:
            case Rounding::products: return std::floor(code + 0.5) / top;
            // A result that is exactly a code may have been computed slightly below it.
            case Rounding::truncated: return std::floor(code + 1e-9) / top;
            case Rounding::held:
            case Rounding::held_then_nearest: return flips() ? std::floor(code + 0.5) / top : as_single(v);
            case Rounding::any: break;
        }
        const int way = static_cast<int>(random_() % 4);
        const double whole = way == 0 ? std::floor(code) : way == 1 ? std::ceil(code) : std::floor(code + 0.5);
        return way == 3 ? as_single(v) : whole / top;
    }

    // The source as it is blended, after its conversion.
    double taken(const End& end, double v) {
        if (end.source == SourceRounding::stored_half || end.source == SourceRounding::premultiplied_half)
            return as_half(v, false);
        if (end.source == SourceRounding::stored_unorm8 || end.source == SourceRounding::premultiplied_unorm8)
            return std::floor(std::min(std::max(v, 0.0), 1.0) * 255 + 0.5) / 255;
        const int top = levels(end.storage);
        const bool is_rounded =
            end.source != SourceRounding::unrounded && (end.source != SourceRounding::any || flips());
        if (!is_rounded) return top > 0 ? std::min(std::max(v, 0.0), 1.0) : v;
        if (end.storage == Storage::single) return v;
        if (end.storage == Storage::half)
            return as_half(v, end.source == SourceRounding::any ? flips() : end.rounding == Rounding::truncated);
        const double code = std::min(std::max(v, 0.0), 1.0) * top;
        if (end.source == SourceRounding::premultiplied_truncated) return std::floor(code + 1e-9) / top;
        const bool goes_up =
            end.source == SourceRounding::stored || end.source == SourceRounding::premultiplied || flips();
        return (goes_up ? std::floor(code + 0.5) : std::ceil(code - 0.5)) / top;
    }
    bool premultiplies(const End& end) {
        return end.source == SourceRounding::premultiplied || end.source == SourceRounding::premultiplied_either_way ||
               end.source == SourceRounding::premultiplied_truncated ||
               end.source == SourceRounding::premultiplied_half || end.source == SourceRounding::premultiplied_unorm8 ||
               (end.source == SourceRounding::any && flips());
    }

    Color background(const End& end, const Rgba& given) {
        Color color;
        const int top = levels(end.storage);
        for (std::size_t c = 0; c < 4; ++c) {
            const double code = std::min(std::max(double{given[c]}, 0.0), 1.0) * top;
            const bool goes_up =
                end.source == SourceRounding::stored || end.source == SourceRounding::premultiplied || flips();
            const bool is_layer = end.storage == Storage::single && end.source != SourceRounding::unrounded;
            color[c] = is_layer  ? taken(end, given[c])
                       : top > 0 ? (goes_up ? std::floor(code + 0.5) : std::ceil(code - 0.5)) / top
                                 : kept(end, given[c]);
        }
        return color;
    }

    void over(const End& end, const oracle::verdict::Layer& layer, Color& onto) {
        const double alpha = taken(end, layer.color[3]);
        const bool is_premultiplied = premultiplies(end);
        for (std::size_t c = 0; c < 4; ++c) {
            const double given = c == 3 ? 1.0 : double{layer.color[c]};
            // A program multiplies in binary32.
            const double source = c == 3             ? (is_premultiplied ? alpha : 1.0)
                                  : is_premultiplied ? taken(end, as_single(given * layer.color[3]))
                                                     : taken(end, given);
            const double first = is_premultiplied ? source : source * alpha, second = (1 - alpha) * onto[c];
            if (end.rounding == Rounding::products && !is_premultiplied && levels(end.storage) > 0) {
                const double top = levels(end.storage);
                onto[c] = std::min((std::floor(first * top + 0.5) + std::floor(second * top + 0.5)) / top, 1.0);
            } else {
                onto[c] = kept(end, first + second);
            }
        }
    }

    void under(const End& end, const oracle::verdict::Layer& layer, Color& sum) {
        const double alpha = taken(end, layer.color[3]);
        const bool is_premultiplied = premultiplies(end);
        const double through = sum[3];
        for (std::size_t c = 0; c < 3; ++c) {
            const double source = is_premultiplied ? taken(end, as_single(double{layer.color[c]} * layer.color[3]))
                                                   : taken(end, layer.color[c]) * alpha;
            sum[c] = kept(end, sum[c] + through * source);
        }
        // Half of the ports store coverage instead of transmittance, none of those that cut halves.
        const bool cuts_halves = end.storage == Storage::half && end.rounding == Rounding::truncated;
        sum[3] = cuts_halves || flips() ? kept(end, through * (1 - alpha)) : 1 - kept(end, 1 - through * (1 - alpha));
    }

    static void end_pass(const End& end, Color& sum) {
        if (end.rounding != Rounding::held_then_nearest) return;
        const int top = levels(end.storage);
        for (double& v : sum) v = std::floor(v * top + 0.5) / top;
    }

    Color published(const Color& color) {
        Color result;
        for (std::size_t c = 0; c < 4; ++c) result[c] = kept(h_.result, color[c]);
        return result;
    }

    Hypothesis h_;
    std::mt19937_64 random_;
};

}  // namespace strata::test
