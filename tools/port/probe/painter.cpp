#include "tools/port/probe/painter.h"

#include <algorithm>

// Deprecated since OpenGL 3.0 and not in glcorearb.h; libOpenGL has it.
extern "C" void glAlphaFunc(GLenum func, GLclampf ref);

namespace strata::port {

namespace {

constexpr GLenum alpha_test = 0x0BC0;  // GL_ALPHA_TEST

// Positions are already in clip space, and the colour is passed through: the shaders compute nothing.
constexpr auto vertex_text = R"(
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 corner_color;
out vec4 color;
void main() {
    gl_Position = clip;
    color = corner_color;
}
)";
constexpr auto fragment_text = R"(
in vec4 color;
layout(location = 0) out vec4 drawn;
void main() { drawn = color; }
)";

}  // namespace

bool has_alpha_test(const KitItem& item) {
    return std::ranges::any_of(item.draws, [](const KitDraw& draw) { return draw.alpha_above.has_value(); });
}

Painter::Painter()
    : program_{make_program({.head = "", .vertex = vertex_text, .fragment = fragment_text, .samplers = {}})} {
    glGenVertexArrays(1, &layout_);
    glGenBuffers(1, &buffer_);
    glBindVertexArray(layout_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    for (GLuint i = 0; i < 2; ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, 32, reinterpret_cast<const void*>(std::uintptr_t{i * 16}));
    }
    glDisable(GL_DITHER);
    glDisable(GL_CULL_FACE);
}

Painter::~Painter() {
    glDeleteBuffers(1, &buffer_);
    glDeleteVertexArrays(1, &layout_);
}

void Painter::draw(const KitItem& item) const {
    glViewport(0, 0, item.size.width, item.size.height);
    glDepthRange(double{item.depth_range[0]}, double{item.depth_range[1]});
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_ALWAYS);
    (item.depth ? glEnable : glDisable)(GL_DEPTH_TEST);
    glClearColor(item.clear[0], item.clear[1], item.clear[2], item.clear[3]);
    glClearDepth(1.0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(program_.name());
    glBindVertexArray(layout_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    // With a query, as peels have: without one softpipe steps D16 along its spans
    // (pipeline/reference/mesa-rasterizers.md 3.3).
    glBeginQuery(GL_SAMPLES_PASSED, query_.name());
    for (const KitDraw& one : item.draws) draw(one);
    glEndQuery(GL_SAMPLES_PASSED);
    glDisable(GL_BLEND);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

void Painter::draw(const KitDraw& one) {
    (one.blend ? glEnable : glDisable)(GL_BLEND);
    if (one.blend) {
        glBlendEquation(one.blend->equation);
        glBlendFunc(one.blend->source, one.blend->destination);
    }
    (one.polygon_offset ? glEnable : glDisable)(GL_POLYGON_OFFSET_FILL);
    if (one.polygon_offset) glPolygonOffset((*one.polygon_offset)[0], (*one.polygon_offset)[1]);
    // Once enabled it stays enabled: in that context all items have an alpha test.
    if (one.alpha_above) {
        glEnable(alpha_test);
        glAlphaFunc(GL_GREATER, *one.alpha_above);
    }
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(one.words.size() * 4), one.words.data(), GL_STREAM_DRAW);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(one.words.size() / 8));
}

}  // namespace strata::port
