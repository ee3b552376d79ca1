// tools/strata/options/algorithm_options.cpp - options of single algorithms, and their spelling in a canonical command.
#include "tools/strata/options/algorithm_options.h"

#include <fmt/format.h>

#include "tools/strata/options/option.h"
#include "tools/strata/options/parse.h"
#include "tools/strata/options/values.h"

namespace strata::tools {

namespace {

using peeling::AlgorithmOptions;

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
const std::vector<Choice<int>> moment_counts{{"4", 4}, {"6", 6}, {"8", 8}};

auto from_one_to(int most) {
    return [most](std::string_view text) {
        const auto value = to_positive(text);
        return value && *value <= most ? value : std::nullopt;
    };
}

}  // namespace

void add_algorithm_options(CLI::App& app, AlgorithmOptions& options) {
    add_choice(
        app, options.weight, "--weight", weights,
        "weight of a fragment in weighted_blended and in tails, by McGuire and Bavoil's equation (default eq10)");
    add_option(
        app, options.nodes,
        {"--nodes", "K", "entries a pixel of multi_layer, adaptive, atomic_loop, hybrid_transparency (default 4)",
         "a whole number from 1 to 8"},
        from_one_to(peeling::most_nodes));
    add_choice(app, options.tail, "--tail", tails,
               "fragments beyond those in order, of atomic_loop (default blend), hybrid_transparency (default "
               "average), and of "
               "front_to_back and dual that end early (default none)");
    add_option(
        app, options.pixel_nodes,
        {"--pixel-nodes", "N", "fragments that linked_list keeps a pixel (default 0: all)", "a whole number from 0"},
        to_count);
    add_option(
        app, options.frame_nodes,
        {"--frame-nodes", "N", "fragments that linked_list keeps a frame (default 0: all)", "a whole number from 0"},
        to_count);
    add_choice(app, options.overflow, "--overflow", overflows,
               "what linked_list does with fragments that find no node (default drop-new)");
    add_choice(app, options.moments, "--moments", moment_counts,
               "power moments of moments and moments_quantized (default 4)");
    add_option(app, options.moment_bias,
               {"--moment-bias", "SHARE",
                "share of fixed moments in moments (default 5e-7, 5e-6 or 5e-5 by their number; of moments_quantized "
                "6e-5, 6e-4 or 2.5e-3)",
                "a number from 0 to 1"},
               to_share);
    add_option(
        app, options.overestimation,
        {"--overestimation", "SHARE",
         "share of its own absorbance through which moments shows a fragment (default 0.25)", "a number from 0 to 1"},
        to_share);
    add_option(
        app, options.stochastic_samples,
        {"--stochastic-samples", "N", "samples per pixel of stochastic (default 4)", "a whole number from 1 to 8"},
        from_one_to(peeling::most_stochastic_samples));
    add_option(app, options.stochastic_seed,
               {"--stochastic-seed", "SEED", "seed of the masks of stochastic (default 0)",
                "a whole number from 0 to 4294967295"},
               to_int<std::uint32_t>);
}

std::vector<std::string> words_of(const AlgorithmOptions& o) {
    const AlgorithmOptions plain;
    std::vector<std::string> words;
    const auto add = [&](bool differs, const char* option, const std::string& value) {
        if (differs) words.insert(words.end(), {option, value});
    };
    add(o.weight != plain.weight, "--weight", name_of(weights, o.weight));
    add(o.nodes != plain.nodes, "--nodes", fmt::format("{}", o.nodes));
    if (o.tail) add(true, "--tail", name_of(tails, *o.tail));
    add(o.pixel_nodes != plain.pixel_nodes, "--pixel-nodes", fmt::format("{}", o.pixel_nodes));
    add(o.frame_nodes != plain.frame_nodes, "--frame-nodes", fmt::format("{}", o.frame_nodes));
    add(o.overflow != plain.overflow, "--overflow", name_of(overflows, o.overflow));
    add(o.moments != plain.moments, "--moments", fmt::format("{}", o.moments));
    if (o.moment_bias) add(true, "--moment-bias", fmt::format("{}", *o.moment_bias));
    add(o.overestimation != plain.overestimation, "--overestimation", fmt::format("{}", o.overestimation));
    add(o.stochastic_samples != plain.stochastic_samples, "--stochastic-samples",
        fmt::format("{}", o.stochastic_samples));
    add(o.stochastic_seed != plain.stochastic_seed, "--stochastic-seed", fmt::format("{}", o.stochastic_seed));
    return words;
}

}  // namespace strata::tools
