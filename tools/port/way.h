// tools/port/way.h - what the port decides where ports go wrong. The defaults are the right port; a mistake changes a
// field.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "tools/port/objects.h"

namespace strata::port {

enum class Culling : std::uint8_t { as_listed, always_back, always_front };

struct Way {
    // Vertices and the frame.
    GLenum origin = GL_UPPER_LEFT;  // row 0 of memory is the top
    bool other_clip_depth = false;  // the clip control is not that of the matrices
    float shift_px = 0;             // of every window position, to the right and down
    bool scissored = false;         // the last quarter of every row is not drawn
    Culling culling = Culling::as_listed;
    int indices_left_out = 0;      // of every draw call
    bool colors_in_bytes = false;  // vertex colours as bytes
    const char* interpolation = "smooth";
    const char* is_front = "gl_FrontFacing";
    bool units_set = true;  // every sampler has its texture unit
    const char* texel = "ivec2(gl_FragCoord.xy)";
    // Depth
    GLenum depth_func = GL_LESS;
    const char* behind = "z > peeled";  // of two quantised depths
    Format min_max = rg32f;
    std::array<float, 4> empty_min_max{-1, -1, 0, 0};
    const Format* depth = nullptr;  // instead of the asked one
    bool opaque_tested = true;      // transparent surfaces behind opaque ones are dropped
    // Colours and blending
    const char* premultiplied = "vec4(c.rgb * c.a, c.a)";
    float transmittance_start = 1;
    std::array<GLenum, 4> under{GL_DST_ALPHA, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA};
    std::array<GLenum, 2> over{GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA};
    const char* back_layer = "color";
    const char* at_neither_end = "return";  // of dual: the front colour passes through
    GLenum min_max_equation = GL_MAX;
    std::array<const Format*, 2> sums{};  // of weighted averages, instead of the right ones: sums and count
    bool background_used = true;
    bool encoded_again = false;      // the finished picture goes through an sRGB target
    GLenum channel_order = GL_RGBA;  // of the finished picture as it is read back
    // Passes
    int passes_left_out = 0;        // the last layers are not composited
    std::uint64_t query_limit = 0;  // a peel goes on while its query is above
    bool swaps = true;              // targets of two passes take turns
    GLenum stencil_increment = GL_INCR;
    bool stencil_kept = true;  // coherent_stencil's second pass counts on with the first one's stencil
    GLenum shadow_compare = GL_GREATER;
};

// A way to go wrong. `algorithm` shows it.
struct Mistake {
    const char *name, *algorithm, *words;
    void (*make)(Way&) = nullptr;
};
[[nodiscard]] const std::vector<Mistake>& mistakes();

// Names with commas between: two mistakes at once. Throws std::invalid_argument for a name that is none.
[[nodiscard]] Way way_with(const std::string& names);

}  // namespace strata::port
