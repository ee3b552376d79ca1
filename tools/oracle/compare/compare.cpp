// tools/oracle/compare/compare.cpp - decides the kind of each differing pixel and whether the tolerances and budgets
// accept it (compare.h).
#include "tools/oracle/compare/compare.h"

#include <algorithm>
#include <cmath>

#include "peeling/audit/image_error.h"
#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/float_environment.h"
#include "tools/oracle/compare/layers.h"

namespace strata::oracle {

std::string_view name(Kind kind) noexcept { return enum_name(kind); }

namespace {

// Over all targets, the worst distance of a pixel's depths and of its other codes, whether one of them is beyond its
// target's tolerance, whether one of them is NaN or infinite, and whether one of them is seen.
struct Distances {
    explicit Distances(std::size_t pixels)
        : color(pixels), depth(pixels), is_beyond(pixels), is_not_finite(pixels), is_seen(pixels) {}
    std::vector<std::uint32_t> color, depth;
    std::vector<bool> is_beyond, is_not_finite, is_seen;
};

// Straight colours with alpha: where it is 0 in both images, they have no effect on what is seen.
bool may_be_unseen(const TargetPair& pair) {
    const auto is_straight = [](const TargetImage& t) {
        return t.meaning == Meaning::color && t.alpha_form == AlphaForm::straight &&
               t.channels == (t.is_grey ? 2 : 4) && t.code != Code::integer;
    };
    return is_straight(*pair.reference) && is_straight(*pair.candidate);
}

bool has_alpha_0(const TargetPair& pair, std::size_t pixel) {
    const int alpha = pair.channels() - 1;
    return pair.reference->value_at(pixel, alpha) == 0 && pair.candidate->value_at(pixel, alpha) == 0;
}

// Over all channels, pixel by pixel, in binary64.
void measure_noise(const TargetPair& pair, TargetReport& report) {
    if (pair.reference->meaning != Meaning::color || pair.reference->code == Code::integer) return;
    double squares = 0;
    for (std::size_t i = 0; i < pair.reference->pixels(); ++i)
        for (int c = 0; c < pair.channels() && !pair.has_same_words(i); ++c) {
            const double apart = 255 * (pair.candidate->value_at(i, c) - pair.reference->value_at(i, c));
            squares += apart * apart;
        }
    const double rmse = std::sqrt(squares / static_cast<double>(pair.reference->codes.size()));
    if (!std::isfinite(rmse) || rmse == 0) return;
    report.rmse = rmse;
    report.psnr = peeling::signal_to_noise(rmse);
}

// Counts a differing pixel if one of its values has the property.
bool add_if(NotFinite& found, const TargetPair& pair, std::size_t pixel, bool (*is_so)(double)) {
    const auto has = [&](const TargetImage& target) {
        for (int c = 0; c < std::min(target.channels, pair.channels()); ++c)
            if (is_so(target.value_at(pixel, c))) return true;
        return false;
    };
    const bool in_reference = has(*pair.reference), in_candidate = has(*pair.candidate);
    if (!in_reference && !in_candidate) return false;
    found.pixels[0] += in_reference ? 1 : 0;
    found.pixels[1] += in_candidate ? 1 : 0;
    if (found.first_x >= 0) return true;
    found.first_x = static_cast<int>(pixel % static_cast<std::size_t>(pair.reference->width));
    found.first_y = static_cast<int>(pixel / static_cast<std::size_t>(pair.reference->width));
    return true;
}

bool is_float(const TargetImage& target) { return target.code == Code::half || target.code == Code::single; }

// True if the pixel is not finite in one of the images.
bool count_not_finite(const TargetPair& pair, std::size_t pixel, TargetReport& report) {
    if (!is_float(*pair.reference) && !is_float(*pair.candidate)) return false;
    const bool has_nan = add_if(report.nan, pair, pixel, [](double v) { return std::isnan(v); });
    const bool has_infinity = add_if(report.infinite, pair, pixel, [](double v) { return std::isinf(v); });
    return has_nan || has_infinity;
}

void measure(const TargetPair& pair, const Tolerances& tolerances, Distances& worst, Comparison& result) {
    TargetReport report{.part = pair.reference->part,
                        .name = pair.reference->name,
                        .reference = pair.reference->code,
                        .candidate = pair.candidate->code,
                        .channels = pair.channels()};
    const std::uint32_t allowed = tolerances.codes_of(*pair.reference);
    const bool may_hide = may_be_unseen(pair);
    std::vector<std::uint32_t>& of_kind = pair.reference->meaning == Meaning::depth ? worst.depth : worst.color;
    for (std::size_t i = 0; i < pair.reference->pixels(); ++i) {
        const std::uint32_t apart = pair.distance_at(i);
        if (apart == 0) continue;
        ++report.differing;
        worst.is_seen[i] = worst.is_seen[i] || !may_hide || !has_alpha_0(pair, i);
        if (count_not_finite(pair, i, report)) {
            worst.is_not_finite[i] = true;
        } else {
            ++report.distances[apart];
            report.greatest = std::max(report.greatest, apart);
        }
        of_kind[i] = std::max(of_kind[i], apart);
        if (apart <= allowed) continue;
        ++report.beyond;
        worst.is_beyond[i] = true;
    }
    if (report.differing > 0) measure_noise(pair, report);
    result.targets.push_back(std::move(report));
}

class Sorter {
  public:
    Sorter(const Picture& reference, const Picture& candidate, const Pairing& pairing, const Background& background)
        : reference_layers_{layers_of(reference)},
          candidate_layers_{layers_of(candidate)},
          masks_{drawn(pairing.pairs, background)} {}

    [[nodiscard]] const std::optional<Masks>& masks() const { return masks_; }
    [[nodiscard]] bool has_layers() const { return !reference_layers_.empty() && !candidate_layers_.empty(); }

    [[nodiscard]] Kind kind_of(std::size_t pixel, const Distances& worst) const {
        if (worst.is_not_finite[pixel]) return Kind::not_finite;
        if (has_layers()) {
            const Kind kind = compare_layers(reference_layers_, candidate_layers_, pixel);
            if (kind != Kind::none) return kind;
        }
        if (worst.color[pixel] == 0 && worst.depth[pixel] == 0) return Kind::none;
        if (!worst.is_seen[pixel]) return Kind::unseen;
        if (masks_ && masks_->reference[pixel] != masks_->candidate[pixel]) return Kind::coverage;
        if (masks_ && !masks_->reference[pixel]) return Kind::background;
        return worst.depth[pixel] != 0 ? Kind::depth : Kind::color;
    }

    // Layers and the background have no tolerance in codes of their own: their colours and depths have.
    [[nodiscard]] static bool is_forgiven(Kind kind, std::size_t pixel, const Distances& worst) {
        switch (kind) {
            case Kind::unseen:
            case Kind::background:
            case Kind::depth:
            case Kind::color: return !worst.is_beyond[pixel];
            case Kind::none: return true;
            default: return false;
        }
    }

  private:
    std::vector<LayerTarget> reference_layers_, candidate_layers_;
    std::optional<Masks> masks_;
};

std::array<bool, kind_count> tested_kinds(const std::vector<TargetPair>& pairs, const Sorter& sorter) {
    std::array<bool, kind_count> tested{};
    const auto of = [&](Kind kind) -> bool& { return tested[static_cast<std::size_t>(kind)]; };
    of(Kind::coverage) = of(Kind::background) = sorter.masks().has_value();
    for (const Kind kind :
         {Kind::layer_missing, Kind::layer_doubled, Kind::layer_swapped, Kind::layer_merged, Kind::layer_other})
        of(kind) = sorter.has_layers();
    for (const TargetPair& pair : pairs)
        of(pair.reference->meaning == Meaning::depth ? Kind::depth : Kind::color) = true;
    of(Kind::unseen) = std::ranges::any_of(pairs, may_be_unseen);
    for (const TargetPair& pair : pairs)
        if (is_float(*pair.reference) || is_float(*pair.candidate)) of(Kind::not_finite) = true;
    return tested;
}

// Adds a pixel to the report of its kind. The first pixel is the first that is not accepted.
void add(std::vector<KindReport>& kinds, Kind kind, std::size_t pixel, int width, bool forgiven) {
    KindReport& report = kinds[static_cast<std::size_t>(kind)];
    report.kind = kind;
    ++report.pixels;
    if (report.first_x < 0 || (!forgiven && report.beyond == 0)) {
        report.first_x = static_cast<int>(pixel % static_cast<std::size_t>(width));
        report.first_y = static_cast<int>(pixel / static_cast<std::size_t>(width));
    }
    report.beyond += forgiven ? 0 : 1;
}

// Uses the budget for pixels of these kinds that are beyond the tolerance in codes: for all of them or for none.
void spend(std::string_view name, const PixelBudget& budget, std::span<const Kind> of, std::vector<KindReport>& kinds,
           Comparison& result) {
    const std::uint64_t allowed =
        budget.allowed(static_cast<std::uint64_t>(result.width) * static_cast<std::uint64_t>(result.height));
    if (allowed == 0) return;
    std::uint64_t beyond = 0;
    for (const Kind kind : of) beyond += kinds[static_cast<std::size_t>(kind)].beyond;
    result.spent.push_back({name, beyond, allowed});
    if (beyond > allowed) return;
    for (const Kind kind : of) kinds[static_cast<std::size_t>(kind)].beyond = 0;
}

void spend_all(const Tolerances& t, std::vector<KindReport>& kinds, Comparison& result) {
    using enum Kind;
    constexpr std::array layers{layer_missing, layer_doubled, layer_swapped, layer_merged, layer_other};
    constexpr std::array coverages{coverage}, backgrounds{background}, depths{depth}, colors{color},
        not_numbers{not_finite}, hidden{unseen};
    constexpr std::array all{coverage,     background,  layer_missing, layer_doubled, layer_swapped,
                             layer_merged, layer_other, depth,         color,         unseen};
    spend("coverage", t.coverage, coverages, kinds, result);
    spend("background", t.background, backgrounds, kinds, result);
    spend("layers", t.layers, layers, kinds, result);
    spend("depth-pixels", t.depth, depths, kinds, result);
    spend("color-pixels", t.color, colors, kinds, result);
    spend("unseen", t.unseen, hidden, kinds, result);
    spend("pixels", t.pixels, all, kinds, result);
    spend("not-finite", t.not_finite, not_numbers, kinds, result);
}

}  // namespace

Comparison compare(const Picture& reference, const Picture& candidate, const Tolerances& tolerances,
                   const Background& background) {
    const FloatEnvironment ours;
    const Pairing pairing = pair_targets(reference, candidate, tolerances.channels);
    const TargetImage& first = *pairing.pairs[0].reference;
    const std::size_t pixels = first.pixels();
    Comparison result{.width = first.width, .height = first.height};
    result.not_compared = pairing.not_compared;
    result.notes = pairing.notes;
    Distances worst(pixels);
    for (const TargetPair& pair : pairing.pairs) measure(pair, tolerances, worst, result);

    const Sorter sorter{reference, candidate, pairing, background};
    result.is_tested = tested_kinds(pairing.pairs, sorter);
    std::vector<KindReport> kinds(kind_count);
    result.kind_of.resize(pixels);
    result.distance_of.resize(pixels);
    result.is_beyond.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const Kind kind = sorter.kind_of(i, worst);
        result.kind_of[i] = kind;
        result.distance_of[i] = std::max(worst.color[i], worst.depth[i]);
        if (kind == Kind::none) continue;
        ++result.differing;
        result.is_beyond[i] = !Sorter::is_forgiven(kind, i, worst);
        add(kinds, kind, i, result.width, !result.is_beyond[i]);
    }
    KindReport& coverage = kinds[static_cast<std::size_t>(Kind::coverage)];
    if (coverage.pixels > 0)
        coverage.detail = compare_coverage(*sorter.masks(), result.width, result.height).description();
    kinds[static_cast<std::size_t>(Kind::unseen)].detail = "alpha is 0 in both pictures, so these colours are not seen";
    spend_all(tolerances, kinds, result);
    std::erase_if(kinds, [](const KindReport& kind) { return kind.pixels == 0; });
    result.kinds = std::move(kinds);
    result.equal = result.differing == 0;
    result.accepted = std::ranges::all_of(result.kinds, [](const KindReport& kind) { return kind.beyond == 0; });
    if (!result.equal) result.explanations = explanations(pairing.pairs);
    return result;
}

}  // namespace strata::oracle
