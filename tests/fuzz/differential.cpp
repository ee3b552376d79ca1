#include "tests/fuzz/differential.h"

#include <functional>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "tests/support/difference.h"

namespace strata::fuzz {

peeling::RenderResult run(const FrameCase& frame, const ExecutionWay& way) {
    peeling::RenderOptions options = frame.options;
    options.execution = way.execution;
    options.tile_size = way.tile_size;
    options.effects = way.effects;
    options.simd = has_simd(way.simd) ? way.simd : Simd::best;
    options.fragment_memory = way.fragment_memory;
    peeling::Renderer renderer{frame.list, frame.view, frame.profile, options};
    if (frame.algorithm == "depth_pass") return renderer.depth_pass({}, {.trust_idle = way.trust_idle});
    const peeling::Algorithm& algorithm = *peeling::find_algorithm(frame.algorithm);
    // With this check programs run twice and record everything twice, so only broken contracts are reported.
    if (way.check_selections)
        static_cast<void>(renderer.render(algorithm, {}, {.check_selections = true, .trust_idle = way.trust_idle}));
    return renderer.render(algorithm, {}, {.trust_idle = way.trust_idle});
}

namespace {

// Applies `change` and keeps the changed frame if it still differs.
bool try_change(FrameCase& frame, const std::function<void(FrameCase&)>& change) {
    FrameCase smaller = frame;
    change(smaller);
    if (first_difference(smaller).empty()) return false;
    frame = std::move(smaller);
    return true;
}

template <class T>
bool drop_from(FrameCase& frame, const std::function<std::vector<T>&(FrameCase&)>& list, std::size_t first,
               std::size_t stride) {
    bool dropped = false;
    for (std::size_t i = list(frame).size(); i >= first + stride; i -= stride)
        dropped |= try_change(frame, [&](FrameCase& f) {
            const auto begin = list(f).begin() + static_cast<std::ptrdiff_t>(i - stride);
            list(f).erase(begin, begin + static_cast<std::ptrdiff_t>(stride));
        });
    return dropped;
}

bool drop_geometry(FrameCase& frame) {
    bool dropped = drop_from<pipeline::Instance>(
        frame, [](FrameCase & f) -> auto& { return f.list.instances; }, 0, 1);
    for (std::size_t m = 0; m < frame.list.meshes.size(); ++m)
        dropped |= drop_from<std::uint32_t>(
            frame, [m](FrameCase & f) -> auto& { return f.list.meshes[m].indices; }, 0, 3);
    return dropped;
}

template <class Visit>
void for_all_materials(FrameCase& f, Visit&& visit) {
    for (pipeline::Material& m : f.list.materials) visit(m);
}

// Changes that reset state and attributes to their defaults, one after the other.
const std::vector<std::function<void(FrameCase&)>>& simplifications() {
    static const peeling::RenderOptions plain;
    static const std::vector<std::function<void(FrameCase&)>> all{
        [](FrameCase& f) { f.options.raster = plain.raster; },
        [](FrameCase& f) { f.options.raster.scissor.reset(); },
        [](FrameCase& f) { f.options.raster.sample_coverage = {}; },
        [](FrameCase& f) { f.options.raster.interpolation = plain.raster.interpolation; },
        [](FrameCase& f) { leave_samples(f.options.raster); },
        [](FrameCase& f) { f.options.sampling = {}; },
        [](FrameCase& f) { f.options.sampling.loads = f.options.sampling.composites = {}; },
        [](FrameCase& f) { f.options.raster.polygon_offset = {}; },
        [](FrameCase& f) { f.options.raster.clip_plane_count = 0; },
        [](FrameCase& f) { f.options.raster.cull = plain.raster.cull; },
        [](FrameCase& f) { f.options.raster.front_face = plain.raster.front_face; },
        [](FrameCase& f) { f.options.raster.y_direction = plain.raster.y_direction; },
        [](FrameCase& f) { f.options.raster.clip_depth = plain.raster.clip_depth; },
        [](FrameCase& f) { f.options.raster.depth_clamp = false; },
        [](FrameCase& f) { f.options.raster.depth_near = 0, f.options.raster.depth_far = 1; },
        [](FrameCase& f) { f.options.depth.reset(); },
        [](FrameCase& f) { f.options.depth_path.reset(); },
        [](FrameCase& f) { f.options.color_format.reset(); },
        [](FrameCase& f) { f.options.result_format.reset(); },
        [](FrameCase& f) { f.options.back_format.reset(); },
        [](FrameCase& f) { f.options.average_count = plain.average_count; },
        [](FrameCase& f) { f.options.algorithm = {}; },
        [](FrameCase& f) { f.options.alpha.reset(); },
        [](FrameCase& f) { f.options.background = plain.background; },
        [](FrameCase& f) { f.options.termination = {}; },
        [](FrameCase& f) { f.options.max_passes = 0; },
        [](FrameCase& f) { f.options.keep_layers = false; },
        [](FrameCase& f) { f.options.audit = false; },
        [](FrameCase& f) { f.options.nearest_depth = false; },
        [](FrameCase& f) { f.options.width = 1; },
        [](FrameCase& f) { f.options.height = 1; },
        [](FrameCase& f) { f.options.width = 8; },
        [](FrameCase& f) { f.options.height = 8; },
        [](FrameCase& f) { f.view = {}; },
        [](FrameCase& f) { f.view.view = pipeline::identity; },
        [](FrameCase& f) {
            for (auto& i : f.list.instances) i.model = pipeline::identity;
        },
        [](FrameCase& f) {
            for (auto& mesh : f.list.meshes) mesh.colors.clear();
        },
        [](FrameCase& f) { for_all_materials(f, [](auto& m) { m.texture = -1; }); },
        [](FrameCase& f) { for_all_materials(f, [](auto& m) { m.unlit = true; }); },
        [](FrameCase& f) { for_all_materials(f, [](auto& m) { m.double_sided = true; }); },
        [](FrameCase& f) { for_all_materials(f, [](auto& m) { m.back = m.front; }); },
        [](FrameCase& f) { for_all_materials(f, [](auto& m) {
                               m.front = m.back = {1, 1, 1, 0.5f};
                           }); },
        [](FrameCase& f) {
            f.profile = *pipeline::find_profile(f.profile.name);
            if (f.profile.raster.coverage == rasterizer::CoverageRule::float_spans)
                leave_samples(f.options.raster), f.options.sampling = {};
        },
        [](FrameCase& f) { f.profile = *pipeline::find_profile("ideal"); },
        [](FrameCase& f) {
            for (ExecutionWay& w : f.ways) w.tile_size = 32;
        },
        [](FrameCase& f) {
            for (ExecutionWay& w : f.ways) w.effects = pipeline::Effects::needed;
        },
        [](FrameCase& f) {
            for (ExecutionWay& w : f.ways) w.trust_idle = true;
        },
        [](FrameCase& f) {
            for (ExecutionWay& w : f.ways) w.check_selections = false;
        },
        [](FrameCase& f) {
            for (ExecutionWay& w : f.ways) w.fragment_memory = plain.fragment_memory;
        },
        [](FrameCase& f) {
            for (ExecutionWay& w : f.ways) w.simd = f.ways[0].simd;
        },
        [](FrameCase& f) {
            for (ExecutionWay& w : f.ways) w.execution = f.ways[0].execution;
        },
    };
    return all;
}

}  // namespace

std::string first_difference(const FrameCase& frame) {
    const peeling::RenderResult expected = run(frame, frame.ways.front());
    for (std::size_t i = 1; i < frame.ways.size(); ++i) {
        std::string what;
        try {
            what = testing::difference(run(frame, frame.ways[i]), expected);
        } catch (const std::logic_error& broken) {
            what = broken.what();
        }
        if (what.empty()) continue;
        std::ostringstream text;
        text << what << " of ";
        print(text, frame.ways[i]);
        return text.str();
    }
    return {};
}

FrameCase reduced(FrameCase frame) {
    drop_from<ExecutionWay>(
        frame, [](FrameCase & f) -> auto& { return f.ways; }, 1, 1);
    while (drop_geometry(frame)) {
    }
    for (const auto& simplify : simplifications()) try_change(frame, simplify);
    while (drop_geometry(frame)) {
    }
    return frame;
}

bool check(std::span<const std::uint8_t> bytes, std::ostream& out, int threads) {
    FrameCase frame = make_case(bytes);
    frame.options.threads = threads;
    const std::string what = first_difference(frame);
    if (what.empty()) return true;
    const FrameCase smallest = reduced(frame);
    out << "differs: " << what << "\nreduced: " << first_difference(smallest) << '\n';
    print(out, smallest);
    out << "bytes:" << std::hex << std::setfill('0');
    for (const std::uint8_t byte : bytes) out << ' ' << std::setw(2) << int{byte};
    out << std::dec << std::endl;
    return false;
}

}  // namespace strata::fuzz
