// tools/port/algorithms/linked_list.cpp - stores every fragment in a list of its pixel and sorts the lists at the end
// (Yang et al. 2010; peeling/reference/algorithms.md 20). Passes: 1. Nodes and heads are in shader storage (OpenGL
// 4.3).
#include <fmt/format.h>

#include <memory>
#include <numeric>
#include <stdexcept>

#include "tools/port/algorithms/frame.h"

namespace strata::port {

namespace {

// A link is the number of a node plus 1, or 0. With several samples each has its own list.
constexpr auto storage_text = R"(
struct Node {{
    vec4 color;
    float depth;
    uint next;
}};
layout(std430, binding = 0) buffer Heads {{ uint taken; uint heads[]; }};
layout(std430, binding = 1) buffer Nodes {{ Node nodes[]; }};
uint index(ivec2 pixel) {{ return uint(pixel.y * {} + pixel.x) * {}u + uint({}); }}
)";

constexpr auto append_text = R"(
void main() {
    float z = stored(gl_FragCoord.z);
    if (hidden(z)) discard;
    uint node = atomicAdd(taken, 1u);
    nodes[node].color = shade();
    nodes[node].depth = z;
    nodes[node].next = atomicExchange(heads[index(TEXEL)], node + 1u);
}
)";

// Sorts from the farthest to the nearest without an array: each iteration searches for the farthest node before the
// last one. Of equal depths the later node is behind, because a pixel's fragments get their nodes in submission order.
constexpr auto sort_text = R"(
uniform sampler2D behind_target;
layout(location = 0) out vec4 result;
void main() {{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 color = {};
    float last_depth = 2.0;
    uint last = 0u;
    for (bool is_left = true; is_left;) {{
        float depth = -1.0;
        uint farthest = 0u;
        for (uint node = heads[index(pixel)]; node != 0u; node = nodes[node - 1u].next) {{
            float d = nodes[node - 1u].depth;
            bool is_before = d < last_depth || (d == last_depth && node < last);
            bool is_farther = d > depth || (d == depth && node > farthest);
            if (is_before && is_farther) {{
                depth = d;
                farthest = node;
            }}
        }}
        is_left = farthest != 0u;
        if (is_left) {{
            vec4 c = nodes[farthest - 1u].color;
            as_written vec3 mixed = c.a * c.rgb + (1.0 - c.a) * color;
            color = mixed;
            last_depth = depth;
            last = farthest;
        }}
    }}
    result = vec4(color, 1.0);
}}
)";

constexpr std::size_t node_bytes = 32;

Handle make_storage() {
    GLuint name = 0;
    glGenBuffers(1, &name);
    return {name, [](GLuint n) { glDeleteBuffers(1, &n); }};
}

// The number of fragments.
std::size_t nodes_for(const JobInput& in) {
    const std::vector<std::uint32_t> counts = count_fragments(in.scene, in.size);
    auto all = std::accumulate(counts.begin(), counts.end(), std::size_t{1});
    if (samples_per_pixel() > 1) {
        if (samples_shown() >= 0)
            throw std::runtime_error("linked_list: expected the resolved picture, found --sample");
        // Counts are means of a pixel's samples, without their fraction.
        all = (all + counts.size()) * static_cast<std::size_t>(samples_per_pixel());
    }
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (all * node_bytes > static_cast<std::size_t>(most))
        throw std::runtime_error(fmt::format(
            "linked_list: expected at most {} bytes of nodes, found {} fragments of {}", most, all, node_bytes));
    return all;
}

struct ListTargets {
    JobInput input;
    Opaque opaque;
    std::size_t nodes_needed;
    Handle heads, nodes, result, framebuffer, append, sort;

    explicit ListTargets(const JobInput& in)
        : input{in},
          opaque{in, in.formats.depth},
          nodes_needed{nodes_for(in)},
          heads{make_storage()},
          nodes{make_storage()},
          result{make_texture(picture_format(in), in.size)},
          framebuffer{make_framebuffer({result.name()})},
          append{in.scene.make_program(stored_text(in.formats.depth) + opaque.hidden_text() + storage(in) + append_text,
                                       {"opaque_depth"})},
          sort{make_full_screen_program(
              storage(in) + fmt::format(sort_text, in.settings.background_used
                                                       ? "texelFetch(behind_target, pixel, 0).rgb"
                                                       : "vec3(0.0)"),
              {"behind_target"})} {}

  private:
    static std::string storage(const JobInput& in) {
        const bool is_of_samples = samples_per_pixel() > 1 && in.settings.sampled.shading == ShadingRate::sample;
        return fmt::format(storage_text, in.size.width, samples_per_pixel(), is_of_samples ? "gl_SampleID" : "0");
    }
};

void make_empty(const ListTargets& t) {
    const std::vector<GLuint> zeros(t.input.size.area() * static_cast<std::size_t>(samples_per_pixel()) + 1);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, t.heads.name());
    glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(zeros.size() * sizeof zeros[0]), zeros.data(),
                 GL_DYNAMIC_COPY);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, t.nodes.name());
    glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(t.nodes_needed * node_bytes), nullptr,
                 GL_DYNAMIC_COPY);
}

void draw_lists(const ListTargets& t, PixelCodes& picture, Record* record) {
    t.opaque.draw(t.input.scene);
    make_empty(t);
    glBindFramebuffer(GL_FRAMEBUFFER, t.framebuffer.name());
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    bind({t.opaque.depth()});
    glUseProgram(t.append.name());
    t.input.scene.draw();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    show_pass(record, t.input.size, "geometry", {});
    bind({t.opaque.color()});
    draw_full_screen(t.sort);
    show_pass(record, t.input.size, "full_screen", {{"result", t.result.name(), t.input.formats.color}});
    picture = read_picture(t.result.name(), t.input);
}

}  // namespace

Job linked_list_job(const JobInput& input) {
    const auto t = std::make_shared<ListTargets>(input);
    return {"linked_list", [t](PixelCodes& picture, int, Record* record) {
                draw_lists(*t, picture, record);
                return 1;
            }};
}

}  // namespace strata::port
