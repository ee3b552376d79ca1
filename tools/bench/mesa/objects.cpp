#include "tools/bench/mesa/objects.h"

#include <stdexcept>

namespace strata::mesa {

namespace {

// A shader of this kind. Throws std::runtime_error with the compiler's log and the text.
Handle compile(GLenum kind, const std::string& text) {
    const GLuint shader = glCreateShader(kind);
    Handle handle{shader, [](GLuint name) { glDeleteShader(name); }};
    const char* const start = text.c_str();
    glShaderSource(shader, 1, &start, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok != 0) return handle;
    std::string log(4096, '\0');
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::runtime_error("GLSL: " + log.substr(0, log.find('\0')) + "in\n" + text);
}

}  // namespace

Handle make_texture(GLenum format, Size size) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, 1, format, size.width, size.height);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return {name, [](GLuint n) { glDeleteTextures(1, &n); }};
}

Handle make_query() {
    GLuint name = 0;
    glCreateQueries(GL_SAMPLES_PASSED, 1, &name);
    return {name, [](GLuint n) { glDeleteQueries(1, &n); }};
}

Handle make_framebuffer(std::initializer_list<GLuint> color, GLuint depth) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    std::vector<GLenum> buffers;
    for (const GLuint texture : color) {
        buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
        glNamedFramebufferTexture(name, buffers.back(), texture, 0);
    }
    if (depth != 0) glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth, 0);
    if (buffers.empty()) buffers.push_back(GL_NONE);
    glNamedFramebufferDrawBuffers(name, static_cast<GLsizei>(buffers.size()), buffers.data());
    if (glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL: expected a complete framebuffer");
    return {name, [](GLuint n) { glDeleteFramebuffers(1, &n); }};
}

Handle make_program(const std::string& defines, const std::string& vertex, const std::string& fragment) {
    const std::string head = "#version 450 core\n" + defines;
    const Handle stages[] = {compile(GL_VERTEX_SHADER, head + vertex), compile(GL_FRAGMENT_SHADER, head + fragment)};
    const GLuint name = glCreateProgram();
    Handle program{name, [](GLuint n) { glDeleteProgram(n); }};
    for (const Handle& stage : stages) glAttachShader(name, stage.name());
    glLinkProgram(name);
    GLint ok = 0;
    glGetProgramiv(name, GL_LINK_STATUS, &ok);
    if (ok == 0) throw std::runtime_error("GLSL: expected a program that links");
    return program;
}

void draw_full_screen(const Handle& program) {
    glUseProgram(program.name());
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

Handle make_full_screen_program(const std::string& fragment) {
    constexpr auto vertex =
        "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }";
    return make_program("", vertex, fragment);
}

std::uint64_t samples_passed(const Handle& query) {
    GLuint64 samples = 0;
    glGetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &samples);
    return samples;
}

GLenum gl_format(pipeline::Format format) {
    using enum pipeline::Format;
    switch (format) {
        case rgba8: return GL_RGBA8;
        case rgba16f: return GL_RGBA16F;
        case rgba32f: return GL_RGBA32F;
        case d16: return GL_DEPTH_COMPONENT16;
        case d24: return GL_DEPTH_COMPONENT24;
        case d32f: return GL_DEPTH_COMPONENT32F;
        default: throw std::invalid_argument("a format that no job stores");
    }
}

void read_color(const Handle& framebuffer, Size size, pipeline::Format format, std::vector<std::uint32_t>& pixels) {
    const bool is_half = format == pipeline::Format::rgba16f, is_single = format == pipeline::Format::rgba32f;
    pixels.resize(size.area() * (is_single ? 4 : is_half ? 2 : 1));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.name());
    const GLenum type = is_single ? GL_FLOAT : is_half ? GL_HALF_FLOAT : GL_UNSIGNED_BYTE;
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, type, pixels.data());
}

}  // namespace strata::mesa
