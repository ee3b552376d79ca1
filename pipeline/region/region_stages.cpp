// pipeline/region/region_stages.cpp - the stages of a batch from the rasterizer to the render targets, in OpenGL's
// order: texture and MASK, (the fragment program), alpha test, depth units, stencil test, depth test, query, blending
// (pipeline/reference/fragment-stages.md 1).
#include "pipeline/region/region_stages.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "pipeline/device/check.h"
#include "pipeline/formats/convert.h"
#include "pipeline/formats/narrow.h"
#include "pipeline/formats/packed.h"
#include "pipeline/formats/resolve.h"
#include "pipeline/formats/unorm8.h"
#include "pipeline/fragments/tile_cache.h"
#include "pipeline/frame/check_pass.h"
#include "pipeline/frame/effects.h"
#include "pipeline/frame/pass_counters.h"
#include "pipeline/lighting/add_secondary.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/region/region_shared.h"
#include "pipeline/region/region_targets.h"
#include "pipeline/stages/alpha_test.h"
#include "pipeline/stages/blend.h"
#include "pipeline/stages/mix_fog.h"
#include "pipeline/stages/stage_lanes.h"
#include "pipeline/textures/shadow_stage.h"
#include "pipeline/textures/texture_sample.h"

namespace strata::pipeline {

namespace {

// The source of a blend on a 16-bit surface: colours truncated to its bits, alpha unchanged (narrow.h).
const ColorLanes& blended_source(Format format, const ColorLanes& source, ColorLanes& cut, int count) noexcept {
    if (info(format).bytes_per_pixel != 2 || !is_narrow(format)) return source;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            cut[c][i] =
                c == 3 ? source[c][i] : unorm8_value(narrowed(format, static_cast<int>(c), to_unorm8(source[c][i])));
    return cut;
}
// Blending ONE and ZERO, which leaves an UNORM8 source unchanged (execution.md 6.1), with the pass's write mask.
Blend neutral(const Blend& blending) {
    return {.enabled = true, .color = {}, .alpha = {}, .write_mask = blending.write_mask};
}

}  // namespace

Stages::Stages(const RegionShared& shared, Targets& targets) noexcept : shared_{shared}, targets_{targets} {}
Stages::~Stages() = default;

const Loads& Stages::loads() const noexcept { return shared_.scratch.loads; }
std::uint64_t Stages::alive_count(const Outputs& out, int count) noexcept { return count_lanes(out.alive, count); }

void Stages::show(Stage stage, const PassState& state, const FragmentBatch& batch, const Outputs& out,
                  const Lanes<std::uint32_t>& alive, int sample) const {
    if (const Observer* o = shared_.instruments.observer; o != nullptr && o->stage)
        o->stage(shared_.region,
                 {stage, state, batch, out, alive, sample, kind_ == PassKind::geometry, shared_.statistics.counts});
}

// Checks a pass and records everything about it that does not depend on its fragments. Fragments have one code each, so
// a depth target must have the format of the frame's codes. check_pass ensures that all targets have the same number of
// samples.
void Stages::begin_pass(const PassState& state, PassKind kind) {
    kind_ = kind;
    tallied_ = 0;
    check_pass(shared_.profile(), state, targets_.all());
    if (shared_.samples > 1) require_elements(state);
    if (loaded_sample() != LoadedSample::own && state.ordered_rmw && std::ranges::any_of(state.reads, &Target::exists))
        throw Refused{shared_.profile(),
                      {"loads of another sample from a target that the pass writes", "", "use --load-sample own"}};
    if (writes_depth(state.depth)) targets_.note_written(state.depth_target);
    depth_ = DepthOutcome::open;
    if (state.depth.enabled &&
        depth_format(targets_.at(state.depth_target).format()) != shared_.frame.key_request().format)
        throw std::logic_error("pass state: the depth target's format is not that of the frame's depth codes");
    samples_ = 1;
    for (const Target t : {state.depth_target, state.stencil_target})
        if (t.exists()) samples_ = targets_.at(t).samples();
    for (const Target t : state.color)
        if (t.exists()) samples_ = targets_.at(t).samples();
    if (kind == PassKind::geometry) {
        shared_.count_pass({.geometry = 1});
        if (shared_.statistics.counts) ++shared_.statistics.geometry_passes;
        return;
    }
    shared_.count_pass({.full_screen = 1});
    for (std::size_t k = 0; k < state.color.size();
         ++k)  // a quad's traffic includes every pixel, whatever its program discards
        if (state.color[k].exists()) count_color_bytes(state.blend[k], targets_.at(state.color[k]), shared_.elements());
}

// A target of pixels has no sample of its own that a pass could write, and a pass once a pixel has none to load.
void Stages::require_elements(const PassState& state) const {
    const auto is_of_pixels = [&](Target t) { return t.exists() && targets_.at(t).pixels() != shared_.elements(); };
    if (!state.once_a_pixel && std::ranges::any_of(state.color, is_of_pixels))
        throw std::logic_error("pass state: a target of pixels is written by passes once a pixel");
    const auto is_of_samples = [&](Target t) { return t.exists() && !is_of_pixels(t); };
    if (state.once_a_pixel && loaded_sample() == LoadedSample::own && std::ranges::any_of(state.reads, is_of_samples))
        throw std::logic_error("pass state: a pass once a pixel loads targets of pixels");
}

void Stages::count_color_bytes(const Blend& blending, const TargetStorage& target, std::uint64_t pixels) {
    shared_.count(of_color(pixel_bytes(target), pixels, blending.reads_target()));
}

// Window positions fit in 16 bits: a frame has at most 16,384 pixels per side.
FragmentBatch* Stages::next_screen_batch(std::size_t& next) {
    FragmentBatch& batch = shared_.scratch.screen;
    const std::size_t pixels = shared_.pixels();
    if (next == shared_.elements()) return nullptr;
    const std::size_t first = next % pixels, count = std::min<std::size_t>(pixels - first, batch_capacity);
    const auto width = static_cast<std::size_t>(shared_.rect().width());
    std::iota(batch.pixel.begin(), batch.pixel.begin() + static_cast<std::ptrdiff_t>(count), static_cast<Word>(next));
    for (std::size_t i = 0; i < count;) {
        const std::size_t x = (first + i) % width, y = (first + i) / width, end = std::min(count, i + width - x);
        const auto first_x = static_cast<std::uint16_t>(static_cast<std::size_t>(shared_.rect().x0) + x);
        for (std::size_t k = i; k < end; ++k) batch.x[k] = static_cast<std::uint16_t>(first_x + (k - i));
        std::fill(batch.y.begin() + static_cast<std::ptrdiff_t>(i), batch.y.begin() + static_cast<std::ptrdiff_t>(end),
                  static_cast<std::uint16_t>(static_cast<std::size_t>(shared_.rect().y0) + y));
        i = end;
    }
    next += count;
    batch.count = static_cast<int>(count);
    return &batch;
}

// Colours are not cleared: a program writes the outputs for which its pass has targets.
Outputs& Stages::start_batch(const FragmentBatch& batch) {
    Outputs& out = shared_.scratch.out;
    std::fill_n(out.alive.begin(), batch.count, ~0u);
    out.traced = out.replaces_depth = false;
    return out;
}

// Texture, shadow, colour sum, fog, MASK (fragment-stages.md 2). MASK compares the material's own alpha, so the alpha
// scale is applied after it; its precision is that of the frame's colour format, whatever the pass's targets are.
void Stages::shade(const PreparedDraw& list, FragmentBatch& batch, Outputs& out) {
    shared_.statistics.fragments_drawn += static_cast<std::uint64_t>(batch.count);
    shared_.count({.fragments_rasterized = static_cast<std::uint64_t>(batch.count)});
    const MaterialStage& material = list.materials[batch.material];
    if (material.texture != nullptr && shaded_.texcoord) {
        sample(*material.texture, shared_.profile().texture_filter, batch.texcoord[0], batch.texcoord[1],
               shared_.scratch.texel, batch.count);
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
                batch.color[c][i] *= shared_.scratch.texel[c][i];
    }
    if (shaded_.shadow != 0) cast_shadow(*shared_.frame.shadow, shared_.profile(), batch, shared_.scratch.texel);
    if (shaded_.secondary) add_secondary(shared_.profile().lighting, batch);
    if (shaded_.fog) mix_fog(*shared_.frame.fog, shared_.profile().fog, batch);
    if (!material.mask.enabled) return;
    const bool eight_bit = is_eight_bit_alpha(shared_.profile().alpha_test, info(shared_.frame.color_format).type);
    alpha_test(material.mask, eight_bit, batch.color[3].data(), out.alive.data(), batch.count);
    shared_.count({.alpha_killed = static_cast<std::uint64_t>(batch.count) - alive_count(out, batch.count)});
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) batch.color[3][i] *= material.alpha_scale;
}

// Dead lanes load too: the traffic is that of every fragment of the batch (execution.md 8.1).
void Stages::load(const PassState& state, const FragmentBatch& batch) {
    for (const Target t : state.textures)
        if (t.exists()) shared_.count(of_loads(pixel_bytes(targets_.at(t)), static_cast<std::uint64_t>(batch.count)));
    for (std::size_t r = 0; r < state.reads.size(); ++r) {
        if (!state.reads[r].exists()) continue;
        TargetStorage& from = targets_.at(state.reads[r]);
        shared_.count(of_loads(pixel_bytes(from), static_cast<std::uint64_t>(batch.count)));
        if (from.pixels() != shared_.elements()) {
            load_target(from, r, elements_of(batch, 0), batch.count);
            continue;
        }
        switch (loaded_sample()) {
            case LoadedSample::own: load_target(from, r, batch.pixel, batch.count); break;
            case LoadedSample::zero: load_target(from, r, elements_of(batch, 0), batch.count); break;
            case LoadedSample::resolved: load_resolved(from, r, batch); break;
        }
        if (shared_.instruments.once_more == Effect::loads) load_target(from, r, batch.pixel, batch.count);
    }
}

// The elements of the batch's pixels at another sample.
Lanes<std::uint32_t> Stages::elements_of(const FragmentBatch& batch, std::size_t sample) const noexcept {
    const auto pixels = static_cast<std::uint32_t>(shared_.pixels());
    Lanes<std::uint32_t> elements;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
        elements[i] = static_cast<std::uint32_t>(sample) * pixels + batch.pixel[i] % pixels;
    return elements;
}

// A depth is loaded as its code. In a colour, channels that the format lacks read as 0, alpha as 1.
void Stages::load_target(TargetStorage& from, std::size_t read, const Lanes<std::uint32_t>& elements, int count) {
    if (is_depth(from.format()))
        return gather_codes(codes_in(from.depth_plane(0)), {elements.data(), static_cast<std::size_t>(count)},
                            &shared_.scratch.loads.depth_[read]);
    from.gather(elements, count, 0, shared_.scratch.codes);
    decode_loaded(from.format(), read, count);
}

void Stages::decode_loaded(Format stored, std::size_t read, int count) {
    const FormatInfo format = info(stored);
    for (std::size_t c = 0; c < 4; ++c) {
        Lanes<float>& values = shared_.scratch.loads.color_[read][c];
        const auto each = [&](auto value) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
                values[i] = value(shared_.scratch.codes[c][i]);
        };
        const UnormRounding unorm = shared_.profile().unorm_rounding;
        const HalfRounding half = shared_.profile().half_rounding;
        const bool is_there = c < static_cast<std::size_t>(format.channels);
        if (is_there && is_packed(stored))
            each([&](std::uint32_t code) { return packed_value(stored, static_cast<int>(c), code, {half, unorm}); });
        else if (is_there && format.type == ChannelType::unorm8 && unorm != UnormRounding::half_up)
            each([&](std::uint32_t code) { return code_value(code, unorm); });
        else if (is_there && format.type == ChannelType::half && half == HalfRounding::no_infinity)
            each([&](std::uint32_t code) { return half_value(static_cast<std::uint16_t>(code), half); });
        else if (is_there)
            decode(format.type, shared_.scratch.codes[c], values, count);
        else
            std::fill_n(values.begin(), count, c == 3 ? 1.0f : 0.0f);
    }
}

// The emulator's own passes, which are not counted, look at their own sample.
LoadedSample Stages::loaded_sample() const noexcept {
    if (shared_.samples == 1 || !shared_.statistics.counts) return LoadedSample::own;
    return kind_ == PassKind::geometry ? shared_.frame.loads : shared_.frame.composites;
}

// By the rules of a picture's resolve: the nearest depth, which has the least code or key, and the mean of colours.
void Stages::load_resolved(TargetStorage& from, std::size_t read, const FragmentBatch& batch) {
    const DeviceProfile& profile = shared_.profile();
    const Format format = from.format();
    if (is_depth(format)) {
        Lanes<std::uint32_t>& nearest = shared_.scratch.loads.depth_[read];
        std::fill_n(nearest.begin(), batch.count, ~0u);
        Lanes<std::uint32_t> code;
        for (std::size_t s = 0; s < shared_.samples; ++s) {
            const Lanes<std::uint32_t> elements = elements_of(batch, s);
            gather_codes(codes_in(from.depth_plane(0)), {elements.data(), static_cast<std::size_t>(batch.count)},
                         &code);
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
                nearest[i] = std::min(nearest[i], code[i]);
        }
        return;
    }
    ColorResolve resolve{static_cast<int>(shared_.samples), profile.resolve, profile.color_rounding()};
    Image sample{format, batch.count, 1};
    ColorCodes& codes = shared_.scratch.codes;
    const auto for_each_code = [&](Image& image, const auto& visit) {
        const auto channels = static_cast<std::size_t>(image.channels());
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
            for (std::size_t c = 0; c < channels; ++c) visit(image.codes[i * channels + c], codes[c][i]);
    };
    for (std::size_t s = 0; s < shared_.samples; ++s) {
        from.gather(elements_of(batch, s), batch.count, 0, codes);
        for_each_code(sample, [](std::uint32_t& stored, std::uint32_t code) { stored = code; });
        resolve.add(sample);
    }
    Image mean = std::move(resolve).picture();
    for_each_code(mean, [](std::uint32_t stored, std::uint32_t& code) { code = stored; });
    decode_loaded(format, read, batch.count);
}

void Stages::run_program(const PassState& state, FragmentBatch& batch, Outputs& out,
                         const std::function<void()>& program) {
    const std::uint64_t before = alive_count(out, batch.count);
    const std::uint64_t tally = out.tally;
    if (const Alteration* a = shared_.alteration(); a != nullptr && a->program)
        a->program({state, kind_, batch, loads(), out}, program);
    else
        program();
    if (out.replaces_depth) std::copy_n(out.depth.begin(), batch.count, batch.code.begin());
    tallied_ += out.tally - tally;
    show(Stage::program, state, batch, out, out.alive);
    if (kind_ != PassKind::geometry) return;
    shared_.count({.discarded = before - alive_count(out, batch.count)});
    if (shared_.statistics.counts) shared_.statistics.fragments_processed += static_cast<std::uint64_t>(batch.count);
}

// The alpha test compares 8-bit codes unless target 0 is a float format and the profile decides by the target
// (fragment-stages.md 3).
void Stages::finish(const PassState& state, const FragmentBatch& batch, Outputs& out, DrawCounts& drawn) {
    cover_samples(state, batch, out);
    if (state.alpha.enabled) {
        const std::uint64_t before = alive_count(out, batch.count);
        const ChannelType type =
            state.color[0].exists() ? info(targets_.at(state.color[0]).format()).type : ChannelType::unorm8;
        alpha_test(state.alpha, is_eight_bit_alpha(shared_.profile().alpha_test, type), out.color[0][3].data(),
                   out.alive.data(), batch.count);
        shared_.count({.alpha_killed = before - alive_count(out, batch.count)});
    }
    if (shared_.runs_extra(Effect::alpha_test, state.alpha.enabled)) extra_alpha_test(state, batch, out);
    show(Stage::alpha_test, state, batch, out, out.alive);
    for (int sample = 0; sample < samples_; ++sample)
        if (state.sample_mask >> sample & 1u) finish_sample(state, batch, out, sample, drawn);
    drawn.tallied = Count{tallied_};
}

// Every sample has the same colour and code, but its own tests. Queries count samples; the counter `blended` and the
// trace use only sample 0 (fragment-stages.md 10.3).
void Stages::finish_sample(const PassState& state, const FragmentBatch& batch, const Outputs& out, int sample,
                           DrawCounts& drawn) {
    Lanes<std::uint32_t>& alive = shared_.scratch.alive;
    std::copy_n(out.alive.begin(), batch.count, alive.begin());
    if (state.depth_unit_count > 0) test_depth_units(state, batch, sample, alive);
    show(Stage::depth_units, state, batch, out, alive, sample);
    extra_tests(state, batch, alive);
    const bool is_tested = state.depth.enabled || state.stencil.enabled;
    const std::uint64_t passed =
        is_tested ? test_depth_and_stencil(state, batch, sample, alive) : count_lanes(alive, batch.count);
    drawn.passed.own_ += passed;
    show(Stage::tests, state, batch, out, alive, sample);
    // Without a test, fragments that a program discards also fetch tiles (fragment-stages.md 9.5).
    if (passed == 0 && (cache_ == nullptr || is_tested)) return;
    if (kind_ == PassKind::geometry && sample == 0) shared_.count({.blended = passed});
    write_colors(state, batch, out, sample, alive, passed, shared_.elements());
    show(Stage::written, state, batch, out, alive, sample);
    if (out.traced && shared_.frame.trace && shared_.statistics.counts && sample == 0) record_trace(batch, out, alive);
}

// A quad composites a layer and not a fragment of its own, so it has no primitive: the audit then compares only keys.
void Stages::record_trace(const FragmentBatch& batch, const Outputs& out, const Lanes<std::uint32_t>& alive) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
        if (alive[i] != 0 && out.side[i] != Side::none)
            shared_.trace({batch.pixel[i], out.key[i], kind_ == PassKind::geometry ? batch.primitive[i] : 0,
                           out.side[i], kind_ == PassKind::geometry});
}

void Stages::open_cache(const PassState& state) {
    if (shared_.profile().blend_storage == BlendStorage::target) return;
    if (cache_ == nullptr) cache_ = std::make_unique<TileCache>(shared_.rect(), shared_.frame.rect(), shared_.samples);
    for (std::size_t k = 0; k < state.color.size(); ++k) {
        if (!state.color[k].exists()) continue;
        const TargetStorage& target = targets_.at(state.color[k]);
        if (!TileCache::knows(state.blend[k], target.format())) continue;
        CachedPlanes planes{target.format(), target.pixels(), {}};
        for (int sample = 0; sample < target.samples(); ++sample) planes.samples.push_back(target.texels(sample));
        cache_->hold(k, shared_.profile(), state.blend[k], std::move(planes));
    }
}

void Stages::close_cache() {
    if (cache_ != nullptr) cache_->close();
}

// Sums into halves have a kernel that adds in place; on instruction sets that do not convert halves it returns false,
// and the general path below, its definition, runs. Stored values are fetched only if blending or a partial write mask
// needs them.
void Stages::write_colors(const PassState& state, const FragmentBatch& batch, const Outputs& out, int sample,
                          const Lanes<std::uint32_t>& alive, std::uint64_t passed, std::size_t elements) {
    for (std::size_t k = 0; k < state.color.size(); ++k) {
        const Blend& blending = state.blend[k];
        if (!state.color[k].exists() || blending.write_mask == 0) continue;
        TargetStorage& target = targets_.at(state.color[k]);
        if (target.pixels() != elements) continue;
        const FormatInfo format = info(target.format());
        if (kind_ == PassKind::geometry) count_color_bytes(blending, target, passed);
        if (cache_ != nullptr && cache_->holds(k)) {
            const auto& fetched = state.depth.enabled || state.stencil.enabled ? alive : every_lane;
            if (shared_.runs_extra(Effect::blending, true)) extra_blend(blending, batch, out.color[k], target, sample);
            cache_->blend(k, {batch, out.color[k], alive, fetched, sample});
            continue;
        }
        const bool is_extra = shared_.runs_extra(Effect::blending, blending.blends());
        const bool keeps_source = is_extra && !blending.enabled && !blending.logic_op && !blending.dither &&
                                  format.type == ChannelType::unorm8;  // ONE and ZERO have the same result
        if (is_extra && !keeps_source) extra_blend(blending, batch, out.color[k], target, sample);
        const bool adds_halves = shared_.frame.effects == Effects::needed && !is_packed(target.format()) &&
                                 format.type == ChannelType::half &&
                                 shared_.profile().half_rounding == HalfRounding::nearest_even &&
                                 blending == blend_mode::sum;
        if (adds_halves && target.add(batch.pixel, alive, batch.count, sample, out.color[k],
                                      shared_.profile().denormals == DenormalRule::flush))
            continue;
        Blend used = keeps_source ? neutral(blending) : blending;
        used.enabled = used.blends();
        if (used.enabled || used.logic_op || blending.write_mask != 0xf || shared_.frame.effects == Effects::all)
            target.gather(batch.pixel, batch.count, sample, shared_.scratch.codes);
        const bool is_dithered = used.dither && !used.enabled;  // from all bits of the source
        const ColorLanes& source =
            is_dithered ? out.color[k]
                        : blended_source(target.format(), out.color[k], shared_.scratch.texel, batch.count);
        if (used.logic_op) shared_.scratch.extra_codes = shared_.scratch.codes;
        blend_into(target.format(), used, shared_.profile(), source, shared_.scratch.codes, batch.count);
        if (used.logic_op || used.dither || is_narrow(target.format()))
            finish_codes(target.format(), used, source, {batch.x, batch.y, shared_.scratch.extra_codes},
                         shared_.scratch.codes, batch.count);
        target.scatter(batch.pixel, alive, batch.count, sample, blending.write_mask, shared_.scratch.codes);
    }
}

}  // namespace strata::pipeline
