// tools/port/gl/objects.cpp - creates, attaches and reads OpenGL textures, framebuffers, programs and queries, also
// multisampled ones (objects.h).
#include "tools/port/gl/objects.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace strata::port {

namespace {

// `as_written` before a variable: its sum is computed as written, not by an interpolation with other rounding, which
// softpipe uses for x (1 - t) + y t. Without the extension drivers may rearrange it.
constexpr auto as_written = R"(#version 330 core
#extension GL_ARB_gpu_shader5 : enable
#extension GL_ARB_gpu_shader_fp64 : enable
#extension GL_ARB_shader_storage_buffer_object : enable
#ifdef GL_ARB_gpu_shader5
#define as_written precise
#else
#define as_written
#endif
)";

struct Sampling {
    int samples = 1, shown = 0;
    ShadingRate shading = ShadingRate::sample;
    SampleExpressions loads{};
};
Sampling& sampling() {
    static Sampling chosen;
    return chosen;
}
GLenum texture_target() { return sampling().samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D; }

// Programs are written for one sample: with several, each fetches and interpolates its own, or, once a pixel, fetches
// sample 0. A program that names its sample runs once for each.
std::string sampled_head(bool is_full_screen) {
    const Sampling& chosen = sampling();
    const bool is_once_a_pixel = chosen.shading == ShadingRate::pixel && !is_full_screen;
    return fmt::format(
        "#extension GL_ARB_sample_shading : require\n"
        "#define sampler2D sampler2DMS\n"
        "#define texelFetch(source, texel, level) texelFetch(source, texel, {})\n",
        is_once_a_pixel  ? "0"
        : is_full_screen ? chosen.loads.full_screen
                         : chosen.loads.geometry);
}

// While it lives, textures and programs have one sample, and what the copy sets is kept for the caller.
class OneSample {
  public:
    OneSample() {
        sampling() = {};
        for (std::size_t i = 0; i < caps.size(); ++i) was_[i] = glIsEnabled(caps[i]) == GL_TRUE;
        for (const GLenum cap : caps) glDisable(cap);
    }
    OneSample(const OneSample&) = delete;
    OneSample& operator=(const OneSample&) = delete;
    ~OneSample() {
        sampling() = before_;
        for (std::size_t i = 0; i < caps.size(); ++i)
            if (was_[i]) glEnable(caps[i]);
    }

  private:
    static constexpr std::array<GLenum, 4> caps{GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SAMPLE_SHADING};
    Sampling before_ = sampling();
    std::array<bool, caps.size()> was_{};
};

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

Handle texture_of(GLenum sized, GLenum external, GLenum type, FrameSize size) {
    GLuint name = 0;
    glGenTextures(1, &name);
    Handle handle{name, [](GLuint n) { glDeleteTextures(1, &n); }};
    glBindTexture(texture_target(), name);
    if (sampling().samples > 1) {
        glTexImage2DMultisample(texture_target(), sampling().samples, sized, size.width, size.height, GL_TRUE);
        return handle;
    }
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(sized), size.width, size.height, 0, external, type, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    return handle;
}

// Creates and binds a framebuffer; the caller attaches targets.
Handle new_framebuffer() {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    return {name, [](GLuint n) { glDeleteFramebuffers(1, &n); }};
}

void attach(GLenum place, GLuint texture, GLenum target = texture_target()) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, place, target, texture, 0);
}

void require_complete() {
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL: expected a complete framebuffer");
}

}  // namespace

const PixelFormat* find_format(const std::string& name) {
    static constexpr std::array all{rgba8, rgba16f, rgba32f, rg32f, r16f,     r32f,      d16,
                                    d24,   d32f,    s8,      srgb8, rgb10_a2, r11g11b10f};
    for (const PixelFormat& format : all)
        if (name == format.name) return &format;
    return nullptr;
}

void set_samples(int samples, int shown, ShadingRate shading, const SampleExpressions& loads) {
    sampling() = {samples, shown, shading, loads};
    if (samples == 1 || shading == ShadingRate::pixel) return;
    glEnable(GL_SAMPLE_SHADING);
    glMinSampleShading(1.0f);
}

int samples_shown() { return sampling().shown; }
int samples_per_pixel() { return sampling().samples; }

Handle make_texture(const PixelFormat& format, FrameSize size) {
    return texture_of(format.sized, format.external, format.type, size);
}

Handle make_depth_stencil(const PixelFormat& depth, FrameSize size) {
    if (depth == d32f)
        return texture_of(GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, size);
    if (depth == d24) return texture_of(GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, size);
    throw std::runtime_error(fmt::format("OpenGL has no depth {} with a stencil; expected d24 or d32f", depth.name));
}

Handle make_query() {
    GLuint name = 0;
    glGenQueries(1, &name);
    return {name, [](GLuint n) { glDeleteQueries(1, &n); }};
}

Handle make_framebuffer(std::initializer_list<GLuint> color, GLuint depth) {
    Handle handle = new_framebuffer();
    std::vector<GLenum> buffers;
    for (const GLuint texture : color) {
        buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
        attach(buffers.back(), texture);
    }
    if (depth != 0) attach(GL_DEPTH_ATTACHMENT, depth);
    if (buffers.empty()) buffers.push_back(GL_NONE);
    glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
    require_complete();
    return handle;
}

Handle make_stencil_framebuffer(GLuint depth_stencil) {
    Handle handle = new_framebuffer();
    attach(GL_DEPTH_STENCIL_ATTACHMENT, depth_stencil);
    glDrawBuffer(GL_NONE);
    require_complete();
    return handle;
}

Handle make_program(const ProgramText& text) {
    const std::string head =
        as_written + (sampling().samples > 1 ? sampled_head(text.is_full_screen) : std::string{}) + text.head;
    const Handle stages[] = {compile(GL_VERTEX_SHADER, head + text.vertex),
                             compile(GL_FRAGMENT_SHADER, head + text.fragment)};
    const GLuint name = glCreateProgram();
    Handle program{name, [](GLuint n) { glDeleteProgram(n); }};
    for (const Handle& stage : stages) glAttachShader(name, stage.name());
    glLinkProgram(name);
    GLint ok = 0;
    glGetProgramiv(name, GL_LINK_STATUS, &ok);
    if (ok == 0) throw std::runtime_error("GLSL: expected a program that links");
    glUseProgram(name);
    for (GLint unit = 0; text.units_set && unit < static_cast<GLint>(text.samplers.size()); ++unit)
        glUniform1i(glGetUniformLocation(name, text.samplers[static_cast<std::size_t>(unit)].c_str()), unit);
    return program;
}

Handle make_full_screen_program(const std::string& fragment, const std::vector<std::string>& samplers) {
    constexpr auto vertex =
        "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }";
    return make_program(
        {.head = "", .vertex = vertex, .fragment = fragment, .samplers = samplers, .is_full_screen = true});
}

void draw_full_screen(const Handle& program) {
    glUseProgram(program.name());
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void bind(std::initializer_list<GLuint> textures) {
    GLenum unit = GL_TEXTURE0;
    for (const GLuint texture : textures) {
        glActiveTexture(unit++);
        glBindTexture(texture_target(), texture);
    }
}

std::uint64_t samples_passed(const Handle& query) {
    GLuint64 samples = 0;
    glGetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &samples);
    return samples;
}

PixelCodes read_sample(GLuint texture, int sample, const PixelFormat& format, FrameSize size) {
    const OneSample copied;
    const Handle program = make_full_screen_program(
        fmt::format("uniform sampler2DMS source; out vec4 drawn;\n"
                    "void main() {{ drawn = texelFetch(source, ivec2(gl_FragCoord.xy), {}); }}",
                    sample),
        {"source"});
    const Handle copy = make_texture(format == d32f ? r32f : format, size);
    const Handle target = make_framebuffer({copy.name()});
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
    draw_full_screen(program);
    PixelCodes image = read_back(copy.name(), format == d32f ? r32f : format, size);
    image.format = format;
    return image;
}

PixelCodes read_samples(GLuint texture, const PixelFormat& format, FrameSize size) {
    const int samples = sampling().samples;
    const auto pixel = static_cast<std::size_t>(format.channels * format.bytes);
    PixelCodes all{format, size, std::vector<std::uint8_t>(size.area() * pixel * static_cast<std::size_t>(samples)),
                   samples};
    for (int sample = 0; sample < samples; ++sample) {
        const PixelCodes part = read_sample(texture, sample, format, size);
        for (std::size_t i = 0; i < size.area(); ++i)
            std::memcpy(&all.bytes[(i * static_cast<std::size_t>(samples) + static_cast<std::size_t>(sample)) * pixel],
                        &part.bytes[i * pixel], pixel);
    }
    return all;
}

namespace {

// A copy with one sample, by the driver's own resolve; of srgb8 in linear light. The caller holds a OneSample.
Handle resolved(GLuint texture, const PixelFormat& format, FrameSize size) {
    const Handle source = new_framebuffer();
    attach(GL_COLOR_ATTACHMENT0, texture, GL_TEXTURE_2D_MULTISAMPLE);
    Handle copy = make_texture(format, size);
    const Handle target = make_framebuffer({copy.name()});
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source.name());
    if (format == srgb8) glEnable(GL_FRAMEBUFFER_SRGB);
    glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    return copy;
}

PixelCodes read_resolved(GLuint texture, const PixelFormat& format, FrameSize size) {
    const OneSample copied;
    return read_back(resolved(texture, format, size).name(), format, size);
}

}  // namespace

void resolve_in_place(GLuint texture, const PixelFormat& format, FrameSize size) {
    const OneSample copied;
    const Handle program = make_full_screen_program(
        "uniform sampler2D source; out vec4 drawn;\n"
        "void main() { drawn = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }",
        {"source"});
    const Handle copy = resolved(texture, format, size);
    const Handle target = new_framebuffer();
    attach(GL_COLOR_ATTACHMENT0, texture, GL_TEXTURE_2D_MULTISAMPLE);
    bind({copy.name()});
    draw_full_screen(program);
}

void share_first_depth(GLuint texture, FrameSize size) {
    const OneSample copied;
    const PixelCodes first = read_sample(texture, 0, d32f, size);
    const Handle program = make_full_screen_program(
        "uniform sampler2D source;\n"
        "void main() { gl_FragDepth = texelFetch(source, ivec2(gl_FragCoord.xy), 0).r; }",
        {"source"});
    const Handle copy = make_texture(r32f, size);
    bind({copy.name()});
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, GL_RED, GL_FLOAT, first.bytes.data());
    const Handle target = new_framebuffer();
    attach(GL_DEPTH_ATTACHMENT, texture, GL_TEXTURE_2D_MULTISAMPLE);
    glDrawBuffer(GL_NONE);
    glUseProgram(program.name());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

namespace {

// Words of 32 bits at the start of `image` become four codes of 16 bits a pixel, from the last pixel on: 10-bit codes,
// of alpha those of equal value; or halves of the packed floats, with alpha 1.
void unpack(PixelCodes& image) {
    const bool is_float = image.format == r11g11b10f;
    for (std::size_t pixel = image.size.area(); pixel-- > 0;) {
        std::uint32_t word = 0;
        std::memcpy(&word, &image.bytes[pixel * 4], 4);
        const auto bits = [word](int first, int count) { return word >> first & ((1u << count) - 1); };
        const std::array<std::uint32_t, 4> wide =
            is_float ? std::array{bits(0, 11) << 4, bits(11, 11) << 4, bits(22, 10) << 5, 0x3c00u}
                     : std::array{bits(0, 10), bits(10, 10), bits(20, 10), bits(30, 2) * 341};
        for (std::size_t c = 0; c < 4; ++c) {
            const auto code = static_cast<std::uint16_t>(wide[c]);
            std::memcpy(&image.bytes[pixel * 8 + c * 2], &code, 2);
        }
    }
}

}  // namespace

PixelCodes read_back(GLuint texture, const PixelFormat& format, FrameSize size) {
    if (sampling().samples > 1)
        return sampling().shown < 0 ? read_resolved(texture, format, size)
                                    : read_sample(texture, sampling().shown, format, size);
    PixelCodes image{format, size, {}};
    image.bytes.resize(size.area() * static_cast<std::size_t>(format.channels * format.bytes));
    const bool is_depth = format.external == GL_DEPTH_COMPONENT, is_stencil = format == s8;
    const Handle framebuffer = new_framebuffer();
    attach(is_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : is_depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, texture);
    glReadBuffer(is_depth || is_stencil ? GL_NONE : GL_COLOR_ATTACHMENT0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.width, size.height, format.external, format.type, image.bytes.data());
    if (format == rgb10_a2 || format == r11g11b10f) unpack(image);
    if (format == d24)
        for (std::size_t i = 0; i < image.bytes.size(); i += 4) {
            std::uint32_t word = 0;
            std::memcpy(&word, &image.bytes[i], 4);
            word >>= 8;
            std::memcpy(&image.bytes[i], &word, 4);
        }
    return image;
}

void check_errors(const std::string& doing) {
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw std::runtime_error(fmt::format("OpenGL: {}: expected no error, found 0x{:04x}", doing, error));
}

}  // namespace strata::port
