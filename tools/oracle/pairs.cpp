#include "tools/oracle/pairs.h"

#include <fmt/format.h>

#include "rasterizer/base/input_error.h"

namespace strata::oracle {

namespace {

std::string place(const Target& target) {
    return target.part.empty() ? target.name : fmt::format("{} of {}", target.name, target.part);
}

std::vector<const Target*> of_meaning(const Picture& picture, Meaning meaning) {
    std::vector<const Target*> found;
    for (const Target& target : picture.targets)
        if (target.meaning == meaning) found.push_back(&target);
    return found;
}

const Target* partner(const Target& wanted, const Picture& reference, const Picture& candidate) {
    for (const Target& target : candidate.targets)
        if (target.part == wanted.part && target.name == wanted.name) return &target;
    // A file of one picture has no name for it, or another than ours.
    const auto here = of_meaning(reference, wanted.meaning), there = of_meaning(candidate, wanted.meaning);
    return here.size() == 1 && there.size() == 1 ? there[0] : nullptr;
}

}  // namespace

Pairing pair_targets(const Picture& reference, const Picture& candidate) {
    Pairing found;
    std::vector<const Target*> taken;
    for (const Target& target : reference.targets) {
        const Target* const other = partner(target, reference, candidate);
        if (other == nullptr) {
            found.not_compared.push_back(fmt::format("{}: in the reference alone", place(target)));
            continue;
        }
        if (other->width != target.width || other->height != target.height)
            throw InputError(candidate.file, "size", fmt::format("{}x{} as the reference", target.width, target.height),
                             fmt::format("{}x{}", other->width, other->height));
        if (other->channels != target.channels)
            found.not_compared.push_back(fmt::format("{}: {} channels in the reference, {} in the candidate",
                                                     place(target), target.channels, other->channels));
        found.pairs.push_back({&target, other});
        taken.push_back(other);
    }
    for (const Target& target : candidate.targets)
        if (std::ranges::find(taken, &target) == taken.end())
            found.not_compared.push_back(fmt::format("{}: in the candidate alone", place(target)));
    if (found.pairs.empty())
        throw InputError(candidate.file, "targets", "one that the reference has, too", place(candidate.targets.at(0)));
    return found;
}

}  // namespace strata::oracle
