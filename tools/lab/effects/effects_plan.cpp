// tools/lab/effects/effects_plan.cpp - decides for every effect whether a run simulates it, which state of the passes
// needs it, and how many fragments it has; from counted passes and the census of tiles (effects_plan.h).
#include "tools/lab/effects/effects_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "peeling/raster_state.h"
#include "peeling/registry.h"
#include "peeling/render.h"

namespace strata::tools {

namespace {

using pipeline::AlphaMode;
using pipeline::Effect;
using pipeline::Material;
using pipeline::PassRecord;

// --alpha makes all materials transparent.
bool is_transparent(const RunOptions& options, const Material& m) {
    return options.render.alpha || m.alpha_mode == AlphaMode::blend;
}

// The number of occurrences of a pass in the whole run: once per record before the first iteration and in it; all later
// iterations are alike.
struct Occurrences {
    std::uint64_t before = 0, first = 0, later = 0;
    [[nodiscard]] std::uint64_t in(int iterations) const {
        if (iterations == 0) return before;
        return before + first + later * static_cast<std::uint64_t>(iterations - 1);
    }
};

template <class Holds>
std::uint64_t count_passes(const pipeline::PassLog& log, int iterations, Holds holds) {
    Occurrences found;
    bool has_later = false;
    for (const PassRecord& pass : log.passes) {
        has_later |= pass.iteration == 2;
        if (pass.is_opaque_priming || pass.iteration > 2 || !holds(pass)) continue;
        ++(pass.iteration == 0 ? found.before : pass.iteration == 1 ? found.first : found.later);
    }
    // The small run ended after one iteration: later ones are assumed to be like the first.
    if (!has_later) found.later = found.first;
    return found.in(iterations);
}

// "glass, leaf and 3 more": the materials for which `holds`.
template <class Holds>
std::string names_of(const pipeline::DrawList& list, Holds holds) {
    std::vector<std::string> names;
    for (std::size_t m = 0; m < list.materials.size(); ++m) {
        const Material& material = list.materials[m];
        if (holds(material)) names.push_back(material.name.empty() ? fmt::format("number {}", m) : material.name);
    }
    const std::size_t shown = std::min<std::size_t>(names.size(), 3);
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(shown);
    const std::string more = names.size() > shown ? fmt::format(" and {} more", names.size() - shown) : "";
    return fmt::format("{}{}", fmt::join(names.begin(), end, ", "), more);
}

// A row that depends on the state of each pass: `called` says what needs it, `idle` why nothing does.
struct PassEffect {
    const char* name;
    Effect effect;
    bool (*is_in)(const PassRecord&);
    const char* called;
    const char* idle;
};

// True if an existing colour target is blended.
bool is_blending(const PassRecord& p) {
    for (std::size_t k = 0; k < p.state.color.size(); ++k)
        if (p.state.color[k].exists() && p.state.blend[k].reads_target()) return true;
    return false;
}

// In the order in which a fragment meets them.
constexpr std::array pass_effects{
    PassEffect{"colour interpolation, perspective division", Effect::color,
               [](const PassRecord& p) { return p.needs.color; },
               "a program looks at colour, or a MASK material must be shaded", "no program looks at colour"},
    PassEffect{"texture coordinates", Effect::texcoord, [](const PassRecord& p) { return p.needs.texcoord; },
               "colour is looked at and a material has a texture", "nothing samples"},
    PassEffect{"colour sum", Effect::none, [](const PassRecord& p) { return p.needs.secondary; },
               "colour is looked at, and lights with separate-specular", "no lights with separate-specular"},
    PassEffect{"fog", Effect::none, [](const PassRecord& p) { return p.needs.fog; }, "colour is looked at, and --fog",
               "no --fog"},
    PassEffect{"program depth", Effect::shader_z, [](const PassRecord& p) { return p.needs.shader_z; },
               "a program compares depths", "no program looks at depth"},
    PassEffect{"stored depth code", Effect::code, [](const PassRecord& p) { return p.needs.code; },
               "a depth test, a depth unit or a program compares codes", "nothing compares codes"},
    PassEffect{"exact depth code", Effect::none, [](const PassRecord& p) { return p.needs.exact_code; },
               "the oracle's own order", "the oracle alone asks for it"},
    PassEffect{"facing", Effect::facing, [](const PassRecord& p) { return p.needs.facing; }, "a two-sided stencil test",
               "no two-sided stencil test"},
    PassEffect{"loads of the own pixel", Effect::loads,
               [](const PassRecord& p) {
                   return std::any_of(p.state.reads.begin(), p.state.reads.end(), [](auto t) { return t.exists(); });
               },
               "a program compares with what an earlier pass left", "no program loads"},
    PassEffect{"alpha test", Effect::alpha_test, [](const PassRecord& p) { return p.state.alpha.enabled; },
               "the pass's state", "no pass enables it"},
    PassEffect{"sequential depth units", Effect::none, [](const PassRecord& p) { return p.state.depth_unit_count > 0; },
               "the pass's state", "no pass has one"},
    PassEffect{"stencil test", Effect::stencil_test, [](const PassRecord& p) { return p.state.stencil.enabled; },
               "the pass's state", "no pass enables it, and there is no stencil buffer"},
    PassEffect{"depth test", Effect::depth_test, [](const PassRecord& p) { return p.state.depth.enabled; },
               "the pass's state", "no pass of the algorithm enables it"},
    PassEffect{"depth write", Effect::none,
               [](const PassRecord& p) { return p.state.depth.enabled && p.state.depth.write; }, "the pass's state",
               "no pass of the algorithm writes depth"},
    PassEffect{"blending", Effect::blending, is_blending, "the pass's state", "no pass blends"}};

// The stages that --effects all runs with a state that changes nothing.
bool idles_when_off(Effect effect) {
    return effect == Effect::alpha_test || effect == Effect::stencil_test || effect == Effect::depth_test ||
           effect == Effect::blending;
}

// Summed over all materials.
std::uint64_t total(const std::vector<std::uint64_t>& counts) {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : counts) sum += count;
    return sum;
}

// Collects the rows: the small literal run is made in the constructor, the rest in plan().
class Planner {
  public:
    Planner(const BenchJob& job, const BenchRun& run) : job_{job}, run_{run} {
        const RunOptions& options = job.scene->options;
        peeling::RenderOptions small = options.render;
        constexpr int longest = 128;  // passes do not depend on the size
        // Both sides are divided by the same number to keep the aspect.
        const int scale = std::max(1, (std::max(small.width, small.height) + longest - 1) / longest);
        small.width = std::max(1, small.width / scale);
        small.height = std::max(1, small.height / scale);
        small.execution = pipeline::Execution::literal;
        small.effects = job.effects;
        small.threads = 1;
        small.audit = small.nearest_depth = false;
        log_ = run_algorithm(job, small, {.log_passes = true}).frame.pass_log;
    }

    EffectsPlan plan() {
        census();
        plan_.geometry_passes = passes([](const PassRecord&) { return true; });
        add_scene();
        for (const PassEffect& e : pass_effects) {
            const std::uint64_t count = passes(e.is_in);
            const std::uint64_t called = passes([&](PassRecord p) {
                p.needs = p.called_for;
                return e.is_in(p);
            });
            const bool idles = called == 0 && job_.effects == pipeline::Effects::all && idles_when_off(e.effect);
            const std::uint64_t simulated = idles ? plan_.geometry_passes : count;
            add(e.name, simulated > 0,
                simulated == 0 ? e.idle
                : called == 0  ? "--effects all"
                               : e.called,
                simulated, simulated * total(plan_.tiles.transparent_fragments));
            plan_.rows.back().effect_id = e.effect;
        }
        add_frame();
        return std::move(plan_);
    }

  private:
    template <class Holds>
    [[nodiscard]] std::uint64_t passes(Holds holds) const {
        if (job_.algorithm != nullptr &&
            (job_.algorithm->whole_frame || job_.algorithm->runs_loops))  // its iterations differ from each other
            return static_cast<std::uint64_t>(
                std::count_if(log_.passes.begin(), log_.passes.end(),
                              [&](const PassRecord& pass) { return !pass.is_opaque_priming && holds(pass); }));
        return count_passes(log_, run_.iterations, holds);
    }

    void add(std::string effect, bool is_simulated, std::string why, std::uint64_t pass_count,
             std::uint64_t fragments) {
        plan_.rows.push_back({.effect = std::move(effect),
                              .is_simulated = is_simulated,
                              .why = std::move(why),
                              .passes = pass_count,
                              .fragments = fragments,
                              .seconds = {}});
    }

    [[nodiscard]] const pipeline::DrawList& list() const { return job_.scene->session.scene.list; }

    void census() {
        const RunOptions& options = job_.scene->options;
        const Session& session = job_.scene->session;
        const rasterizer::RasterState raster = peeling::raster_state(options.render, session.profile);
        using pipeline::Selection;
        const peeling::Algorithm& one_pass = *peeling::find_algorithm("unsorted");  // a depth pass has one pass, too
        const int tile_size = tile_size_of(options.render, job_.algorithm == nullptr ? one_pass : *job_.algorithm);
        const auto prepared = [&](Selection selection) {
            return pipeline::prepare(
                list(), session.view, raster, session.profile,
                {.selection = selection, .tile_size = tile_size, .threads = options.render.threads});
        };
        // Counts tiles and fragments of both lists in the whole frame, with the tiles of the run. With --alpha nothing
        // is opaque, and the other list is empty.
        pipeline::PreparedDraw opaque = prepared(Selection::opaque);
        if (options.render.alpha) std::fill(opaque.geometry.bin_start.begin(), opaque.geometry.bin_start.end(), 0u);
        plan_.drawn = prepared(options.render.alpha ? Selection::all : Selection::transparent);
        setup_ = plan_.drawn.geometry.counters;
        plan_.tiles = pipeline::count_tiles(plan_.drawn, opaque);
    }

    // A row that materials need: in `drawn` passes over the transparent list, and once in the opaque pass.
    template <class Holds>
    void add_material_row(const char* effect, Holds holds, const char* called, const char* idle, std::uint64_t drawn) {
        std::uint64_t transparent = 0, opaque = 0, fragments = 0;
        for (std::size_t m = 0; m < list().materials.size(); ++m) {
            const Material& material = list().materials[m];
            if (!holds(material)) continue;
            ++(is_transparent(job_.scene->options, material) ? transparent : opaque);
            fragments += drawn * plan_.tiles.transparent_fragments[m] + plan_.tiles.opaque_fragments[m];
        }
        const std::uint64_t count = (transparent > 0 ? drawn : 0) + (opaque > 0 ? 1 : 0);
        if (count > 0)
            add(effect, true, fmt::format("{}: {}", called, names_of(list(), holds)), count, fragments);
        else
            add(effect, false, idle, 0, 0);
    }

    // Once per frame, with vertices or triangles and no fragments.
    template <class Holds>
    void add_geometry_row(const char* effect, Holds holds, const std::string& called, const char* idle) {
        const std::string names = names_of(list(), holds);
        add(effect, !names.empty(), names.empty() ? idle : called + names, 0, 0);
    }

    // "lit materials: teapot" with the light at the eye, else "3 lights on lit materials: teapot".
    void add_scene() {
        const peeling::RenderOptions& render = job_.scene->options.render;
        const std::size_t lights = render.lights.value_or(list().lights).size();
        add_geometry_row(
            "lighting, at the vertices", [](const Material& m) { return !m.unlit; },
            lights == 0 ? "lit materials: "
                        : fmt::format("{} {} on lit materials: ", lights, lights == 1 ? "light" : "lights"),
            "every material is unlit");
        add_geometry_row(
            "culling", [](const Material& m) { return !m.double_sided; },
            fmt::format("drops {} triangles in the algorithm's passes; single-sided: ", setup_.culled),
            "every material is double-sided");
        const RunOptions& options = job_.scene->options;
        add_material_row(
            "opaque priming", [&](const Material& m) { return !is_transparent(options, m); }, "opaque materials",
            "nothing is opaque", 0);
        add_material_row(
            "alphaMode MASK", [](const Material& m) { return m.alpha_mode == AlphaMode::mask; },
            "materials with a cutoff", "no material is MASK", plan_.geometry_passes);
        add_material_row(
            "texture sampling", [](const Material& m) { return m.texture >= 0; }, "materials with a texture",
            "no material has a texture", passes([](const PassRecord& p) { return p.samples_textures; }));
    }

    // Adds the effects of the frame as a whole, not of one tile or pass.
    void add_frame() {
        const peeling::RenderOptions& o = job_.scene->options.render;
        const std::uint64_t drawn = total(plan_.tiles.transparent_fragments);
        add("clipping", setup_.clipped > 0, fmt::format("{} triangles cross a clip plane", setup_.clipped), 0, 0);
        const auto is_other = [&](const pipeline::Instance& i) {
            return list().meshes[i.mesh].primitive != pipeline::Primitive::triangles;
        };
        const auto others = std::ranges::count_if(list().instances, is_other);
        add("lines and points", others > 0,
            others > 0 ? fmt::format("{} of {} instances", others, list().instances.size()) : "triangles alone", 0, 0);
        add("user clip planes", o.raster.clip_plane_count > 0, "set by a program alone", 0, 0);
        add("scissor", o.raster.scissor.has_value(), o.raster.scissor ? "--scissor" : "no --scissor", 0, 0);
        add("polygon offset", o.raster.polygon_offset.enabled,
            o.raster.polygon_offset.enabled ? "--polygon-offset" : "no --polygon-offset", 0, 0);
        const auto iterations = static_cast<std::uint64_t>(run_.iterations);
        add("peeling, pass after pass", iterations > 1,
            iterations > 1 ? fmt::format("{} iterations; {} of {} tiles have pixels with several fragments", iterations,
                                         plan_.tiles.layered, plan_.tiles.tiles)
                           : "one iteration is enough for this algorithm and scene",
            iterations > 1 ? plan_.geometry_passes : 0, iterations > 1 ? plan_.geometry_passes * drawn : 0);
        const bool asks = log_.queries > 0;
        add("occlusion queries", asks, asks ? "each iteration asks what is left" : "nothing asks",
            asks ? iterations : 0, asks ? iterations * drawn : 0);
        add("kept layers", o.keep_layers, "strata layers alone keeps them", 0, 0);
    }

    const BenchJob& job_;
    const BenchRun& run_;
    pipeline::PassLog log_;
    rasterizer::SetupCounters setup_;
    EffectsPlan plan_;
};

}  // namespace

EffectsPlan plan_effects(const BenchJob& job, const BenchRun& run) { return Planner{job, run}.plan(); }

}  // namespace strata::tools
