#include "tools/oracle/diagnosis/distinguishing_scene.h"

#include <algorithm>

#include "tools/oracle/emulations/mistake_renderer.h"

namespace strata::oracle {

namespace {

bool is_one_picture(const Picture& a, const Picture& b) {
    return std::ranges::equal(a.targets, b.targets, {}, &TargetImage::codes, &TargetImage::codes);
}

bool distinguishes(const SuiteScene& scene, std::span<const Mistake* const> mistakes) {
    const OpenScene opened = open(scene);
    const MistakeRenderer mistake_renderer{opened.input(), *opened.algorithm};
    std::vector<Picture> pictures;
    for (const Mistake* mistake : mistakes) {
        auto picture = mistake_renderer.with(*mistake);
        if (!picture || is_one_picture(*picture, mistake_renderer.right())) return false;
        if (std::ranges::any_of(pictures, [&](const Picture& p) { return is_one_picture(p, *picture); })) return false;
        pictures.push_back(*std::move(picture));
    }
    return true;
}

}  // namespace

const SuiteScene* distinguishing_scene(std::span<const Mistake* const> mistakes) {
    if (mistakes.size() < 2) return nullptr;
    for (const SuiteScene& scene : suite())
        if (distinguishes(scene, mistakes)) return &scene;
    return nullptr;
}

}  // namespace strata::oracle
