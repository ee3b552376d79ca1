#include "tools/oracle/verdict/picture_verdict.h"

#include <nlohmann/json.hpp>

#include "pipeline/device/profile.h"
#include "tools/oracle/verdict/other_profile.h"
#include "tools/oracle/verdict/report.h"

namespace strata::oracle::verdict {

PictureVerdict judge_picture(const RunInput& input, const PictureQuestion& question) {
    const std::uint64_t bytes = input.options.fragment_memory;
    PictureVerdict result{.fragments = std::make_unique<SceneFragments>(input, bytes)};
    result.formed = formed(*result.fragments, question.colors, question.is_form_stated);
    result.formed.use.has_alpha = question.has_alpha;
    const Colors seen = result.formed.colors();
    result.found = judge(*result.fragments, seen);
    result.reading = result.formed.description();
    if (result.state() != State::wrong || result.found.alpha.state == AlphaState::wrong) return result;
    const std::vector<std::uint32_t> wrong = result.found.right.wrong_pixels;
    if (auto other = right_by_other_profile(input, seen, wrong, question.more)) {
        result.reading += other->description(input.profile.name, wrong.size());
        result.found = std::move(other->verdict);
        result.other_profile = std::move(other->profile);
        result.fragments = std::move(other->fragments);
    }
    return result;
}

std::string to_text(const PictureVerdict& verdict, const pipeline::DrawList& list) {
    return to_text(verdict.found, list) + verdict.reading;
}

std::string to_json(const PictureVerdict& verdict, const pipeline::DrawList& list, const std::string& given_profile) {
    nlohmann::ordered_json document = nlohmann::ordered_json::parse(to_json(verdict.found, list));
    if (verdict.formed.is_chosen) document["colors"] = verdict.formed.use.is_divided ? "straight" : "premultiplied";
    document["profile"] = verdict.other_profile ? verdict.other_profile->name : given_profile;
    return document.dump(2) + '\n';
}

}  // namespace strata::oracle::verdict
