#include "tests/fuzz/frame_case.h"

#include <algorithm>

#include "peeling/registry.h"
#include "pipeline/device/profile_fields.h"
#include "pipeline/device/sample_points.h"
#include "tests/fuzz/scene_of_bytes.h"

namespace strata::fuzz {

using namespace pipeline;
using rasterizer::DepthPath;

namespace {

constexpr std::uint64_t usual_memory = std::uint64_t{256} << 20;

struct Running {
    Execution execution;
    std::uint64_t fragment_memory;  // default
};
constexpr Running rasterizing{Execution::replay, 0}, replaying{Execution::replay, usual_memory},
    literal{Execution::literal, usual_memory};
constexpr std::array runnings{replaying, rasterizing, literal};

// A profile that can run the algorithm; sometimes any profile.
DeviceProfile profile_for(ByteSource& bytes, const peeling::Algorithm* algorithm) {
    std::vector<DeviceProfile> profiles;
    const bool any = bytes.one_in(16);
    for (const DeviceProfile& p : builtin_profiles())
        if (any || algorithm == nullptr || !refusal(*algorithm, p)) profiles.push_back(p);
    return profiles[static_cast<std::size_t>(bytes.below(static_cast<int>(profiles.size())))];
}

// Changes up to four rules, one after the other, unless another rule excludes the value.
void vary_rules(ByteSource& bytes, DeviceProfile& profile) {
    std::vector<const ProfileField*> rules;
    for (const ProfileField& field : profile_fields())
        if (field.kind == FieldKind::choice && field.key != "raster.depth_path") rules.push_back(&field);
    for (int left = bytes.one_in(2) ? bytes.below(5) : 0; left > 0; --left) {
        const ProfileField& rule = *rules[static_cast<std::size_t>(bytes.below(static_cast<int>(rules.size())))];
        DeviceProfile other = profile;
        rule.set(other, bytes.below(rule.highest + 1));
        if (!conflict_of(other)) profile = other;
    }
}

void choose_formats(ByteSource& bytes, const DeviceProfile& profile, peeling::RenderOptions& o) {
    const bool any = bytes.one_in(32);
    if (bytes.one_in(2)) {
        const DepthFormat format = bytes.pick(std::array{DepthFormat::d24, DepthFormat::d32f, DepthFormat::d16});
        if (any || profile.has_depth(format)) o.depth = format;
    }
    if (bytes.one_in(4)) o.depth_path = bytes.pick(std::array{DepthPath::float32, DepthPath::exact});
    if (any) o.depth_path = bytes.pick(std::array{DepthPath::window_z, DepthPath::perspective_rq});
    if (profile.has_float_targets || any) {
        if (bytes.one_in(2)) o.color_format = bytes.pick(std::array{Format::rgba16f, Format::rgba32f, Format::rgba8});
        if (bytes.one_in(3)) o.average_count = Format::r32f;
    }
}

// Chooses a compared depth other than the stored one, or another vertex path for it.
void choose_comparison(ByteSource& bytes, const DeviceProfile& profile, peeling::RenderOptions& o) {
    constexpr std::array stored{DepthPath::float32_plane, DepthPath::exact, DepthPath::perspective_rq,
                                DepthPath::depth_replace};
    constexpr std::array compared{DepthPath::perspective_rq, DepthPath::float32, DepthPath::float32_plane,
                                  DepthPath::exact};
    if (bytes.one_in(8)) {
        const DepthPath path = bytes.pick(stored);
        if (!check(profile, path)) o.depth_path = path;
    }
    if (bytes.one_in(6)) o.reference_path = bytes.pick(compared);
    if (bytes.one_in(10)) o.compare_epsilon = {bytes.one_in(2) ? 0.01 * double{bytes.fraction()} : 0.0, bytes.below(5)};
    if (bytes.one_in(20)) o.quantize_reference = false;
    if (bytes.one_in(8)) o.vertex_paths.first = static_cast<VertexPath>(bytes.below(6));
    if (bytes.one_in(10)) o.vertex_paths.second = static_cast<VertexPath>(bytes.below(6));
}

Termination termination(ByteSource& bytes) {
    switch (bytes.below(8)) {
        case 4: return {.rule = TerminationRule::paper};
        case 5: return {.rule = TerminationRule::any};
        case 6:
            return {.rule = TerminationRule::ratio,
                    .ratio = bytes.pick(std::array{0.0, 0.015625, 0.125, 0.5, 1.0, 40.0})};
        case 7: return {.rule = TerminationRule::fixed, .passes = 1 + bytes.below(10)};
        default: return {};
    }
}

rasterizer::Rect rect(ByteSource& bytes, int width, int height) {
    const int x = bytes.below(width / 2 + 4) - 2, y = bytes.below(height / 2 + 4) - 2;
    return {x, y, x + bytes.below(width + 2), y + bytes.below(height + 2)};
}

rasterizer::RasterState raster_state(ByteSource& bytes, const DeviceProfile& profile, int width, int height) {
    using namespace rasterizer;
    RasterState state;
    if (bytes.one_in(6)) state.scissor = rect(bytes, width, height);
    if (bytes.one_in(4))
        state.polygon_offset = {true, 4 * bytes.fraction() - 2, static_cast<float>(bytes.below(9) - 4)};
    if (bytes.one_in(6))
        state.cull = bytes.pick(std::array{CullFace::none, CullFace::front, CullFace::none, CullFace::front_and_back});
    if (bytes.one_in(4)) state.front_face = FrontFace::clockwise;
    if (bytes.one_in(4)) state.y_direction = YDirection::down;
    if (bytes.one_in(4)) state.clip_depth = ClipDepth::zero_to_one;
    if (profile.has_depth_clamp && bytes.one_in(4)) state.depth_clamp = true;
    if (bytes.one_in(6)) state.depth_near = 0.5f * bytes.fraction();
    if (bytes.one_in(6)) state.depth_far = 0.5f + 0.5f * bytes.fraction();
    if (bytes.one_in(12)) {
        state.clip_plane_count = 1 + bytes.below(bytes.one_in(4) ? 6 : 2);
        for (ClipPlane& p : state.clip_planes)
            p = {2 * bytes.fraction() - 1, 2 * bytes.fraction() - 1, 2 * bytes.fraction() - 1, 2 * bytes.fraction()};
    }
    return state;
}

void choose_order(ByteSource& bytes, peeling::RenderOptions& o) {
    using peeling::SortRule;
    if (bytes.one_in(3)) o.formulation = Formulation::published;
    if (!bytes.one_in(3)) return;
    o.sort.rule = bytes.pick(std::array{SortRule::exact, SortRule::bucket, SortRule::reverse, SortRule::shuffle});
    o.sort.buckets = 1 + bytes.below(8);
    o.sort.fraction = bytes.fraction();
    o.sort.seed = static_cast<std::uint64_t>(bytes.below(16));
}

peeling::RenderOptions options(ByteSource& bytes, const DeviceProfile& profile, const peeling::Algorithm* algorithm) {
    peeling::RenderOptions o;
    const int largest = bytes.one_in(10) ? 48 : 20;
    o.width = 1 + bytes.below(largest);
    o.height = 1 + bytes.below(largest);
    o.threads = 1;
    choose_formats(bytes, profile, o);
    choose_comparison(bytes, profile, o);
    if (bytes.one_in(6)) o.alpha = bytes.fraction();
    if (bytes.one_in(2))
        for (float& channel : components(o.background)) channel = bytes.fraction();
    if (o.background[3] < 0.5f) o.background[3] = 1;  // dual's resolve requires an opaque background
    o.termination = termination(bytes);
    if (bytes.one_in(6)) o.max_passes = 1 + bytes.below(8);
    o.keep_layers = algorithm != nullptr && algorithm->makes_layers && bytes.one_in(4);
    o.audit = !bytes.one_in(3);
    o.nearest_depth = !bytes.one_in(4);
    o.raster = raster_state(bytes, profile, o.width, o.height);
    choose_order(bytes, o);
    return o;
}

ExecutionWay way(ByteSource& bytes, const Running& running, Simd simd) {
    constexpr std::array<std::uint64_t, 6> memories{usual_memory, 300 << 10, 40 << 10, 4 << 10, 600, 0};
    ExecutionWay w{.execution = running.execution, .simd = simd, .fragment_memory = running.fragment_memory};
    w.tile_size = bytes.pick(std::array{8, 16, 32, 64, 128});
    if (bytes.one_in(4)) w.effects = Effects::all;
    if (bytes.one_in(4)) w.trust_idle = false;
    const bool has_memory_of_its_own = bytes.one_in(2);
    const std::uint64_t memory = has_memory_of_its_own ? bytes.pick(memories) : w.fragment_memory;
    if (running.fragment_memory > 0) w.fragment_memory = memory;
    w.check_selections = running.execution == Execution::replay && bytes.one_in(3);
    return w;
}

// Chooses another format for the picture or the back than for the colours.
void choose_other_formats(ByteSource& bytes, const DeviceProfile& profile, const peeling::Algorithm* algorithm,
                          peeling::RenderOptions& o) {
    constexpr std::array formats{Format::rgba8, Format::rgba16f, Format::rgba32f};
    if (!profile.has_float_targets) return;
    if (bytes.one_in(6)) o.result_format = bytes.pick(formats);
    if (algorithm != nullptr && algorithm->takes_both_ends && bytes.one_in(4)) o.back_format = bytes.pick(formats);
}

// alpha exp(-c distance).
peeling::WeightFormula falling_weight(float c) {
    using enum peeling::WeightTerm;
    return {.text = "alpha*exp(-distance*" + std::to_string(c) + ")",
            .steps = {{alpha}, {distance}, {negated}, {number, c}, {product}, {exponential}, {product}}};
}

// What single algorithms let choose; most read none of it.
void choose_of_algorithms(ByteSource& bytes, peeling::AlgorithmOptions& o) {
    if (!bytes.one_in(2)) return;
    o.weight = static_cast<peeling::Weight>(bytes.below(5));
    if (o.weight == peeling::Weight::constant && bytes.one_in(2)) o.weight_formula = falling_weight(bytes.fraction());
    o.nodes = 1 + bytes.below(peeling::most_nodes);
    if (bytes.one_in(2)) o.tail = static_cast<peeling::Tail>(bytes.below(4));
    if (bytes.one_in(2)) o.pixel_nodes = bytes.below(4);
    if (bytes.one_in(3)) o.frame_nodes = bytes.below(100);
    o.overflow = static_cast<peeling::Overflow>(bytes.below(3));
    o.moments = bytes.pick(std::array{4, 6, 8});
    o.overestimation = bytes.fraction();
    o.stochastic_samples = 1 + bytes.below(peeling::most_stochastic_samples);
    if (bytes.one_in(2)) o.list_granularity = peeling::ListGranularity::pixel;
}

// The frame of one of several samples, with values at the pixel and samples left out. Without bytes, none of it.
void choose_sample(ByteSource& bytes, const DeviceProfile& profile, rasterizer::RasterState& state) {
    using rasterizer::Interpolation;
    const std::size_t least = profile.sample_positions == SamplePositions::standard ? 3 : 2;
    const int samples = std::array{2, 4, 8}[static_cast<std::size_t>(bytes.below(static_cast<int>(least)))];
    state.interpolation = std::array{Interpolation::sample, Interpolation::centre,
                                     Interpolation::centroid}[static_cast<std::size_t>(bytes.below(3))];
    if (bytes.below(4) == 3) {
        rasterizer::SampleCoverage& coverage = state.sample_coverage;
        coverage.by_alpha = bytes.below(2) == 1;
        if (bytes.below(2) == 1) coverage.value = bytes.fraction();
        coverage.is_inverted = coverage.value && bytes.below(2) == 1;
        if (bytes.below(2) == 1) coverage.mask = static_cast<std::uint8_t>(bytes.below(256));
    }
    if (state.interpolation == Interpolation::sample && state.sample_coverage == rasterizer::SampleCoverage{}) return;
    set_sample(state, profile.sample_positions, samples, static_cast<std::size_t>(bytes.below(samples)));
}

// Frames of several samples, of which programs load any. Without bytes, of one.
void choose_sampling(ByteSource& bytes, const DeviceProfile& profile, peeling::RenderOptions& options) {
    using pipeline::LoadedSample;
    constexpr std::array loads{LoadedSample::own, LoadedSample::own, LoadedSample::zero, LoadedSample::resolved};
    const int samples = std::array{1, 1, 2, 4, 8}[static_cast<std::size_t>(bytes.below(5))];
    if (samples == 1 || pipeline::sample_points(profile.sample_positions, samples).empty()) return;
    options.sampling.samples = samples;
    options.keep_samples = true;
    options.sampling.loads = bytes.pick(loads);
    options.sampling.composites = bytes.pick(loads);
    options.raster.sample.reset();
}

// Up to three lights of any kind, and what all surfaces share. Without bytes, none.
void choose_lights(ByteSource& bytes, peeling::RenderOptions& o) {
    const auto vector = [&] {
        return Vec3{bytes.fraction() - 0.5f, bytes.fraction() - 0.5f, bytes.fraction() + 0.125f};
    };
    const auto color = [&] { return Vec3{bytes.fraction(), bytes.fraction(), bytes.fraction()}; };
    const int count = bytes.below(4);
    if (count == 0) return;
    for (o.lights.emplace(); static_cast<int>(o.lights->size()) < count;) {
        pipeline::Light light{.type = static_cast<pipeline::LightType>(bytes.below(3)), .position = vector()};
        light.ambient = light.specular = color();
        light.direction = vector();
        light.attenuation = {0.5f, bytes.fraction(), bytes.fraction()};
        if (bytes.one_in(4)) light.range = 4 * bytes.fraction() + 0.125f;
        light.cutoff = 10 + 80 * bytes.fraction();
        light.exponent = static_cast<float>(bytes.below(9));
        o.lights->push_back(light);
    }
    pipeline::LightModel& model = o.light_model;
    model.has_local_viewer = bytes.one_in(2);
    model.is_two_sided = bytes.one_in(2);
    model.separates_specular = !bytes.one_in(3);
    model.specular = color();
    model.shininess = static_cast<float>(bytes.below(33));
}

std::vector<ExecutionWay> ways(ByteSource& bytes) {
    std::vector<ExecutionWay> all{way(bytes, literal, Simd::best), way(bytes, rasterizing, Simd::best),
                                  way(bytes, replaying, Simd::best)};
    all.push_back(way(bytes, bytes.pick(runnings), Simd::scalar));
    if (bytes.one_in(6))
        all.push_back(way(bytes, bytes.pick(runnings), bytes.pick(std::array{Simd::avx2, Simd::scalar})));
    return all;
}

}  // namespace

FrameCase make_case(std::span<const std::uint8_t> data) {
    ByteSource bytes{data};
    const auto& algorithms = peeling::algorithms();
    const auto number = static_cast<std::size_t>(bytes.below(static_cast<int>(algorithms.size()) + 1));
    const peeling::Algorithm* const algorithm = number < algorithms.size() ? &algorithms[number] : nullptr;
    FrameCase frame;
    frame.algorithm = algorithm != nullptr ? algorithm->name : "depth_pass";
    frame.profile = profile_for(bytes, algorithm);
    frame.options = options(bytes, frame.profile, algorithm);
    frame.ways = ways(bytes);
    frame.view = view_of(bytes);
    vary_rules(bytes, frame.profile);
    frame.list = list_of(bytes, frame.view, frame.options.width, frame.options.height);
    choose_other_formats(bytes, frame.profile, algorithm,
                         frame.options);  // these are last, so that kept inputs keep their meaning
    if (frame.profile.raster.coverage == rasterizer::CoverageRule::snapped_edges && bytes.one_in(3)) {
        const int x = bytes.below(16), y = bytes.below(16);
        frame.options.raster.sample = rasterizer::SamplePoint{x, y};
    }
    choose_of_algorithms(bytes, frame.options.algorithm);
    if (frame.profile.raster.coverage == rasterizer::CoverageRule::snapped_edges)
        choose_sample(bytes, frame.profile, frame.options.raster);
    if (frame.profile.raster.coverage == rasterizer::CoverageRule::snapped_edges)
        choose_sampling(bytes, frame.profile, frame.options);
    choose_lights(bytes, frame.options);
    return frame;
}

}  // namespace strata::fuzz
