#include "tools/port/probe/operations.h"

#include <array>
#include <functional>
#include <map>
#include <stdexcept>

#include "tools/port/probe/kit.h"

namespace strata::port {

namespace {

using nlohmann::json;
using Words = std::vector<std::uint32_t>;

constexpr Format words_format{"rgba32ui", GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 4, 4};
constexpr GLint stencil_reference = 0xa5;

struct Upload {
    GLenum sized, external, type;
};
const std::map<std::string, Upload> uploads{{"r32f", {GL_R32F, GL_RED, GL_FLOAT}},
                                            {"r16f", {GL_R16F, GL_RED, GL_FLOAT}},
                                            {"rgba8", {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}},
                                            {"srgb8", {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE}},
                                            {"d16", {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT}},
                                            {"d24", {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT}},
                                            {"d32f", {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT}}};

// Extends a depth's code to 32 bits by repeating its upper bits below.
void widen(Words& words, const std::string& format) {
    for (std::uint32_t& word : words)
        if (format == "d16")
            word = word << 16 | word;
        else if (format == "d24")
            word = word << 8 | word >> 16;
}

Handle make_image(const json& described) {
    const std::string format = described.at("format").get<std::string>();
    const Upload& upload = uploads.at(format);
    Words words = words_of(described.at("texels").get<std::string>());
    widen(words, format);
    const auto width = static_cast<GLsizei>(words.size());
    Handle image = make_texture({format.c_str(), upload.sized, upload.external, upload.type, 4, 4}, {width, 1});
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, 1, upload.external, upload.type, words.data());
    const GLint filter = described.at("linear").get<bool>() ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    if (described.at("compare").get<bool>()) {
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    return image;
}

// x y z w per corner, as attribute 0 of the bound vertex array.
class Corners {
  public:
    explicit Corners(const Words& words) : count_{static_cast<GLsizei>(words.size() / 4)} {
        glGenVertexArrays(1, &layout_);
        glGenBuffers(1, &buffer_);
        glBindVertexArray(layout_);
        glBindBuffer(GL_ARRAY_BUFFER, buffer_);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(words.size() * 4), words.data(), GL_STREAM_DRAW);
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 16, nullptr);
    }
    Corners(const Corners&) = delete;
    Corners& operator=(const Corners&) = delete;
    ~Corners() {
        glDeleteBuffers(1, &buffer_);
        glDeleteVertexArrays(1, &layout_);
    }
    void draw() const { glDrawArrays(GL_TRIANGLES, 0, count_); }

  private:
    GLsizei count_;
    GLuint layout_ = 0, buffer_ = 0;
};

void show_colors(bool on) {
    const GLboolean value = on ? GL_TRUE : GL_FALSE;
    glColorMask(value, value, value, value);
}

// Column by column: the initial value, one draw with the operation, then one row per bit with EQUAL.
void draw_stencil(const Words& inputs, Size size, const Corners& corners) {
    constexpr std::array<GLenum, 8> steps{GL_KEEP, GL_ZERO,   GL_REPLACE,   GL_INCR,
                                          GL_DECR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP};
    for (const GLenum test : {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_DEPTH_TEST}) glEnable(test);
    for (int x = 0; x < size.width; ++x) {
        const std::uint32_t* const column = &inputs[4 * static_cast<std::size_t>(x)];
        const auto chosen = [&](std::uint32_t when) { return when == column[2] ? steps[column[1]] : GL_KEEP; };
        glScissor(x, 0, 1, size.height);
        glClearStencil(static_cast<GLint>(column[0]));
        glClear(GL_STENCIL_BUFFER_BIT);
        show_colors(false);
        glDepthFunc(column[2] == 1 ? GL_NEVER : GL_ALWAYS);
        glStencilFunc(column[2] == 0 ? GL_NEVER : GL_ALWAYS, stencil_reference, 255);
        glStencilOp(chosen(0), chosen(1), chosen(2));
        corners.draw();
        show_colors(true);
        glDepthFunc(GL_ALWAYS);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        for (int bit = 0; bit < size.height; ++bit) {
            glScissor(x, bit, 1, 1);
            glStencilFunc(GL_EQUAL, 255, 1u << bit);
            corners.draw();
        }
    }
    for (const GLenum test : {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_DEPTH_TEST}) glDisable(test);
}

// Depths with the first program, then the fragments that match them with the second.
void draw_twice(const std::vector<Handle>& programs, const Corners& corners) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    show_colors(false);
    glUseProgram(programs[0].name());
    corners.draw();
    show_colors(true);
    glDepthFunc(GL_EQUAL);
    glUseProgram(programs[1].name());
    corners.draw();
    glDisable(GL_DEPTH_TEST);
}

void clear(Size size, bool is_words) {
    constexpr std::array<GLuint, 4> no_words{};
    constexpr std::array<GLfloat, 4> no_color{};
    glViewport(0, 0, size.width, size.height);
    glDepthRange(0, 1);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
    is_words ? glClearBufferuiv(GL_COLOR, 0, no_words.data()) : glClearBufferfv(GL_COLOR, 0, no_color.data());
    glClearDepth(1.0);
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

// Converts bytes to words.
Image widened(const Image& codes) {
    Image words{words_format, codes.size, std::vector<std::uint8_t>(codes.bytes.size() * 4)};
    for (std::size_t i = 0; i < codes.bytes.size(); ++i) words.bytes[4 * i] = codes.bytes[i];
    return words;
}

}  // namespace

Image draw_operation(const json& described) {
    const Size size{described.at("size").at(0).get<int>(), described.at("size").at(1).get<int>()};
    const Words inputs = words_of(described.at("inputs").get<std::string>());
    const bool is_words = described.at("target") == "words", is_stencil = described.at("stencil").get<bool>();
    std::vector<Handle> programs;
    for (const json& text : described.at("programs"))
        programs.push_back(make_program({.head = "",
                                         .vertex = text.at("vertex").get<std::string>(),
                                         .fragment = text.at("fragment").get<std::string>(),
                                         .samplers = {"inputs", "image"}}));
    const Handle source = make_texture(words_format, size);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, inputs.data());
    const Handle image = described.at("image").is_null() ? Handle{} : make_image(described.at("image"));
    const Format& format = is_words ? words_format : srgb8;
    const Handle color = make_texture(format, size);
    const Handle depth = is_stencil ? make_depth_stencil(d24, size) : make_texture(d32f, size);
    const bool has_depth = is_stencil || programs.size() == 2;
    const Handle target = make_framebuffer({color.name()}, has_depth ? depth.name() : 0);
    if (is_stencil) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth.name(), 0);
    bind({source.name(), image.name()});
    glActiveTexture(GL_TEXTURE0);
    (is_words ? glDisable : glEnable)(GL_FRAMEBUFFER_SRGB);
    clear(size, is_words);
    const Corners corners{words_of(described.at("corners").get<std::string>())};
    glUseProgram(programs.at(0).name());
    if (is_stencil)
        draw_stencil(inputs, size, corners);
    else if (programs.size() == 2)
        draw_twice(programs, corners);
    else
        corners.draw();
    glDisable(GL_FRAMEBUFFER_SRGB);
    const Image drawn = read_back(color.name(), format, size);
    check_errors(described.at("name").get<std::string>());
    return is_words ? drawn : widened(drawn);
}

}  // namespace strata::port
