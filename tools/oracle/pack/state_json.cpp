// tools/oracle/pack/state_json.cpp - the fields of a pack's `state`, one list for reading and writing (state_json.h,
// PACK.md). A field of `optional` is null unless it is given, one of `if_any` is left out. An option that is new has no
// field here: "options" has its text, by the table of options, so that packs that were written before can be read. A
// frame of one sample is drawn at one point of every pixel
// (`--sample`); a frame of all samples is resolved.
#include "tools/oracle/pack/state_json.h"

#include <algorithm>
#include <vector>

#include "pipeline/device/sample_points.h"
#include "rasterizer/base/input_error.h"
#include "scenes/packs/json_fields.h"
#include "tools/request/option_fields.h"

namespace strata::oracle {

namespace {

using peeling::RenderOptions;
using pipeline::DeviceProfile;
using pipeline::sample_points;
using scenes::JsonReader;
using scenes::JsonWriter;

constexpr int most_pixels_a_side = 16384, most_passes = 1000000;

// An optional enum, by its names.
template <class Io, class Value>
void optional_choice(Io& io, const std::string& key, Value& value,
                     std::span<const std::string_view> names = enum_names<typename Value::value_type>) {
    io.optional(key, value, [names](auto& inner, const std::string& k, auto& v) { inner.choice(k, v, names); });
}

template <class Io, class O>
void algorithm_fields(Io& io, O& o) {
    constexpr int most_fragments = INT32_MAX;
    io.choice("weight", o.weight);
    io.whole("nodes", o.nodes, 1, peeling::most_nodes);
    optional_choice(io, "tail", o.tail);
    io.whole("pixel_nodes", o.pixel_nodes, 0, most_fragments);
    io.whole("frame_nodes", o.frame_nodes, 0, most_fragments);
    io.choice("overflow", o.overflow);
    io.whole("moments", o.moments, 4, 8);
    io.optional("moment_bias", o.moment_bias, [](auto& inner, const std::string& key, auto& v) { inner.real(key, v); });
    io.real("overestimation", o.overestimation);
    io.whole("stochastic_samples", o.stochastic_samples, 1, peeling::most_stochastic_samples);
    io.whole("stochastic_seed", o.stochastic_seed, std::uint32_t{0}, UINT32_MAX);
}

// Left out where all are their defaults.
template <class Io>
void algorithm(Io& io, std::optional<peeling::AlgorithmOptions>& given) {
    io.if_any("algorithm", given, [](auto& outer, const std::string& key, auto& options) {
        outer.nested(key, options, [](auto& inner, auto& o) { algorithm_fields(inner, o); });
    });
}

// The part of the state that only a frame of all samples has.
struct AllSamples {
    pipeline::Resolve resolve{};
    pipeline::LoadedSample loads{}, composites{};
    friend bool operator==(const AllSamples&, const AllSamples&) = default;
};

// The part of the state that only a frame of one sample has, beside the sample's point, or a frame of all samples.
struct SampledState {
    rasterizer::Interpolation interpolation{};
    std::vector<rasterizer::SamplePoint> points{};  // of all samples; of a frame of one only if it needs them
    std::optional<int> number{};                    // of the frame's own sample
    std::optional<AllSamples> all{};
    rasterizer::SampleCoverage coverage{};
    friend bool operator==(const SampledState&, const SampledState&) = default;
};

constexpr const char* sampling_field = "/state/sampling";

// Empty where all are their defaults.
[[nodiscard]] std::optional<SampledState> sampled_state(const RenderOptions& options, const DeviceProfile& profile) {
    const rasterizer::RasterState& raster = options.raster;
    SampledState sampled{.interpolation = raster.interpolation, .coverage = raster.sample_coverage};
    const peeling::Multisampling& sampling = options.sampling;
    if (sampling.samples > 1) {
        const auto points = sample_points(profile.sample_positions, sampling.samples);
        sampled.points.assign(points.begin(), points.end());
        sampled.all = {sampling.resolve, sampling.loads, sampling.composites};
        return sampled;
    }
    sampled.points.assign(raster.samples.begin(), raster.samples.begin() + raster.sample_count);
    sampled.number = raster.sample_number;
    return sampled == SampledState{.number = 0} ? std::nullopt : std::optional{sampled};
}

template <class Io, class P>
void point_fields(Io& io, P& point) {
    io.whole("x", point.x, 0, 15);
    io.whole("y", point.y, 0, 15);
}

template <class Io>
void sampling(Io& io, std::optional<SampledState>& given) {
    io.if_any("sampling", given, [](auto& outer, const std::string& key, auto& state) {
        outer.nested(key, state, [](auto& inner, auto& s) {
            inner.choice("interpolation", s.interpolation);
            inner.list("samples", s.points, [](auto& each, auto& point) { point_fields(each, point); });
            inner.if_any("number", s.number,
                         [](auto& object, const std::string& k, auto& v) { object.whole(k, v, 0, 7); });
            inner.if_any("all", s.all, [](auto& object, const std::string& k, auto& v) {
                object.nested(k, v, [](auto& fields, auto& all) {
                    fields.choice("resolve", all.resolve);
                    fields.choice("loads", all.loads);
                    fields.choice("composites", all.composites);
                });
            });
            inner.flag("alpha_to_coverage", s.coverage.by_alpha);
            inner.optional("coverage", s.coverage.value,
                           [](auto& one, const std::string& k, auto& v) { one.real(k, v); });
            inner.flag("inverts_coverage", s.coverage.is_inverted);
            inner.whole("mask", s.coverage.mask, std::uint8_t{0}, std::uint8_t{255});
        });
    });
}

// Of a frame of all samples: their points are those of the pack's profile.
void take_all_samples(const SampledState& given, const std::string& file, const DeviceProfile& profile,
                      RenderOptions& options) {
    if (options.raster.sample)
        throw InputError(file, sampling_field, "the field 'number', because the state has the field 'sample'",
                         "the field 'all'");
    const auto points = sample_points(profile.sample_positions, static_cast<int>(given.points.size()));
    if (points.empty() || !std::ranges::equal(points, given.points))
        throw InputError(file, std::string{sampling_field} + "/samples",
                         "the 2, 4 or 8 sample positions of profile " + profile.name,
                         std::to_string(given.points.size()) + " other positions");
    options.sampling = {.samples = static_cast<int>(points.size()),
                        .resolve = given.all->resolve,
                        .loads = given.all->loads,
                        .composites = given.all->composites};
}

// The samples' number is limited by the array; Renderer checks the rest.
void take_sampled_state(const SampledState& given, const std::string& file, const DeviceProfile& profile,
                        RenderOptions& options) {
    rasterizer::RasterState& raster = options.raster;
    if (given.points.size() > raster.samples.size())
        throw InputError(file, std::string{sampling_field} + "/samples", "at most 8 sample positions",
                         std::to_string(given.points.size()));
    if (given.number.has_value() == given.all.has_value())
        throw InputError(file, sampling_field, "either the field 'number' (of one sample) or the field 'all'",
                         given.all ? "both" : "neither");
    raster.interpolation = given.interpolation;
    raster.sample_coverage = given.coverage;
    if (given.all) return take_all_samples(given, file, profile, options);
    if (!raster.sample)
        throw InputError(file, sampling_field, "the field 'sample' in the state, because 'number' names one sample",
                         "no such field");
    raster.sample_count = static_cast<int>(given.points.size());
    std::ranges::copy(given.points, raster.samples.begin());
    raster.sample_number = *given.number;
}

template <class Io, class O>
void fields(Io& io, O& o) {
    io.whole("width", o.width, 1, most_pixels_a_side);
    io.whole("height", o.height, 1, most_pixels_a_side);
    optional_choice(io, "depth", o.depth);
    optional_choice(io, "depth_path", o.depth_path);
    optional_choice(io, "reference_path", o.reference_path);
    io.nested("compare_epsilon", o.compare_epsilon, [](auto& inner, auto& epsilon) {
        inner.real("absolute", epsilon.absolute);
        inner.whole("ulps", epsilon.ulps, 0, 1 << 24);
    });
    io.flag("quantize_reference", o.quantize_reference);
    io.nested("vertex_paths", o.vertex_paths, [](auto& inner, auto& paths) {
        optional_choice(inner, "first", paths.first, pipeline::vertex_path_names);
        optional_choice(inner, "second", paths.second, pipeline::vertex_path_names);
    });
    optional_choice(io, "color_format", o.color_format);
    const auto choice = [](auto& inner, const std::string& key, auto& v) { inner.choice(key, v); };
    io.if_any("result_format", o.result_format, choice);
    io.if_any("back_format", o.back_format, choice);
    io.choice("average_count", o.average_count);
    io.optional("alpha", o.alpha, [](auto& inner, const std::string& key, auto& v) { inner.real(key, v); });
    io.reals("background", components(o.background));
    io.nested("termination", o.termination, [](auto& inner, auto& termination) {
        inner.choice("rule", termination.rule);
        inner.real("ratio", termination.ratio);
        inner.whole("passes", termination.passes, 0, most_passes);
    });
    io.whole("max_passes", o.max_passes, 0, most_passes);
    io.choice("formulation", o.formulation);
    io.nested("sort", o.sort, [](auto& inner, auto& sort) {
        inner.choice("rule", sort.rule);
        inner.whole("buckets", sort.buckets, 1, INT32_MAX);
        inner.real("fraction", sort.fraction);
        inner.text("seed", sort.seed);
    });
    io.texts("sorted", o.sorted);
    auto& raster = o.raster;
    io.choice("depth_order", raster.depth_order);
    io.choice("clip_depth", raster.clip_depth);
    io.nested("depth_range", raster, [](auto& inner, auto& range) {
        inner.real("near", range.depth_near);
        inner.real("far", range.depth_far);
    });
    io.flag("depth_clamp", raster.depth_clamp);
    io.nested("polygon_offset", raster.polygon_offset, [](auto& inner, auto& offset) {
        inner.flag("enabled", offset.enabled);
        inner.real("factor", offset.factor);
        inner.real("units", offset.units);
    });
    io.if_any("scissor", raster.scissor, [](auto& outer, const std::string& key, auto& given) {
        outer.nested(key, given, [](auto& inner, auto& rect) {
            inner.whole("left", rect.x0, 0, most_pixels_a_side);
            inner.whole("top", rect.y0, 0, most_pixels_a_side);
            inner.whole("right", rect.x1, 0, most_pixels_a_side);
            inner.whole("bottom", rect.y1, 0, most_pixels_a_side);
        });
    });
    io.if_any("sample", raster.sample, [](auto& outer, const std::string& key, auto& given) {
        outer.nested(key, given, [](auto& inner, auto& point) { point_fields(inner, point); });
    });
    io.choice("y_direction", raster.y_direction);
    io.choice("cull", raster.cull);
    io.choice("front_face", raster.front_face);
}

void refuse(const char* field) {
    throw InputError("pack", field, "the default value, because a pack does not store this option", "another value");
}

// Options without a field of their own are texts in the object "options", by the names of the table.
constexpr const char* texts = "options";

void set_texts(const nlohmann::json& given, const std::string& file, RenderOptions& options) {
    const std::string place = "/state/options";
    tools::PictureRequest request{.render = options};
    if (!given.is_object()) throw InputError(file, place, "an object", given.dump());
    for (const auto& [name, text] : given.items()) {
        if (!text.is_string()) throw InputError(file, place + "/" + name, "a string", text.dump());
        tools::set_option(request, name, text.get<std::string>(), file + ": " + place, tools::is_of_frame);
    }
    options = request.render;
}

// The options of the frame that `state` does not have in its other fields.
nlohmann::ordered_json texts_of(const RenderOptions& options, const RenderOptions& stated) {
    nlohmann::ordered_json object;
    const tools::PictureRequest all{.render = options}, kept{.render = stated};
    for (const tools::OptionField& field : tools::option_fields())
        if (tools::is_of_frame(field) && field.text(all) != field.text(kept)) object[field.key()] = field.text(all);
    return object;
}

}  // namespace

nlohmann::ordered_json state_json(const RenderOptions& options, const DeviceProfile& profile) {
    if (options.second_list != nullptr) refuse("second_list");
    if (options.second_depth_clamp) refuse("second_depth_clamp");
    if (options.window_origin != std::array<int, 2>{}) refuse("window_origin");
    if (options.raster.clip_plane_count != 0) refuse("raster.clip_planes");
    if (options.raster.window_positions) refuse("raster.window_positions");
    JsonWriter io;
    fields(io, options);
    std::optional<peeling::AlgorithmOptions> given;
    if (options.algorithm != peeling::AlgorithmOptions{}) given = options.algorithm;
    algorithm(io, given);
    std::optional<SampledState> sampled = sampled_state(options, profile);
    sampling(io, sampled);
    const RenderOptions stated = read_state({{"state", io.object}}, "state", profile);
    if (auto others = texts_of(options, stated); !others.empty()) io.object[texts] = std::move(others);
    return std::move(io.object);
}

RenderOptions read_state(const nlohmann::json& manifest, const std::string& file, const DeviceProfile& profile) {
    RenderOptions options;
    JsonReader top{manifest, file, ""};
    JsonReader io{top.at("state"), file, "/state"};
    fields(io, options);
    std::optional<peeling::AlgorithmOptions> given;
    algorithm(io, given);
    options.algorithm = given.value_or(peeling::AlgorithmOptions{});
    std::optional<SampledState> sampled;
    sampling(io, sampled);
    if (sampled) take_sampled_state(*sampled, file, profile, options);
    if (manifest["state"].contains(texts)) set_texts(io.at(texts), file, options);
    io.end();
    return options;
}

}  // namespace strata::oracle
