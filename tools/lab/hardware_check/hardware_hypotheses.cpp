#include "tools/lab/hardware_check/hardware_hypotheses.h"

#include <fmt/format.h>

#include <algorithm>

#include "rasterizer/rules/hypotheses.h"
#include "tools/lab/parallel_items.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace hc = hardware_check;
using rasterizer::NamedHypothesis;
using Subject = rasterizer::HypothesisSubject;

namespace {

// A subject and the heading of its table, in the order of the output.
struct Titled {
    Subject subject;
    std::string_view title;
};
constexpr Titled subjects[] = {{Subject::window_depth, "depths that are written"},
                               {Subject::texture_depth, "depths made of r and q, or compared with a texel"},
                               {Subject::color, "vertex colours"},
                               {Subject::coordinates, "texture coordinates"}};

// One capture's comparison under every hypothesis; empty if the capture cannot distinguish them.
using Verdicts = std::vector<hc::CaptureComparison>;

bool has(hc::Subjects set, Subject subject) { return (set >> static_cast<unsigned>(subject) & 1) != 0; }

// True if a picture of this suite, in this reading, depends on the subject. Depth pictures never depend on colours, nor
// colours on written depths, whatever the suite's list; and if depths are interpolated without division, depth values
// do not depend on coordinates.
bool can_tell(const hc::Suite& suite, hc::CaptureFormat reading, Subject subject) {
    const bool shows_depth = reading == hc::CaptureFormat::depth16 || reading == hc::CaptureFormat::depth24;
    if (subject == (shows_depth ? Subject::color : Subject::window_depth)) return false;
    if (shows_depth && subject == Subject::coordinates && has(suite.determines, Subject::window_depth)) return false;
    return has(suite.determines, subject);
}

// Draws the capture once under each hypothesis, with the rest of the profile as given.
Verdicts verdicts_of(const Capture& capture, const pipeline::DeviceProfile& profile, Subject subject,
                     const std::vector<NamedHypothesis>& hypotheses) {
    const hc::Suite* const suite = hc::find_suite(capture.suite);
    if (suite == nullptr || suite->determines == 0) return {};
    const hc::Drawing given = drawn(capture, profile);
    if (!given.picture || !can_tell(*suite, given.picture->reading, subject)) return {};
    const pipeline::Image image = read_capture(capture.path);
    Verdicts verdicts;
    for (const NamedHypothesis& hypothesis : hypotheses) {
        pipeline::DeviceProfile varied = profile;
        varied.raster = hypothesis.rules;
        verdicts.push_back(hc::compare(*drawn(capture, varied).picture, image, capture.path));
    }
    return verdicts;
}

// The rules as given first, then every value of every undetermined constant of this subject.
std::vector<NamedHypothesis> hypotheses_on(Subject subject, const rasterizer::RasterRules& rules) {
    std::vector<NamedHypothesis> chosen = rasterizer::depth_hypotheses(rules);
    const std::vector<NamedHypothesis> others = rasterizer::interpolation_hypotheses(rules);
    // Both lists begin with the rules as given: one of the two is omitted.
    chosen.insert(chosen.end(), others.begin() + 1, others.end());
    chosen.erase(std::remove_if(chosen.begin() + 1, chosen.end(),
                                [&](const NamedHypothesis& h) { return h.subject != subject; }),
                 chosen.end());
    return chosen;
}

// One row per hypothesis: the captures that are equal, the captures within their bound, and differing pixels over all
// captures.
Table table_of(const std::vector<NamedHypothesis>& hypotheses, const std::vector<Verdicts>& verdicts) {
    Table table{{{"hypothesis"},
                 {"equal", Align::right},
                 {"within bound", Align::right},
                 {"pixels off", Align::right},
                 {"largest", Align::right}},
                {}};
    for (std::size_t h = 0; h < hypotheses.size(); ++h) {
        std::uint64_t equal = 0, within = 0, differing = 0;
        std::uint32_t largest = 0;
        for (const Verdicts& of_capture : verdicts) {
            // This capture cannot distinguish them.
            if (of_capture.empty()) continue;
            const hc::CaptureComparison& c = of_capture[h];
            equal += c.differing == 0;
            within += c.within_bound;
            differing += c.differing;
            largest = std::max(largest, c.largest);
        }
        table.rows.push_back({hypotheses[h].name, fmt::to_string(equal), fmt::to_string(within),
                              fmt::to_string(differing), fmt::to_string(largest)});
    }
    return table;
}

}  // namespace

std::string hypothesis_scores(const std::vector<Capture>& captures, const pipeline::DeviceProfile& profile) {
    std::string text;
    for (const Titled& each : subjects) {
        const std::vector<NamedHypothesis> hypotheses = hypotheses_on(each.subject, profile.raster);
        std::vector<Verdicts> verdicts(captures.size());
        for_every("checking", captures.size(),
                  [&](std::size_t i) { verdicts[i] = verdicts_of(captures[i], profile, each.subject, hypotheses); });
        const auto telling =
            std::count_if(verdicts.begin(), verdicts.end(), [](const Verdicts& v) { return !v.empty(); });
        text += fmt::format("{}{}: {} captures can tell\n", text.empty() ? "" : "\n", each.title, telling);
        if (telling > 0) text += to_text(table_of(hypotheses, verdicts));
    }
    return text;
}

}  // namespace strata::tools
