// peeling/invariance.cpp - the experiment in three steps: both depth paths captured and paired, the peel run
// with its trace kept, its layers and its picture compared with the truth.
#include "peeling/invariance.h"

#include <algorithm>
#include <bit>

#include "peeling/audit/region_trace.h"
#include "peeling/programs/programs.h"
#include "peeling/registry.h"
#include "peeling/render.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

using rasterizer::DepthPath;

// The scene and the device of an experiment. Every capture makes its own renderer, because options differ between
// captures.
struct SceneOnDevice {
    const DrawList& list;
    const View& view;
    const DeviceProfile& profile;

    [[nodiscard]] FrameFragments fragments(const RenderOptions& options, const Algorithm& algorithm) const {
        Renderer renderer(list, view, profile, options);
        return renderer.fragments(algorithm);
    }
};

// The options without the remedies, with one depth path for all passes: the truth, and the difference between the
// paths, must not depend on the remedy under test.
RenderOptions bare(RenderOptions options, DepthPath path) {
    options.depth_path = path;
    options.raster.polygon_offset = {};
    options.compare_epsilon = {};
    options.quantize_reference = true;
    return options;
}

bool draws_twice(const RenderOptions& options) {
    return options.second_list != nullptr || options.second_depth_clamp || options.vertex_paths.second;
}

// The image of the oracle, which the device's formats do not limit.
Image true_picture(const SceneOnDevice& scene, RenderOptions options) {
    DeviceProfile profile = scene.profile;
    // Binary32 colours and every fragment of a pixel, so that neither rounding nor a device limit affects the image.
    profile.has_float_targets = true;
    options.color_format = Format::rgba32f;
    options.audit = options.keep_layers = options.nearest_depth = false;
    Renderer renderer(scene.list, scene.view, profile, options);
    return renderer.render(*find_algorithm("a_buffer")).frame.color;
}

// The fragments of the first pass and of later ones. Their codes are in the algorithm's key.
struct Passes {
    const SceneOnDevice& scene;
    const InvarianceCase& e;

    [[nodiscard]] FrameFragments first(const RenderOptions& options, const Algorithm& algorithm) const {
        return keyed(scene.fragments(options, algorithm), algorithm.key);
    }
    // The fragments that later passes draw, captured in a frame whose first pass draws them.
    [[nodiscard]] FrameFragments further(RenderOptions options, const Algorithm& algorithm) const {
        const DrawList& list = options.second_list != nullptr ? *options.second_list : scene.list;
        if (options.vertex_paths.second) options.vertex_paths.first = options.vertex_paths.second;
        options.raster.depth_clamp = options.second_depth_clamp.value_or(options.raster.depth_clamp);
        options.second_list = nullptr;
        options.second_depth_clamp.reset();
        options.vertex_paths.second.reset();
        options.window_origin = e.moved_window;
        return keyed(SceneOnDevice{list, scene.view, scene.profile}.fragments(options, algorithm), algorithm.key);
    }
};

const Algorithm& unsorted_algorithm() {
    return *find_algorithm("unsorted");
}  // keyed by the stored code; every profile runs it

// `truth` gives each fragment's layer, `drawn` its key in the peel's trace.
void add_layer_fragments(std::vector<LayerFragment>& all, const FrameFragments& truth, const FrameFragments& drawn,
                         Match match) {
    for (const PathPair& pair : pair_up(truth.all, drawn.all, match).pairs)
        if (pair.stored < truth.opaque[pair.pixel])
            all.push_back({pair.pixel, pair.primitive, pair.stored, pair.reference});
}

// The layers; each fragment with the depth that the peel gives it, or with two where later passes draw it at another
// depth.
std::vector<LayerFragment> layer_fragments(const Passes& passes) {
    const InvarianceCase& e = passes.e;
    const FrameFragments truth = passes.first(bare(e.render, e.write), *e.algorithm);
    RenderOptions options = e.render;
    options.depth_path = e.write;
    std::vector<LayerFragment> all;
    add_layer_fragments(all, truth, options.raster.polygon_offset.enabled ? passes.first(options, *e.algorithm) : truth,
                        Match::triangle);
    if (!draws_twice(options)) return all;
    add_layer_fragments(all, truth, passes.further(options, *e.algorithm), e.match);
    std::stable_sort(all.begin(), all.end(),
                     [](const LayerFragment& a, const LayerFragment& b) { return a.pixel < b.pixel; });
    return all;
}

// The default limit is twice the passes of a correct peel (one per layer and one that finds nothing), enough to see a
// layer repeated.
RenderOptions peel_options(const InvarianceCase& e, int layers) {
    RenderOptions options = e.render;
    options.depth_path = e.write;
    options.reference_path = e.compare;
    options.max_passes = e.max_passes > 0 ? e.max_passes : 2 * (layers + 1);
    options.execution = Execution::replay;
    options.fragment_memory = 0;  // every pass is rasterized, so that the measured time covers all passes
    options.audit = options.keep_layers = options.nearest_depth = false;
    return options;
}

// The trace and all fragments are kept in memory, so frames should be of modest size.
void run_peel(Measurement& m, const Passes& passes) {
    const InvarianceCase& e = passes.e;
    const std::vector<LayerFragment> fragments = layer_fragments(passes);
    const int layers = peel_errors(fragments, {}, e.render.width, e.render.height).layers_max;
    const RenderOptions options = peel_options(e, layers);
    Renderer renderer(passes.scene.list, passes.scene.view, passes.scene.profile, options);
    std::vector<RegionTrace> traces;
    RenderResult result = renderer.render_traced(*e.algorithm, traces);
    if (result.refusal) throw Refused{passes.scene.profile, *std::move(result.refusal)};
    m.errors = peel_errors(fragments, traces, options.width, options.height);
    m.passes = result.frame.passes.geometry;
    m.ended = m.passes < options.max_passes;
    m.seconds = result.seconds.passes;
    m.picture = std::move(result.frame.color);
}

// The paths that divide in the fragment program and replace the depth: polygon offset does not affect their compared
// depth.
bool is_quotient(DepthPath path) { return path == DepthPath::perspective_rq || path == DepthPath::depth_replace; }

// The proof in safe_range.h requires two depths of the same fragments and a quantised reference. Otherwise no advice is
// given.
Advice advice_for(const InvarianceCase& e, const DrawList& list, rasterizer::OffsetUnit unit,
                  const std::vector<PathPair>& pairs, const std::vector<std::uint32_t>& opaque) {
    Advice advice;
    if (draws_twice(e.render) || !e.render.quantize_reference || e.algorithm->key != DepthKey::stored_code)
        return advice;
    const DepthFormat format = *e.render.depth;
    advice.epsilon_ulps = safe_epsilon(pairs, opaque);
    advice.epsilon = safe_absolute(pairs, opaque, format);
    const bool is_code = code_kind(format) == rasterizer::CodeKind::fixed &&
                         (unit == rasterizer::OffsetUnit::format || unit == rasterizer::OffsetUnit::buffer);
    // Polygon offset does not move lines and points (GL 4.6, 14.6.5).
    const bool are_polygons = std::ranges::all_of(
        list.meshes, [](const Mesh& mesh) { return rasterizer::is_polygon(rasterizer::shape_of(mesh.primitive)); });
    if (is_code && are_polygons && is_quotient(e.compare) && !is_quotient(e.write))
        advice.bias = safe_bias(pairs, opaque);
    return advice;
}

}  // namespace

FrameFragments keyed(FrameFragments fragments, DepthKey key) {
    if (key == DepthKey::stored_code) return fragments;
    for (CapturedFragment& f : fragments.all) f.code = ordered_code(f.shader_z);
    for (std::uint32_t& opaque : fragments.opaque) opaque = ordered_code(std::bit_cast<float>(opaque));
    return fragments;
}

Measurement measure(const DrawList& list, const View& view, const DeviceProfile& profile, const InvarianceCase& e) {
    const SceneOnDevice scene{list, view, profile};
    const Passes passes{scene, e};
    Measurement m;
    try {
        const FrameFragments written = passes.first(bare(e.render, e.write), unsorted_algorithm());
        DeviceProfile writes_anything = profile;  // the depths of both paths are stored so that they can be captured
        writes_anything.has_fragment_programs = true;
        const SceneOnDevice meter{list, view, writes_anything};
        const FrameFragments compared = Passes{meter, e}.further(bare(e.render, e.compare), unsorted_algorithm());
        const PairedFragments pairs = pair_up(written.all, compared.all, e.match);
        m.paths = compare(pairs);
        // Passes with different viewports share no depth buffer: their codes are compared, and no peel is run.
        m.peeled = e.moved_window == std::array{0, 0};
        if (!m.peeled) return m;
        m.advice = advice_for(e, list, profile.raster.offset_unit, pairs.pairs, written.opaque);
        run_peel(m, passes);
        m.truth = true_picture(scene, bare(e.render, e.write));
        m.image = image_error(m.picture, m.truth);
    } catch (const Refused& refused) {
        // Values measured before the refusal are dropped, so that no incomplete experiment is reported.
        m = {};
        m.refusal = refused.refusal;
    }
    return m;
}

}  // namespace strata::peeling
