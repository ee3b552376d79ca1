// tools/bench/mesa/objects.h - OpenGL objects that end with their owner, and the few calls the algorithms share.
#pragma once
#include <GL/glcorearb.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/formats/format.h"

namespace strata::mesa {

struct Size {
    int width = 0, height = 0;
    [[nodiscard]] std::size_t area() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

// An OpenGL name that `destroy` gives back. The context must still be current when the handle ends.
// A default one owns nothing.
class Handle {
  public:
    Handle() = default;
    Handle(GLuint name, void (*destroy)(GLuint)) : name_{name}, destroy_{destroy} {}
    Handle(Handle&& other) noexcept
        : name_{std::exchange(other.name_, 0)}, destroy_{std::exchange(other.destroy_, nullptr)} {}
    // A swap: what this handle owned ends with `other`.
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);
        std::swap(destroy_, other.destroy_);
        return *this;
    }
    ~Handle() {
        if (destroy_ != nullptr) destroy_(name_);
    }
    [[nodiscard]] GLuint name() const noexcept { return name_; }

  private:
    GLuint name_ = 0;
    void (*destroy_)(GLuint) = nullptr;
};

// A two-dimensional texture without mipmaps, nearest lookups, contents undefined. `format` is a
// sized one such as GL_RGBA8.
[[nodiscard]] Handle make_texture(GLenum format, Size size);
// A query of GL_SAMPLES_PASSED.
[[nodiscard]] Handle make_query();

// A framebuffer whose draw buffer k is color[k]; without colours it has none. `depth` may be 0.
// Throws std::runtime_error if OpenGL calls it incomplete.
[[nodiscard]] Handle make_framebuffer(std::initializer_list<GLuint> color, GLuint depth = 0);

// `defines` stands before the vertex and the fragment text; std::runtime_error with the compiler's words.
[[nodiscard]] Handle make_program(const std::string& defines, const std::string& vertex, const std::string& fragment);

// One triangle over the viewport with `program`; depth test off. Blending and targets are the caller's.
void draw_full_screen(const Handle& program);

// A program that runs once a pixel.
[[nodiscard]] Handle make_full_screen_program(const std::string& fragment);

// The query's answer. The call waits until every draw inside the query is finished.
[[nodiscard]] std::uint64_t samples_passed(const Handle& query);

// The sized format that stores `format` with the same bits: rgba8, rgba16f, rgba32f, d16, d24 or d32f.
[[nodiscard]] GLenum gl_format(pipeline::Format format);

// Colour attachment 0, rows as they lie in memory, r in the lowest bits; one, two or four words a pixel.
void read_color(const Handle& framebuffer, Size size, pipeline::Format format, std::vector<std::uint32_t>& pixels);

}  // namespace strata::mesa
