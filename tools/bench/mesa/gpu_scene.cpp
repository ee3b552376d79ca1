#include "tools/bench/mesa/gpu_scene.h"

#include <algorithm>
#include <array>
#include <span>

namespace strata::mesa {

using rasterizer::ClipVertex;

namespace {

// Positions are in clip space already: the shader passes them on, so that no matrix product can
// differ from Strata's.
constexpr auto vertex_text = R"(
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 front;
layout(location = 0) out vec4 front_color;
#ifdef TWO_SIDED
layout(location = 2) in vec4 back;
layout(location = 1) out vec4 back_color;
#endif
void main() {
    gl_Position = clip;
    front_color = front;
#ifdef TWO_SIDED
    back_color = back;
#endif
}
)";

// OpenGL picks the side by the winding in the window, as Strata does; a one-sided soup saves the
// second colour.
constexpr auto shade_text = R"(
layout(location = 0) in vec4 front_color;
#ifdef TWO_SIDED
layout(location = 1) in vec4 back_color;
vec4 shade() { return gl_FrontFacing ? front_color : back_color; }
#else
vec4 shade() { return front_color; }
#endif
)";

// An immutable buffer with this content.
template <class T>
Handle make_buffer(std::span<const T> data) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), 0);
    return {name, [](GLuint n) { glDeleteBuffers(1, &n); }};
}

// Tightly packed: clip position, front colour and, where sides differ, back colour.
std::vector<float> packed(std::span<const ClipVertex> vertices, bool two_sided) {
    std::vector<float> data;
    data.reserve(vertices.size() * (two_sided ? 12 : 8));
    for (const ClipVertex& v : vertices) {
        data.insert(data.end(), {v.x, v.y, v.z, v.w});
        data.insert(data.end(), v.front.begin(), v.front.end());
        if (two_sided) data.insert(data.end(), v.back.begin(), v.back.end());
    }
    return data;
}

// A vertex array for tightly packed attributes of four floats each, 16 bytes, at locations 0, 1,
// ...
Handle make_layout(const Handle& vertices, const Handle& indices, GLuint attributes) {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    for (GLuint i = 0; i < attributes; ++i) {
        glEnableVertexArrayAttrib(name, i);
        glVertexArrayAttribFormat(name, i, 4, GL_FLOAT, GL_FALSE, i * 16);
        glVertexArrayAttribBinding(name, i, 0);
    }
    glVertexArrayVertexBuffer(name, 0, vertices.name(), 0, static_cast<GLsizei>(attributes * 16));
    glVertexArrayElementBuffer(name, indices.name());
    return {name, [](GLuint n) { glDeleteVertexArrays(1, &n); }};
}

}  // namespace

GpuScene::GpuScene(const rasterizer::TriangleSoup& soup)
    : two_sided_{std::ranges::any_of(soup.vertices, [](const ClipVertex& v) { return v.front != v.back; })},
      vertices_{make_buffer<float>(packed(soup.vertices, two_sided_))},
      indices_{make_buffer<std::uint32_t>(soup.indices)},
      layout_{make_layout(vertices_, indices_, two_sided_ ? 3 : 2)} {
    add_runs(soup);
    glBindVertexArray(layout_.name());
}

void GpuScene::add_runs(const rasterizer::TriangleSoup& soup) {
    for (const rasterizer::TriangleRun& run : soup.runs) {
        const auto count = static_cast<GLsizei>(run.index_count);
        // Neighbouring runs are listed without a gap, so equal state is enough to draw them by one
        // call.
        const bool joins =
            !runs_.empty() && runs_.back().double_sided == run.double_sided && runs_.back().mirrored == run.mirrored;
        if (joins)
            runs_.back().count += count;
        else
            runs_.push_back({count, run.first_index * sizeof(std::uint32_t), run.double_sided, run.mirrored});
    }
}

void GpuScene::draw() const {
    for (const Run& run : runs_) {
        // A mirroring transform turns the winding around; Strata's own set-up takes it from the
        // same flag.
        (run.double_sided ? glDisable : glEnable)(GL_CULL_FACE);
        glFrontFace(run.mirrored ? GL_CW : GL_CCW);
        glDrawElements(GL_TRIANGLES, run.count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(run.first_byte));
    }
}

Handle GpuScene::make_program(const std::string& fragment) const {
    return mesa::make_program(two_sided_ ? "#define TWO_SIDED\n" : "", vertex_text, shade_text + fragment);
}

}  // namespace strata::mesa
