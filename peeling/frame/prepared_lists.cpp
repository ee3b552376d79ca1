// peeling/frame/prepared_lists.cpp - decides which lists a frame needs, the submission order of their triangles, and
// when they are prepared.
#include "peeling/frame/prepared_lists.h"

#include <algorithm>

#include "peeling/frame/stopwatch.h"
#include "pipeline/device/check.h"
#include "pipeline/vertices/check_list.h"
#include "pipeline/vertices/other_splits.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/coverage/sample_rectangle.h"
#include "rasterizer/set_up/check_input.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// True if a path needs r and q of the vertices.
bool has_quotient(std::optional<rasterizer::DepthPath> path) {
    return path == rasterizer::DepthPath::perspective_rq || path == rasterizer::DepthPath::depth_replace;
}

// Throws InputError for a name of offset_only that neither a mesh nor a material has.
void check_names(const DrawList& list, const RenderOptions& options) {
    for (const std::string& name : options.offset_only)
        if (std::ranges::find(list.meshes, name, &Mesh::name) == list.meshes.end() &&
            std::ranges::find(list.materials, name, &Material::name) == list.materials.end())
            throw InputError("render options", "offset_only", "the name of a mesh or of a material", "'" + name + "'");
}

}  // namespace

bool takes_quotient(const rasterizer::DepthRequest& depth) noexcept {
    return has_quotient(depth.path) || has_quotient(depth.reference);
}

PreparedLists::PreparedLists(Settings settings)
    : s_{std::move(settings)},
      lighting_{s_.options.lights.value_or(s_.list.lights), s_.options.light_model, s_.profile.lighting} {
    // Lists that cannot be prepared are rejected now. Transparent lists are prepared when an algorithm draws them, in
    // its order and with its compared depth.
    check(s_.profile);
    rasterizer::check(s_.raster);
    check(s_.list);
    check(s_.view);
    check_names(s_.list, s_.options);
    if (undrawable()) return;  // refused before a list is drawn
    // With --alpha all surfaces are transparent and there is no opaque list.
    const bool has_opaque =
        !s_.options.alpha && std::any_of(s_.list.materials.begin(), s_.list.materials.end(),
                                         [](const Material& m) { return m.alpha_mode != AlphaMode::blend; });
    if (has_opaque) opaque_ = prepare(s_.list, s_.view, s_.raster, prepare_options(Selection::opaque));
    prepare_second();
}

std::optional<Refusal> PreparedLists::undrawable() const {
    for (const Instance& instance : s_.list.instances) {
        const Primitive primitive = s_.list.meshes[instance.mesh].primitive;
        if (primitive == Primitive::triangles) continue;
        if (auto lacking = check(s_.profile, primitive)) return lacking;
        if (s_.raster.line_stipple && shape_of(primitive) == rasterizer::Shape::line &&
            !has_line_stipple(s_.profile.raster, primitive))
            return Refusal{
                "known rule for stippled lines" + std::string{is_of_polygon(primitive) ? " of polygons" : ""}, "",
                is_of_polygon(primitive) ? "" : "use geforce8 or ideal"};
        if (s_.options.sampling.samples == 1 && !s_.raster.sample) continue;
        if (!covers_samples(s_.profile.raster, primitive))
            return Refusal{"multisampling of lines and points", "",
                           "use geforce8, ideal or direct3d11, or --samples 1"};
        if (s_.raster.line_stipple && shape_of(primitive) == rasterizer::Shape::line)
            return Refusal{"known rule for stippled lines of several samples", "", "use --samples 1"};
        if (s_.raster.interpolation != rasterizer::Interpolation::sample)
            return Refusal{"lines and points whose values are those of a pixel of several samples", "",
                           "use --shading sample"};
    }
    return std::nullopt;
}

const PreparedDraw& PreparedLists::transparent(ListOrder order) {
    TimedList& prepared = transparent_[static_cast<std::size_t>(order)];
    if (!prepared.draw) {
        PrepareOptions ordered = prepare_options(transparent_selection());
        ordered.order = ordering(order);
        ordered.is_checked = true;  // checked at construction
        prepared = prepare(s_.list, s_.view, s_.raster, ordered);
    }
    return *prepared.draw;
}

rasterizer::TriangleSoup PreparedLists::opaque_soup() const {
    return transform(s_.list, s_.view, prepare_options(Selection::opaque));
}

rasterizer::TriangleSoup PreparedLists::transparent_soup() const {
    return transform(s_.list, s_.view, prepare_options(transparent_selection()));
}

std::vector<std::uint32_t> PreparedLists::submission(ListOrder order) const {
    const Ordering in_order = ordering(order);
    return in_order ? in_order(transparent_soup()).triangles : std::vector<std::uint32_t>{};
}

// Binning is separate from preparation: a list may be binned again for another tile size.
void PreparedLists::bin(int tile_size_px) {
    const auto bin_one = [&](TimedList& list) {
        if (!list.draw || list.draw->geometry.tile_size == tile_size_px) return;
        list.binned_seconds = 0;
        const Stopwatch watch{list.binned_seconds};
        bin_triangles(*list.draw, tile_size_px, s_.options.threads);
    };
    std::ranges::for_each(transparent_, bin_one);
    bin_one(opaque_);
    bin_one(second_);
}

// Tile size 0: lists are binned later, when the algorithm, and so the tile size, is known.
PrepareOptions PreparedLists::prepare_options(Selection selection) const {
    PrepareOptions options{.selection = selection,
                           .alpha_scale = s_.options.alpha.value_or(1.0f),
                           .depth_quotient = takes_quotient(s_.depth),
                           .tile_size = 0,
                           .threads = s_.options.threads,
                           .fog = s_.options.fog,
                           .lighting = lighting_.lights.empty() ? nullptr : &lighting_,
                           .offset_only = s_.options.offset_only,
                           .alteration = s_.options.vertex_alteration,
                           .samples = samples()};
    if (s_.light == nullptr) return options;
    options.units = shadow_units(*s_.list.light, s_.view.view, s_.light->state, s_.profile);
    options.receives_shadow = true;
    return options;
}

// A device that lacks so many samples refuses the frame.
int PreparedLists::samples() const {
    const int samples = s_.options.sampling.samples;
    return check_multisampling(s_.profile, samples) ? 1 : samples;
}

// --alpha draws every material as transparent.
Selection PreparedLists::transparent_selection() const {
    return s_.options.alpha ? Selection::all : Selection::transparent;
}

PreparedLists::TimedList PreparedLists::prepare(const DrawList& list, const View& view,
                                                const rasterizer::RasterState& raster,
                                                const PrepareOptions& options) const {
    TimedList prepared;
    {
        const Stopwatch watch{prepared.prepared_seconds};
        prepared.draw = pipeline::prepare(list, view, raster, s_.profile, options);
        // After set-up: the same triangles, translated by whole pixels.
        const auto& [x, y] = s_.options.window_origin;
        for (std::size_t sample = 0; (x != 0 || y != 0) && sample < prepared.draw->samples(); ++sample)
            move_window(prepared.draw->of_sample(sample), x, y);
    }
    return prepared;
}

void PreparedLists::prepare_second() {
    const RenderOptions& o = s_.options;
    // The second list differs from the first in its transform, its clamp or its triangles. If none differs, later
    // passes draw the first list again.
    View other = s_.view;
    other.vertex_path = o.vertex_paths.second.value_or(s_.view.vertex_path);
    rasterizer::RasterState clamped = s_.raster;
    clamped.depth_clamp = o.second_depth_clamp.value_or(s_.raster.depth_clamp);
    const bool differs = other.vertex_path != s_.view.vertex_path || o.second_list != nullptr || clamped != s_.raster;
    if (!differs) return;
    const DrawList& split = o.second_list != nullptr ? *o.second_list : s_.list;
    PrepareOptions ordered = prepare_options(transparent_selection());
    ordered.order = ordering(ListOrder::given);
    second_ = prepare(split, other, clamped, ordered);
}

bool PreparedLists::arrives_sorted(const Instance& instance) const {
    // The user may name meshes or materials whose triangles are known to be in order.
    const auto names = [&](const std::string& name) { return has_name(s_.list, instance, name); };
    return instance.arrives_sorted || std::any_of(s_.options.sorted.begin(), s_.options.sorted.end(), names);
}

// The part of each run of a soup: 0 for the ordered set, 1 for the rest; or one part per object.
PartSort PreparedLists::parts_of(const rasterizer::TriangleSoup& soup, ListOrder order) const {
    PartSort parts;
    const bool in_sets = order == ListOrder::sets;
    parts.sorts.assign(in_sets ? 2 : soup.runs.size(), true);
    if (in_sets) parts.sorts[0] = false;
    for (std::size_t run = 0; run < soup.runs.size(); ++run)
        parts.part_of_run.push_back(in_sets ? (arrives_sorted(s_.list.instances[soup.runs[run].object]) ? 0 : 1)
                                            : static_cast<std::uint32_t>(run));
    return parts;
}

Ordering PreparedLists::ordering(ListOrder order) const {
    const Sort& sort = s_.options.sort;
    // A reversed depth range reverses z a second time.
    const bool is_reversed = s_.raster.depth_order == rasterizer::DepthOrder::greater;
    const NearerZ nearer =
        is_reversed != (s_.raster.depth_near > s_.raster.depth_far) ? NearerZ::greater : NearerZ::less;
    switch (order) {
        // Without ordering the list keeps the scene's order, and the centroids need not be computed.
        case ListOrder::given:
            if (sort.rule == SortRule::none) return {};
            return [&sort, nearer](const auto& soup) {
                return SubmissionOrder{submission_order(soup, sort, nearer), {}};
            };
        case ListOrder::back_to_front:
            return [nearer](const auto& soup) {
                return SubmissionOrder{submission_order(soup, {.rule = SortRule::reverse}, nearer), {}};
            };
        case ListOrder::sets:
        case ListOrder::objects: break;
    }
    return [this, order, &sort, nearer](const auto& soup) {
        return submission_order(soup, sort, parts_of(soup, order), nearer);
    };
}

}  // namespace strata::peeling
