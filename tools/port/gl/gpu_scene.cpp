// tools/port/gl/gpu_scene.cpp - puts a scene's vertices into buffers and draws its runs of triangles, lines and points
// with culling by material (gpu_scene.h).
#include "tools/port/gl/gpu_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace strata::port {

namespace {

// Positions are already in clip space: the shader passes them through, so that no matrix product can differ from the
// pack's. SHIFT is only added by ports with a half-pixel mistake.
constexpr auto vertex_text = R"(
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 front;
INTERPOLATION out vec4 front_color;
#ifdef TWO_SIDED
layout(location = 2) in vec4 back;
INTERPOLATION out vec4 back_color;
#endif
void main() {
#ifdef SHIFT
    gl_Position = vec4(clip.xy + SHIFT * clip.w, clip.zw);
#else
    gl_Position = clip;
#endif
    front_color = front;
#ifdef TWO_SIDED
    back_color = back;
#endif
}
)";

// OpenGL selects the side by the winding in the window, as Strata does; a one-sided mesh omits the second colour.
constexpr auto shade_text = R"(
INTERPOLATION in vec4 front_color;
#ifdef TWO_SIDED
INTERPOLATION in vec4 back_color;
vec4 shade() { return IS_FRONT ? front_color : back_color; }
#else
vec4 shade() { return front_color; }
#endif
)";

// A buffer with this content, bound to `target`.
template <class T>
Handle make_buffer(GLenum target, std::span<const T> data) {
    GLuint name = 0;
    glGenBuffers(1, &name);
    glBindBuffer(target, name);
    glBufferData(target, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), GL_STATIC_DRAW);
    return {name, [](GLuint n) { glDeleteBuffers(1, &n); }};
}

// Tightly packed: clip position, front colour and, where sides differ, back colour.
std::vector<float> packed(std::span<const Vertex> vertices, bool two_sided, bool in_bytes) {
    std::vector<float> data;
    data.reserve(vertices.size() * (two_sided ? 12 : 8));
    for (const Vertex& v : vertices) {
        data.insert(data.end(), v.clip.begin(), v.clip.end());
        const std::size_t colors = data.size();
        data.insert(data.end(), v.front.begin(), v.front.end());
        if (two_sided) data.insert(data.end(), v.back.begin(), v.back.end());
        for (std::size_t i = colors; in_bytes && i < data.size(); ++i) data[i] = std::round(data[i] * 255.0f) / 255.0f;
    }
    return data;
}

// A vertex array, bound, for tightly packed attributes of four floats each, 16 bytes, at locations 0, 1, ...
Handle make_layout(const Handle& vertices, const Handle& indices, GLuint attributes) {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    glBindVertexArray(name);
    glBindBuffer(GL_ARRAY_BUFFER, vertices.name());
    for (GLuint i = 0; i < attributes; ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(attributes * 16),
                              reinterpret_cast<const void*>(std::uintptr_t{i * 16}));
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
    return {name, [](GLuint n) { glDeleteVertexArrays(1, &n); }};
}

GLenum mode_of(DrawKind kind) {
    return kind == DrawKind::triangles ? GL_TRIANGLES : kind == DrawKind::lines ? GL_LINES : GL_POINTS;
}

}  // namespace

GpuScene::GpuScene(const IndexedMesh& mesh, FrameSize size, const PortSettings& settings)
    : settings_{settings},
      size_{size},
      line_width_{mesh.line_width},
      point_size_{mesh.point_size},
      two_sided_{std::ranges::any_of(mesh.vertices, [](const Vertex& v) { return v.front != v.back; })},
      vertices_{make_buffer<float>(GL_ARRAY_BUFFER, packed(mesh.vertices, two_sided_, settings.colors_in_bytes))},
      indices_{make_buffer<std::uint32_t>(GL_ARRAY_BUFFER, mesh.indices)},
      layout_{make_layout(vertices_, indices_, two_sided_ ? 3 : 2)} {
    add_runs(mesh);
}

void GpuScene::add_runs(const IndexedMesh& mesh) {
    std::array<std::size_t, 2> ends{};  // where the last run of each ended
    for (const DrawRange& draw : mesh.draws) {
        const auto kind = static_cast<std::size_t>(draw.transparent ? Surfaces::transparent : Surfaces::opaque);
        std::vector<Run>& runs = runs_[kind];
        const int all = static_cast<int>(draw.index_count);
        const auto count = static_cast<GLsizei>(std::max(0, all - settings_.indices_left_out));
        const bool joins = !runs.empty() && ends[kind] == draw.first_index && settings_.indices_left_out == 0 &&
                           runs.back().kind == draw.kind && runs.back().double_sided == draw.double_sided &&
                           runs.back().mirrored == draw.mirrored;
        if (joins)
            runs.back().count += count;
        else
            runs.push_back(
                {draw.kind, count, draw.first_index * sizeof(std::uint32_t), draw.double_sided, draw.mirrored});
        ends[kind] = std::size_t{draw.first_index} + draw.index_count;
    }
}

void GpuScene::draw(Surfaces surfaces) const {
    const SampledSettings& sampled = settings_.sampled;
    const bool is_transparent = surfaces == Surfaces::transparent;
    glLineWidth(line_width_);
    glPointSize(point_size_);
    if (is_transparent && sampled.alpha_to_coverage) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    if (is_transparent && ~sampled.mask != 0) {
        glEnable(GL_SAMPLE_MASK);
        glSampleMaski(0, sampled.mask);
    }
    for (const Run& run : runs_[static_cast<std::size_t>(surfaces)]) {
        const bool culls = settings_.culling != Culling::as_listed || !run.double_sided;
        (culls ? glEnable : glDisable)(GL_CULL_FACE);
        glCullFace(settings_.culling == Culling::always_front ? GL_FRONT : GL_BACK);
        glFrontFace(run.mirrored ? GL_CW : GL_CCW);
        glDrawElements(mode_of(run.kind), run.count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(run.first_byte));
    }
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    glDisable(GL_SAMPLE_MASK);
}

Handle GpuScene::make_program(const std::string& fragment, const std::vector<std::string>& samplers) const {
    std::string head = two_sided_ ? "#define TWO_SIDED\n" : "";
    head += fmt::format("#define INTERPOLATION {}\n#define IS_FRONT ({})\n#define TEXEL ({})\n",
                        settings_.interpolation, settings_.is_front, settings_.texel);
    if (settings_.shift_px != 0)
        head += fmt::format("#define SHIFT vec2({}, -{})\n", 2.0 * settings_.shift_px / size_.width,
                            2.0 * settings_.shift_px / size_.height);
    return port::make_program({.head = head,
                               .vertex = vertex_text,
                               .fragment = shade_text + fragment,
                               .samplers = samplers,
                               .units_set = settings_.units_set});
}

}  // namespace strata::port
