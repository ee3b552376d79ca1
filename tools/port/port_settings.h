// tools/port/port_settings.h - the port's choices in which ports make mistakes. The defaults are correct; each mistake
// changes one field.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "tools/port/gl/objects.h"

namespace strata::port {

enum class Culling : std::uint8_t { as_listed, always_back, always_front };

// Choices of a port with several samples per pixel.
struct SampledSettings {
    ShadingRate shading = ShadingRate::sample;
    SampleExpressions loads{};
    int shown = -1;                    // a sample instead of the resolved picture
    bool layers_resolved = false;      // before they are composited
    bool opaque_resolved = false;      // before anything is composited over it
    bool first_opaque_depth = false;   // all samples are tested against that of sample 0
    bool alpha_to_coverage = false;    // of transparent surfaces
    GLbitfield mask = ~GLbitfield{0};  // likewise
    bool resolves_linear_light = false;
};

struct PortSettings {
    // Vertices and the frame.
    GLenum origin = GL_UPPER_LEFT;  // row 0 of memory is the top
    bool other_clip_depth = false;  // the clip control does not match the matrices
    float shift_px = 0;             // added to every window position, to the right and down
    bool scissored = false;         // the last quarter of every row is not drawn
    Culling culling = Culling::as_listed;
    int indices_left_out = 0;      // at the end of every draw call
    bool colors_in_bytes = false;  // vertex colours are stored as bytes
    const char* interpolation = "smooth";
    const char* is_front = "gl_FrontFacing";
    bool units_set = true;  // every sampler has its texture unit
    const char* texel = "ivec2(gl_FragCoord.xy)";
    // Depth
    GLenum depth_func = GL_LESS;
    const char* behind = "z > peeled";  // comparison of two quantised depths
    float farthest = 1;                 // window depth; 0 under reversed depth, where GREATER is nearer
    PixelFormat min_max = rg32f;
    std::array<float, 4> empty_min_max{-1, -1, 0, 0};
    const PixelFormat* depth = nullptr;  // instead of the requested format
    bool opaque_tested = true;           // transparent surfaces behind opaque ones are discarded
    // Colours and blending
    const char* premultiplied = "vec4(c.rgb * c.a, c.a)";
    float transmittance_start = 1;
    std::array<GLenum, 4> under{GL_DST_ALPHA, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA};
    std::array<GLenum, 2> over{GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA};
    const char* back_layer = "color";
    const char* at_neither_end = "return";  // in dual: the front colour is passed through
    GLenum min_max_equation = GL_MAX;
    std::array<const PixelFormat*, 2>
        sums{};  // of weighted averages: formats of sums and count instead of the correct ones
    bool background_used = true;
    bool encoded_again = false;      // the finished picture is written to an sRGB target
    GLenum channel_order = GL_RGBA;  // in which the finished picture is read back
    // Passes
    int passes_left_out = 0;        // the last layers are not composited
    std::uint64_t query_limit = 0;  // a peel continues while its query is above this
    bool swaps = true;              // the targets of two passes alternate
    GLenum stencil_increment = GL_INCR;
    bool stencil_kept = true;  // coherent_stencil's second pass continues with the first one's stencil
    GLenum shadow_compare = GL_GREATER;
    SampledSettings sampled{};
};

// A mistake, and an algorithm whose result it changes.
struct PortMistake {
    const char *name, *algorithm, *words;
    void (*make)(PortSettings&) = nullptr;
};
[[nodiscard]] const std::vector<PortMistake>& mistakes();
// Those of ports with several samples per pixel.
[[nodiscard]] const std::vector<PortMistake>& sampled_mistakes();

// Comma-separated names, to combine mistakes. Throws std::invalid_argument for an unknown name.
[[nodiscard]] PortSettings settings_with(const std::string& names);

}  // namespace strata::port
