// tools/port/gl/objects.h - owning handles of OpenGL 3.3 objects, and functions that the algorithms share.
#pragma once
#include <GL/glcorearb.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace strata::port {

struct FrameSize {
    int width = 0, height = 0;
    [[nodiscard]] std::size_t area() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

// The storage format of a target, and the format in which its codes are read back.
struct PixelFormat {
    const char* name = "";
    GLenum sized = 0, external = 0, type = 0;
    int channels = 0, bytes = 0;  // bytes: of a channel in client memory
    friend bool operator==(const PixelFormat&, const PixelFormat&) = default;
};
inline constexpr PixelFormat rgba8{"rgba8", GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 1};
inline constexpr PixelFormat rgba16f{"rgba16f", GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 4, 2};
inline constexpr PixelFormat rgba32f{"rgba32f", GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, 4};
inline constexpr PixelFormat rg16f{"rg16f", GL_RG16F, GL_RG, GL_HALF_FLOAT, 2, 2};
inline constexpr PixelFormat rg32f{"rg32f", GL_RG32F, GL_RG, GL_FLOAT, 2, 4};
inline constexpr PixelFormat r8{"r8", GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1, 1};
inline constexpr PixelFormat r16f{"r16f", GL_R16F, GL_RED, GL_HALF_FLOAT, 1, 2};
inline constexpr PixelFormat r32f{"r32f", GL_R32F, GL_RED, GL_FLOAT, 1, 4};
inline constexpr PixelFormat srgb8{"srgb8_alpha8", GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 1};
// Read back as words of 32 bits, which read_back() unpacks: 10-bit codes, and halves.
inline constexpr PixelFormat rgb10_a2{"rgb10_a2", GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, 4, 2};
inline constexpr PixelFormat r11g11b10f{"r11g11b10f", GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, 4, 2};
inline constexpr PixelFormat d16{"d16", GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, 1, 2};
// Read back as the upper bits of a word; read_back() shifts them down.
inline constexpr PixelFormat d24{"d24", GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, 1, 4};
inline constexpr PixelFormat d32f{"d32f", GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 4};
inline constexpr PixelFormat s8{"s8", 0, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1, 1};  // of a depth-stencil texture

// nullptr if no format above has the name.
[[nodiscard]] const PixelFormat* find_format(const std::string& name);

// Codes in memory: rows from row 0, interleaved channels, little endian.
struct PixelCodes {
    PixelFormat format;
    FrameSize size;
    std::vector<std::uint8_t> bytes;
    int samples = 1;  // of each pixel, one after the other
};

// An OpenGL name that is passed to `destroy` at the end. The context must still be current then. A default handle owns
// nothing.
class Handle {
  public:
    Handle() = default;
    Handle(GLuint name, void (*destroy)(GLuint)) : name_{name}, destroy_{destroy} {}
    Handle(Handle&& other) noexcept
        : name_{std::exchange(other.name_, 0)}, destroy_{std::exchange(other.destroy_, nullptr)} {}
    // Swaps: the object that this handle owned is destroyed with `other`.
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

// How often geometry passes run their program: once a sample, which loads its own, or once a pixel, which loads sample
// 0. Full-screen passes always run once a sample.
enum class ShadingRate : std::uint8_t { sample, pixel };

// GLSL expressions for the sample that programs load of earlier passes, with sample shading.
struct SampleExpressions {
    const char *geometry = "gl_SampleID", *full_screen = "gl_SampleID";
};

// From now on every texture and program has `samples` samples per pixel. read_back() returns sample `shown`, or for -1
// the resolve of all. Formats are then rgba8, srgb8, floats and d32f. With 1 nothing changes.
void set_samples(int samples, int shown, ShadingRate shading = ShadingRate::sample,
                 const SampleExpressions& loads = {});
[[nodiscard]] int samples_shown();
[[nodiscard]] int samples_per_pixel();

// A two-dimensional texture without mipmaps, with nearest filtering and undefined contents.
[[nodiscard]] Handle make_texture(const PixelFormat& format, FrameSize size);
// A depth texture with a stencil; d24 or d32f.
[[nodiscard]] Handle make_depth_stencil(const PixelFormat& depth, FrameSize size);
// A query of GL_SAMPLES_PASSED.
[[nodiscard]] Handle make_query();

// A framebuffer whose draw buffer k is color[k]; without colours it has none. Throws std::runtime_error if OpenGL
// reports it as incomplete.
[[nodiscard]] Handle make_framebuffer(std::initializer_list<GLuint> color, GLuint depth = 0);
[[nodiscard]] Handle make_stencil_framebuffer(GLuint depth_stencil);

// Sampler k of `samplers` reads unit k, unless `units_set` is false. Throws std::runtime_error with the compiler's
// message.
struct ProgramText {
    std::string head, vertex, fragment;
    std::vector<std::string> samplers;
    bool units_set = true;
    bool is_full_screen = false;
};
[[nodiscard]] Handle make_program(const ProgramText& text);

// A program that runs once per pixel. Samplers read units 0, 1, ...
[[nodiscard]] Handle make_full_screen_program(const std::string& fragment, const std::vector<std::string>& samplers);

// One triangle over the viewport with `program`, without depth test. The caller sets blending and targets.
void draw_full_screen(const Handle& program);

// Textures on units 0, 1, ...
void bind(std::initializer_list<GLuint> textures);

// The query's result. Waits until every draw inside the query is finished.
[[nodiscard]] std::uint64_t samples_passed(const Handle& query);

// One sample of a multisampled texture, independent of set_samples.
[[nodiscard]] PixelCodes read_sample(GLuint texture, int sample, const PixelFormat& format, FrameSize size);
// All samples of a texture of set_samples.
[[nodiscard]] PixelCodes read_samples(GLuint texture, const PixelFormat& format, FrameSize size);

// Replaces all samples of a colour by their resolve, as if the texture had one sample.
void resolve_in_place(GLuint texture, const PixelFormat& format, FrameSize size);
// Replaces all samples of a depth by sample 0.
void share_first_depth(GLuint texture, FrameSize size);

// A texture's codes; s8: the stencil of a depth-stencil texture.
[[nodiscard]] PixelCodes read_back(GLuint texture, const PixelFormat& format, FrameSize size);

// Throws std::runtime_error with OpenGL's error, if there is one, and the action `doing`.
void check_errors(const std::string& doing);

}  // namespace strata::port
