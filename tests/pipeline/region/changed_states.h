// tests/pipeline/region/changed_states.h - changes of a pass's state, one setting at a time, for passes whose fast path
// requires that the setting has its default.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "pipeline/frame/pass.h"
#include "pipeline/region/region.h"

namespace strata::testing {

inline constexpr pipeline::DepthTest nearest_stays{.enabled = true, .func = pipeline::CompareFunc::less, .write = true};
inline constexpr pipeline::StencilFace counts_updates{
    .func = pipeline::CompareFunc::always, .ref = 0, .pass = pipeline::StencilOp::incr};

using Changed = std::function<void(pipeline::PassState&, pipeline::Region&)>;

struct Change {
    const char* name;
    Changed make;
};

// Adds a stencil target if the pass has none.
inline void give_stencil(pipeline::PassState& state, pipeline::Region& region) {
    if (!state.stencil_target.exists()) state.stencil_target = region.make(pipeline::Format::s8);
}

// The list of changes; the first changes nothing.
inline const std::vector<Change>& changes() {
    using namespace pipeline;
    using enum CompareFunc;
    const auto face = [](const char* name, void (*change)(StencilFace&)) {
        return Change{name, [change](PassState& s, Region&) { change(s.stencil.front); }};
    };
    static const std::vector<Change> all{
        {"nothing", [](PassState&, Region&) {}},
        {"depth LEQUAL", [](PassState& s, Region&) { s.depth.func = lequal; }},
        {"depth GREATER", [](PassState& s, Region&) { s.depth.func = greater; }},
        {"depth ALWAYS", [](PassState& s, Region&) { s.depth.func = always; }},
        {"no depth write", [](PassState& s, Region&) { s.depth.write = false; }},
        {"no depth test", [](PassState& s, Region&) { s.depth.enabled = false; }},
        {"a depth test",
         [](PassState& s, Region& r) {
             if (s.depth.enabled) return;
             s.depth = nearest_stays;
             s.depth_target = r.make_depth();
             r.clear(s.depth_target, {.depth = 1.0f});
         }},
        {"no stencil test", [](PassState& s, Region&) { s.stencil.enabled = false; }},
        {"a stencil test",
         [](PassState& s, Region& r) {
             give_stencil(s, r);
             s.stencil.enabled = true;
         }},
        {"a stencil test that counts",
         [](PassState& s, Region& r) {
             give_stencil(s, r);
             s.stencil = {.enabled = true, .front = counts_updates, .back = {}};
         }},
        face("stencil function", [](StencilFace& f) { f.func = gequal; }),
        face("stencil reference", [](StencilFace& f) { f.ref = 0; }),
        face("stencil reference of 3", [](StencilFace& f) { f.ref = 3; }),
        face("stencil function's mask", [](StencilFace& f) { f.func_mask = 0x7f; }),
        face("stencil write mask", [](StencilFace& f) { f.write_mask = 0x0f; }),
        face("stencil fail", [](StencilFace& f) { f.fail = StencilOp::zero; }),
        face("stencil depth fail", [](StencilFace& f) { f.depth_fail = StencilOp::replace; }),
        face("stencil pass", [](StencilFace& f) { f.pass = StencilOp::incr_wrap; }),
        {"two-sided stencil", [](PassState& s, Region&) { s.stencil.two_sided = true; }},
        {"blending",
         [](PassState& s, Region&) {
             if (!s.blend[0].enabled) s.blend[0] = blend_mode::sum;
         }},
        {"a colour write mask", [](PassState& s, Region&) { s.blend[0].write_mask = 0; }},
        {"no colour", [](PassState& s, Region&) { s.color[0] = s.ordered_rmw ? s.color[0] : Target{}; }},
        {"samples but the first", [](PassState& s, Region&) { s.sample_mask = 0xfe; }},
        {"samples but the last", [](PassState& s, Region&) { s.sample_mask = 0x7f; }},
        {"an alpha test", [](PassState& s, Region&) { s.alpha = {.enabled = true, .func = greater, .ref = 0.5f}; }},
        {"a depth unit",
         [](PassState& s, Region& r) {
             s.depth_units[0] = {r.opaque_depth(), gequal};
             s.depth_unit_count = 1;
         }},
        {"depths of the program's own", [](PassState& s, Region&) { s.replaces_depth = true; }},
        {"reads in order", [](PassState& s, Region&) { s.ordered_rmw = true; }},
        {"facing", [](PassState& s, Region&) { s.needs.facing = true; }},
        {"a third colour",
         [](PassState& s, Region& r) {
             s.color[2] = r.make(Format::rgba32f);
             s.blend[2] = blend_mode::max;
         }},
        {"another format",
         [](PassState& s, Region& r) {
             s.color[1] = r.make(Format::rgba32f);
             r.clear(s.color[1], {.color = {0.5f, 0.5f, 0.5f, 0.5f}});
         }},
        {"a depth by another path", [](PassState& s, Region&) { s.needs.reference = true; }},
        {"a texture", [](PassState& s, Region& r) { s.textures[0] = r.make_depth(); }},
        {"a load", [](PassState& s, Region& r) { s.reads[7] = r.make(Format::rgba8); }},
        {"a depth target of its own",
         [](PassState& s, Region& r) {
             s.depth_target = r.make_depth();
             r.clear(s.depth_target, {.depth = 0.5f});
         }},
        {"targets of two samples",
         [](PassState& s, Region& r) {
             if (s.depth.enabled) s.depth_target = r.make(target_format(r.frame().key_request().format), 2);
             if (s.depth.enabled) r.clear(s.depth_target, {.depth = 0.75f});
             for (Target& t : s.color)
                 if (t.exists()) t = r.make(r.storage(t).format(), 2);
             if (s.stencil.enabled) s.stencil_target = r.make(Format::s8, 2);
         }},
        {"colours of two samples",
         [](PassState& s, Region& r) {
             for (Target& t : s.color)
                 if (t.exists()) t = r.make(r.storage(t).format(), 2);
         }},
        {"texture coordinates", [](PassState& s, Region&) { s.needs.texcoord = true; }},
        {"some of the primitives",
         [](PassState& s, Region&) {
             static const std::array<PrimitiveRange, 2> ranges{{{3, 300}, {400, 500}}};
             s.primitives = ranges;
         }},
    };
    return all;
}

}  // namespace strata::testing
