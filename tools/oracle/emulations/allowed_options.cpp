// tools/oracle/emulations/allowed_options.cpp - the options that are tried before mistakes: blend roundings, formats,
// sample positions, profiles, limits of passes, epsilons, two depths of one fragment (allowed_options.h).
#include "tools/oracle/emulations/allowed_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "pipeline/device/sample_points.h"
#include "rasterizer/base/enum_values.h"

namespace strata::oracle {

namespace {

using pipeline::BlendRounding;
using pipeline::DeviceProfile;
using pipeline::Format;

constexpr int most_limits = 16;  // limit on pass counts that are tried

Format accumulators(const AlteredRun& e) {
    const bool is_exact = e.profile.raster.depth_path == rasterizer::DepthPath::exact;
    return e.options.color_format.value_or(is_exact ? Format::rgba32f : Format::rgba8);
}

Mistake allowed(std::string name, std::string description, std::function<bool(AlteredRun&)> make) {
    return {std::move(name), std::move(description), ChangedPart::device, std::move(make), true};
}

std::string_view words_for(BlendRounding rule) {
    switch (rule) {
        case BlendRounding::nearest: return "8-bit blends whose sum is rounded once, to the nearest code";
        case BlendRounding::truncate: return "8-bit blends whose sum is cut to its code";
        case BlendRounding::each_product: return "8-bit blends that round each product by itself";
        case BlendRounding::unrounded_source: break;
    }
    return "8-bit blends of a source that is not rounded before";
}

void add_blends(std::vector<Mistake>& all) {
    for (const BlendRounding rule : {BlendRounding::nearest, BlendRounding::truncate, BlendRounding::each_product,
                                     BlendRounding::unrounded_source}) {
        const auto word = enum_name(rule);
        all.push_back(allowed(fmt::format("blend_{}", word), std::string{words_for(rule)}, [rule](AlteredRun& e) {
            if (e.profile.blend_rounding == rule || accumulators(e) != Format::rgba8) return false;
            e.profile.blend_rounding = rule;
            if (rule == BlendRounding::unrounded_source) e.profile.has_signed_blend = false;  // equations of codes
            return true;
        }));
    }
    // If all corners have one colour, every fragment has that colour, like a uniform; so this option precedes those for
    // triangles with slopes.
    using rasterizer::EqualColors;
    for (const EqualColors rule : enum_values<EqualColors>) {
        const auto word = enum_name(rule);
        all.push_back(allowed(fmt::format("equal_colors_{}", word),
                              fmt::format("triangles of one colour: raster.equal_colors {}", word),
                              [rule](AlteredRun& e) {
                                  if (e.profile.raster.equal_colors == rule) return false;
                                  e.profile.raster.equal_colors = rule;
                                  return true;
                              }));
    }
}

// Adds formats for the accumulators under the same image format, for both, and for dual's back.
void add_formats(std::vector<Mistake>& all) {
    for (const Format format : {Format::rgba8, Format::rgba16f, Format::rgba32f}) {
        const auto word = info(format).name;
        all.push_back(allowed(fmt::format("accumulators_{}", word), fmt::format("accumulators of {}", word),
                              [format](AlteredRun& e) {
                                  const Format now = accumulators(e);
                                  if (now == format) return false;
                                  if (!e.options.result_format) e.options.result_format = now;
                                  e.options.color_format = format;
                                  e.profile.has_float_targets = true;
                                  return true;
                              }));
        all.push_back(allowed(fmt::format("format_{}", word), fmt::format("accumulators and picture of {}", word),
                              [format](AlteredRun& e) {
                                  if (accumulators(e) == format && !e.options.result_format) return false;
                                  e.options.result_format.reset();
                                  e.options.color_format = format;
                                  e.profile.has_float_targets = true;
                                  return true;
                              }));
        all.push_back(allowed(fmt::format("back_{}", word), fmt::format("a back of {}", word), [format](AlteredRun& e) {
            if (!e.algorithm->takes_both_ends || e.options.back_format.value_or(accumulators(e)) == format)
                return false;
            e.options.back_format = format;
            e.profile.has_float_targets = true;
            return true;
        }));
    }
}

void add_positions(std::vector<Mistake>& all) {
    using pipeline::SamplePositions;
    for (const SamplePositions positions : enum_values<SamplePositions>) {
        const auto word = enum_name(positions);
        all.push_back(allowed(fmt::format("sample_positions_{}", word), fmt::format("sample_positions {}", word),
                              [positions](AlteredRun& e) {
                                  const int samples = e.options.sampling.samples;
                                  if (samples == 1 || e.profile.sample_positions == positions ||
                                      pipeline::sample_points(positions, samples).empty())
                                      return false;
                                  e.profile.sample_positions = positions;
                                  return true;
                              }));
    }
}

void add_profile(std::vector<Mistake>& all, const DeviceProfile& profile) {
    all.push_back(allowed("profile_" + profile.name, fmt::format("profile {}", profile.name), [profile](AlteredRun& e) {
        if (e.profile == profile) return false;
        e.options.color_format = accumulators(e);  // the image keeps its format
        e.profile = with_origin(profile, e.profile.origin);
        return true;
    }));
}

// True if every further pass adds one layer, from the nearest on.
bool peels_by_one(const peeling::Algorithm& algorithm) {
    const auto passes = algorithm.geometry_passes;
    return passes != nullptr && !algorithm.takes_both_ends && passes(1) == 2 && passes(2) == 3 && passes(9) == 10;
}

// " 3 layers", or " layer" for one.
std::string counted(int count, std::string_view one) {
    if (count == 1) return fmt::format(" {}", one);
    return fmt::format(" {} {}{}", count, one, one.ends_with('s') ? "es" : "s");
}

void add_limits(std::vector<Mistake>& all, const peeling::Algorithm& algorithm, const RightRun& right) {
    const bool by_one = peels_by_one(algorithm);
    for (int passes = 1; passes < std::min(right.enough_passes, most_limits + 1); ++passes)
        all.push_back({fmt::format("passes_{}", passes),
                       fmt::format("only the {}{} of {} (--max-passes {})", by_one ? "nearest" : "first",
                                   counted(passes, by_one ? "layer" : "pass"), right.enough_passes, passes),
                       ChangedPart::device, [passes](AlteredRun& e) {
                           if (e.options.max_passes > 0 && e.options.max_passes <= passes) return false;
                           e.options.max_passes = passes;
                           return true;
                       }});
}

// A peel that compares its own codes does not support an epsilon.
bool takes_epsilon(const AlteredRun& e) { return !e.algorithm->compares_own_codes && e.right.passes > 1; }

void add_epsilons(std::vector<Mistake>& all) {
    for (const int ulps : {1, 2, 4, 16, 64})
        all.push_back({fmt::format("epsilon_{}_codes", ulps),
                       fmt::format("an epsilon of {} codes of depth added before peeled depths are compared", ulps),
                       ChangedPart::device, [ulps](AlteredRun& e) {
                           if (!takes_epsilon(e)) return false;
                           e.options.compare_epsilon.ulps += ulps;
                           return true;
                       }});
    for (const int bits : {24, 20, 14, 10})
        all.push_back({fmt::format("epsilon_2_{}", bits),
                       fmt::format("an epsilon of 2^-{} added before peeled depths are compared", bits),
                       ChangedPart::device, [bits](AlteredRun& e) {
                           if (!takes_epsilon(e)) return false;
                           e.options.compare_epsilon.absolute += 1.0 / (1 << bits);
                           return true;
                       }});
}

// Passes that compute a fragment's depth in two ways: by two vertex programs, or by another path of depths.
void add_paths(std::vector<Mistake>& all) {
    using pipeline::VertexPath;
    constexpr std::array tried{VertexPath::separate, VertexPath::fused, VertexPath::reassociated,
                               VertexPath::double_precision};
    const auto word_of = [](VertexPath path) { return pipeline::vertex_path_names[static_cast<std::size_t>(path)]; };
    for (const VertexPath first : tried)
        for (const VertexPath second : tried) {
            if (first == second) continue;
            all.push_back({fmt::format("vertex_paths_{}_{}", word_of(first), word_of(second)),
                           fmt::format("passes after the first compute other depths: --vertex-path {},{}",
                                       word_of(first), word_of(second)),
                           ChangedPart::device, [first, second](AlteredRun& e) {
                               const peeling::VertexPaths paths{first, second};
                               if (e.right.passes < 2 || e.options.vertex_paths == paths) return false;
                               e.options.vertex_paths = paths;
                               return true;
                           }});
        }
    using rasterizer::DepthPath;
    for (const DepthPath path : enum_values<DepthPath>) {
        const auto word = enum_name(path);
        all.push_back({fmt::format("reference_path_{}", word),
                       fmt::format("passes after the first compare another depth: --reference-path {}", word),
                       ChangedPart::device, [path](AlteredRun& e) {
                           const DepthPath own = e.options.depth_path.value_or(e.profile.raster.depth_path);
                           if (e.right.passes < 2 || own == path || e.options.reference_path == path) return false;
                           e.options.reference_path = path;
                           return true;
                       }});
    }
}

void add_background(std::vector<Mistake>& all) {
    all.push_back(
        {"background_none", "a transparent background (--background none)", ChangedPart::device, [](AlteredRun& e) {
             e.options.background = {0, 0, 0, 0};
             return true;
         }});
    all.push_back(
        {"background_alpha_0", "the background's colour with alpha 0", ChangedPart::device, [](AlteredRun& e) {
             auto& background = e.options.background;
             background[3] = 0;
             return background != pipeline::Rgba{0, 0, 0, 0};
         }});
}

}  // namespace

std::vector<Mistake> allowed_options(const peeling::Algorithm& algorithm, const RightRun& right,
                                     std::span<const DeviceProfile> more) {
    std::vector<Mistake> all;
    add_blends(all);
    add_formats(all);
    add_positions(all);
    for (const DeviceProfile& profile : more) add_profile(all, profile);
    for (const DeviceProfile& profile : pipeline::builtin_profiles()) add_profile(all, profile);
    add_limits(all, algorithm, right);
    add_epsilons(all);
    add_paths(all);
    add_background(all);
    return all;
}

}  // namespace strata::oracle
