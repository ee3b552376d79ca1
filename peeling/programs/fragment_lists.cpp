#include "peeling/programs/fragment_lists.h"

#include "peeling/programs/programs.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

bool is_visible(const Region& region, const CapturedFragment& f) {
    const std::uint32_t opaque = region.storage(region.opaque_depth()).depth(0)[f.pixel];
    if (region.frame().key == DepthKey::shader_z) return f.shader_z < std::bit_cast<float>(opaque);
    return f.code < opaque;
}

}  // namespace

FragmentLists visible_fragments(Region& region, Bookkeeping bookkeeping) {
    const std::vector<CapturedFragment> captured = region.capture(bookkeeping);
    FragmentLists lists;
    lists.start.assign(region.rect().area() + 1, 0);
    std::vector<bool> visible(captured.size());
    for (std::size_t i = 0; i < captured.size(); ++i) {
        visible[i] = is_visible(region, captured[i]);
        if (visible[i]) ++lists.start[captured[i].pixel + 1];
    }
    for (std::size_t p = 1; p < lists.start.size(); ++p) lists.start[p] += lists.start[p - 1];
    lists.fragments.resize(lists.start.back());
    std::vector<std::uint32_t> next(lists.start.begin(), lists.start.end() - 1);
    const bool by_shader_z = region.frame().key == DepthKey::shader_z;
    for (std::size_t i = 0; i < captured.size(); ++i) {
        if (!visible[i]) continue;
        const CapturedFragment& f = captured[i];
        lists.fragments[next[f.pixel]++] = {by_shader_z ? ordered_code(f.shader_z) : f.code, f.exact_code, f.primitive,
                                            f.color};
    }
    return lists;
}

}  // namespace strata::peeling
