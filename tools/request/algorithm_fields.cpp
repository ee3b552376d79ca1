// tools/request/algorithm_fields.cpp - the options of single algorithms.
#include "tools/request/groups.h"
#include "tools/request/make_field.h"
#include "tools/request/weight_words.h"

namespace strata::tools {

namespace {

using peeling::AlgorithmOptions;
using peeling::RenderOptions;

const std::vector<Choice<peeling::Weight>> weights{{"eq7", peeling::Weight::eq7},
                                                   {"eq8", peeling::Weight::eq8},
                                                   {"eq9", peeling::Weight::eq9},
                                                   {"eq10", peeling::Weight::eq10},
                                                   {"constant", peeling::Weight::constant}};
const std::vector<Choice<peeling::Tail>> tails{{"none", peeling::Tail::none},
                                               {"blend", peeling::Tail::blend},
                                               {"average", peeling::Tail::average},
                                               {"weighted", peeling::Tail::weighted}};
const std::vector<Choice<peeling::Overflow>> overflows{{"drop-new", peeling::Overflow::drop_new},
                                                       {"drop-far", peeling::Overflow::drop_far},
                                                       {"blend", peeling::Overflow::blend}};
const std::vector<Choice<peeling::ListGranularity>> granularities{{"sample", peeling::ListGranularity::sample},
                                                                  {"pixel", peeling::ListGranularity::pixel}};
const std::vector<Choice<int>> moment_counts{{"4", 4}, {"6", 6}, {"8", 8}};

auto from_one_to(int most) {
    return [most](std::string_view text) {
        const auto value = to_positive(text);
        return value && *value <= most ? value : std::nullopt;
    };
}

template <auto member>
OptionField count(const FieldText& text, auto read) {
    return number<&PictureRequest::render, &RenderOptions::algorithm, member>(OptionGroup::algorithm, text, read);
}

template <auto member, class T>
OptionField word(const std::string& name, const std::vector<Choice<T>>& choices, const std::string& help) {
    return choice<&PictureRequest::render, &RenderOptions::algorithm, member>(OptionGroup::algorithm, name, choices,
                                                                              help);
}

// An equation's name, or a formula.
OptionField weight_field() {
    const auto set = [](PictureRequest& request, std::string_view text) {
        AlgorithmOptions& options = request.render.algorithm;
        const auto named = to_choice(weights, text);
        auto formula = named ? std::nullopt : to_weight_formula(text);
        if (!named && !formula) return false;
        options.weight = named.value_or(AlgorithmOptions{}.weight);
        options.weight_formula = std::move(formula);
        return true;
    };
    const auto write = [](const PictureRequest& request) {
        const AlgorithmOptions& options = request.render.algorithm;
        return options.weight_formula ? options.weight_formula->text : name_of(weights, options.weight);
    };
    const auto copy = [](PictureRequest& to, const PictureRequest& from) {
        to.render.algorithm.weight = from.render.algorithm.weight;
        to.render.algorithm.weight_formula = from.render.algorithm.weight_formula;
    };
    return joint(OptionGroup::algorithm,
                 {"weight", "eq7|eq8|eq9|eq10|constant|FORMULA",
                  "weight of a fragment in weighted_blended and in tails, by McGuire and Bavoil's equation (default "
                  "eq10), or by a formula of z, distance and alpha such as 'alpha*exp(-10*z)'",
                  one_of(names_of(weights)) +
                      ", or a formula of z, distance, alpha, numbers, + - * / ( ), exp, min, max, pow and clamp"},
                 set, write, copy);
}

}  // namespace

std::vector<OptionField> algorithm_fields() {
    using O = AlgorithmOptions;
    return {
        read_by({"weighted_blended", "weighted_blended_shared"}, weight_field()),
        read_by(
            {"multi_layer", "adaptive", "atomic_loop", "hybrid_transparency"},
            count<&O::nodes>(
                {"nodes", "K", "entries a pixel of multi_layer, adaptive, atomic_loop, hybrid_transparency (default 4)",
                 "a whole number from 1 to 8"},
                from_one_to(peeling::most_nodes))),
        read_by({"front_to_back", "dual", "atomic_loop", "hybrid_transparency"},
                word<&O::tail>(
                    "tail", tails,
                    "fragments beyond those in order, of atomic_loop (default blend), hybrid_transparency (default "
                    "average), and of front_to_back and dual that end early (default none)")),
        read_by({"linked_list"},
                count<&O::pixel_nodes>({"pixel-nodes", "N", "fragments that linked_list keeps a pixel (default 0: all)",
                                        "a whole number from 0"},
                                       to_count)),
        read_by({"linked_list"},
                count<&O::frame_nodes>({"frame-nodes", "N", "fragments that linked_list keeps a frame (default 0: all)",
                                        "a whole number from 0"},
                                       to_count)),
        read_by({"linked_list"},
                word<&O::overflow>("overflow", overflows,
                                   "what linked_list does with fragments that find no node (default drop-new)")),
        read_if([](const peeling::Algorithm& algorithm) { return algorithm.has_lists; },
                word<&O::list_granularity>("list-granularity", granularities,
                                           "what has a list of fragments: a sample, or a pixel, whose nodes have "
                                           "coverage masks; with --shading pixel (default sample)")),
        read_by(
            {"moments", "moments_quantized"},
            word<&O::moments>("moments", moment_counts, "power moments of moments and moments_quantized (default 4)")),
        read_by(
            {"moments", "moments_quantized"},
            count<&O::moment_bias>({"moment-bias", "SHARE",
                                    "share of fixed moments in moments (default 5e-7, 5e-6 or 5e-5 by their number; of "
                                    "moments_quantized 6e-5, 6e-4 or 2.5e-3)",
                                    "a number from 0 to 1"},
                                   to_share)),
        read_by({"moments", "moments_quantized"},
                count<&O::overestimation>(
                    {"overestimation", "SHARE",
                     "share of its own absorbance through which moments shows a fragment (default 0.25)",
                     "a number from 0 to 1"},
                    to_share)),
        read_by({"stochastic"},
                count<&O::stochastic_samples>({"stochastic-samples", "N", "samples per pixel of stochastic (default 4)",
                                               "a whole number from 1 to 8"},
                                              from_one_to(peeling::most_stochastic_samples))),
        read_by({"stochastic"},
                count<&O::stochastic_seed>({"stochastic-seed", "SEED", "seed of the masks of stochastic (default 0)",
                                            "a whole number from 0 to 4294967295"},
                                           to_int<std::uint32_t>)),
    };
}

}  // namespace strata::tools
