// Prints a case in a form that can be read and typed in again; numbers have all their digits.
#include <algorithm>
#include <iomanip>
#include <ostream>

#include "pipeline/device/profile_fields.h"
#include "tests/fuzz/frame_case.h"

namespace strata::fuzz {

namespace {

template <class Numbers>
void print_numbers(std::ostream& out, const char* name, const Numbers& numbers) {
    out << name << " {";
    for (std::size_t i = 0; i < std::size(numbers); ++i) out << (i > 0 ? ", " : "") << numbers[i];
    out << '}';
}

void print_lights(std::ostream& out, const std::vector<pipeline::Light>& lights, const pipeline::LightModel& model) {
    out << "\nlights: local viewer " << model.has_local_viewer << ", two sides " << model.is_two_sided << ", separate "
        << model.separates_specular << ", shininess " << model.shininess;
    print_numbers(out, ", specular", components(model.specular));
    for (const pipeline::Light& light : lights) {
        out << "\nlight: type " << static_cast<int>(light.type) << ", range " << light.range << ", cutoff "
            << light.cutoff << ", exponent " << light.exponent;
        print_numbers(out, ", ambient and specular", components(light.ambient));
        print_numbers(out, ", position", components(light.position));
        print_numbers(out, ", direction", components(light.direction));
        print_numbers(out, ", attenuation", components(light.attenuation));
    }
}

void print_options(std::ostream& out, const peeling::RenderOptions& o) {
    const auto number = [](auto value) { return static_cast<int>(value); };
    out << "size " << o.width << 'x' << o.height << ", termination " << number(o.termination.rule) << " ratio "
        << o.termination.ratio << " passes " << o.termination.passes << ", max_passes " << o.max_passes
        << ", average_count " << number(o.average_count);
    const peeling::AlgorithmOptions& a = o.algorithm;
    if (a != peeling::AlgorithmOptions{})
        out << ", weight " << (a.weight_formula ? a.weight_formula->text : std::to_string(number(a.weight)))
            << ", nodes " << a.nodes << ", tail " << (a.tail ? number(*a.tail) : -1) << ", pixel_nodes "
            << a.pixel_nodes << ", frame_nodes " << a.frame_nodes << ", overflow " << number(a.overflow) << ", moments "
            << a.moments << ", overestimation " << a.overestimation << ", samples " << a.stochastic_samples
            << ", list_granularity " << number(a.list_granularity);
    if (o.depth) out << ", depth " << number(*o.depth);
    if (o.depth_path) out << ", depth_path " << number(*o.depth_path);
    if (o.reference_path) out << ", reference_path " << number(*o.reference_path);
    out << ", epsilon " << o.compare_epsilon.absolute << " + " << o.compare_epsilon.ulps << " ulp, quantize_reference "
        << o.quantize_reference;
    if (o.vertex_paths.first) out << ", first vertex_path " << number(*o.vertex_paths.first);
    if (o.vertex_paths.second) out << ", second vertex_path " << number(*o.vertex_paths.second);
    if (o.color_format) out << ", color_format " << number(*o.color_format);
    if (o.result_format) out << ", result_format " << number(*o.result_format);
    if (o.back_format) out << ", back_format " << number(*o.back_format);
    if (o.alpha) out << ", alpha " << *o.alpha;
    out << ", formulation " << number(o.formulation) << ", sort " << number(o.sort.rule) << ' ' << o.sort.buckets << ' '
        << o.sort.fraction << ' ' << o.sort.seed;
    out << ", keep_layers " << o.keep_layers << ", audit " << o.audit << ", nearest_depth " << o.nearest_depth;
    print_numbers(out, ", background", components(o.background));
    const rasterizer::RasterState& r = o.raster;
    out << "\nraster: depth range " << r.depth_near << " to " << r.depth_far << ", clip_depth " << number(r.clip_depth)
        << ", y " << number(r.y_direction) << ", depth_clamp " << r.depth_clamp << ", cull " << number(r.cull)
        << ", front_face " << number(r.front_face) << ", offset " << r.polygon_offset.enabled << ' '
        << r.polygon_offset.factor << ' ' << r.polygon_offset.units;
    if (r.scissor)
        out << ", scissor {" << r.scissor->x0 << ", " << r.scissor->y0 << ", " << r.scissor->x1 << ", " << r.scissor->y1
            << '}';
    if (r.sample) out << ", sample {" << r.sample->x << ", " << r.sample->y << '}';
    out << ", interpolation " << number(r.interpolation) << ", sample " << r.sample_number << " of " << r.sample_count;
    const peeling::Multisampling& sampling = o.sampling;
    out << ", samples " << sampling.samples << ", loads " << number(sampling.loads) << ", composites "
        << number(sampling.composites);
    const rasterizer::SampleCoverage& coverage = r.sample_coverage;
    out << ", coverage by alpha " << coverage.by_alpha << ", share " << coverage.value.value_or(1) << " inverted "
        << coverage.is_inverted << ", mask " << int{coverage.mask};
    for (int i = 0; i < r.clip_plane_count; ++i) {
        const auto& p = r.clip_planes[static_cast<std::size_t>(i)];
        out << ", plane {" << p.a << ", " << p.b << ", " << p.c << ", " << p.d << '}';
    }
    if (o.lights) print_lights(out, *o.lights, o.light_model);
    out << '\n';
}

// Prints only what the mesh's triangles use.
void print_mesh(std::ostream& out, const pipeline::Mesh& mesh) {
    print_numbers(out, " indices", mesh.indices);
    out << '\n';
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (std::ranges::find(mesh.indices, v) == mesh.indices.end()) continue;
        print_numbers(out, ("  vertex " + std::to_string(v) + ": position").c_str(), components(mesh.positions[v]));
        print_numbers(out, " normal", components(mesh.normals[v]));
        print_numbers(out, " texcoord", components(mesh.texcoords[v]));
        if (!mesh.colors.empty()) print_numbers(out, " color", components(mesh.colors[v]));
        out << '\n';
    }
}

void print_material(std::ostream& out, const pipeline::Material& m) {
    print_numbers(out, "  material: front", components(m.front));
    print_numbers(out, " back", components(m.back));
    out << " mode " << static_cast<int>(m.alpha_mode) << " cutoff " << m.alpha_cutoff << " texture " << m.texture
        << " double_sided " << m.double_sided << " unlit " << m.unlit << '\n';
}

void print_texture(std::ostream& out, const pipeline::Texture& t) {
    out << "texture: target " << static_cast<int>(t.target) << ' ' << t.width << 'x' << t.height << " filter "
        << static_cast<int>(t.filter) << " wrap " << static_cast<int>(t.wrap_s) << ' ' << static_cast<int>(t.wrap_t)
        << " decode_srgb " << t.decode_srgb;
    print_numbers(out, " texels", std::vector<int>(t.texels.begin(), t.texels.end()));
    out << '\n';
}

}  // namespace

void print(std::ostream& out, const ExecutionWay& w) {
    constexpr const char* executions[]{"literal", "replay"};
    constexpr const char* sets[]{"scalar", "avx2", "avx512", "best"};
    out << executions[static_cast<int>(w.execution)] << ", " << sets[static_cast<int>(w.simd)] << ", tile "
        << w.tile_size << (w.effects == pipeline::Effects::all ? ", all effects" : "")
        << (w.trust_idle ? "" : ", mistrusting") << (w.check_selections ? ", selections checked" : "")
        << ", fragment memory " << w.fragment_memory;
}

void print(std::ostream& out, const FrameCase& f) {
    out << std::setprecision(9) << f.algorithm << " on " << f.profile.name << ", ";
    const pipeline::DeviceProfile& built_in = *pipeline::find_profile(f.profile.name);
    for (const pipeline::ProfileField& field : pipeline::profile_fields())
        if (field.value(f.profile) != field.value(built_in))
            out << field.key << ' ' << text_of(field, f.profile) << ", ";
    print_options(out, f.options);
    for (const ExecutionWay& way : f.ways) {
        out << "way: ";
        print(out, way);
        out << '\n';
    }
    print_numbers(out, "view", entries_of(f.view.view));
    print_numbers(out, " projection", entries_of(f.view.projection));
    out << '\n';
    bool is_textured = false;
    for (const pipeline::Instance& i : f.list.instances) {
        const pipeline::Material& material = f.list.materials[i.material];
        is_textured |= material.texture >= 0;
        print_numbers(out, "instance: model", entries_of(i.model));
        out << '\n';
        print_material(out, material);
        print_mesh(out, f.list.meshes[i.mesh]);
    }
    for (const pipeline::Texture& t : f.list.textures)
        if (is_textured) print_texture(out, t);
}

}  // namespace strata::fuzz
