// tools/oracle/judge/judge.cpp - decides by layers and emulations, and makes the sentences and the document once
// (judge.h).
#include "tools/oracle/judge/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "peeling/registry.h"
#include "pipeline/device/check.h"
#include "rasterizer/base/enum_values.h"
#include "tools/oracle/compare/report_json.h"
#include "tools/oracle/diagnosis/diagnosis_report.h"
#include "tools/oracle/judge/another_camera.h"
#include "tools/oracle/judge/distinguish.h"
#include "tools/oracle/judge/emulated.h"
#include "tools/oracle/judge/fitted.h"
#include "tools/oracle/judge/forgotten.h"
#include "tools/oracle/judge/layers_verdict.h"
#include "tools/oracle/judge/picture_diagnosis.h"
#include "tools/oracle/judge/sample_habits.h"
#include "tools/oracle/picture/stored_like.h"
#include "tools/oracle/verdict/equal_picture.h"
#include "tools/oracle/verdict/other_rules.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;
using Kind = Emulated::Kind;

// The first line of a text, and what follows it.
std::pair<std::string, std::string> divided(const std::string& text) {
    const std::size_t end = text.find('\n');
    return {text.substr(0, end), text.substr(std::min(text.size(), end + 1))};
}

// A file of straight colours by definition that holds others.
bool is_premultiplied(const verdict::PictureVerdict& single) {
    return single.formed.is_chosen && !single.formed.use.is_divided;
}

class Judge {
  public:
    Judge(const peeling::FrameRequest& input, const AskedPicture& asked, Effort effort)
        : input_{input},
          asked_{asked},
          algorithm_{asked.algorithm != nullptr ? *asked.algorithm : *peeling::find_algorithm("dual")},
          effort_{effort} {}

    [[nodiscard]] Judgement decide() && {
        const bool has_colors = std::ranges::any_of(asked_.candidate.targets,
                                                    [](const TargetImage& t) { return t.meaning == Meaning::color; });
        if (effort_ == Effort::all) emulations_ = diagnose_picture(input_, algorithm_, asked_);
        if (emulations_) emulated_ = emulated_of(emulations_->found);
        // Passes show more than the layers of the picture. A file may have depths alone, which emulations judge.
        if (asked_.passes == nullptr && (has_colors || !emulations_)) layers_ = judge_layers(input_, asked_);
        if (layers_ && !emulations_ && (!layers_->is_right() || layers_->lost_at_ties() > 0 || !algorithm_.exact))
            ask_single_emulations();
        weigh();
        found_.is_right = found_.state == JudgedState::right || found_.state == JudgedState::right_otherwise;
        found_.is_undecided = found_.state == JudgedState::undecided;
        if (emulations_) conclude();
        finish();
        return std::move(found_);
    }

  private:
    void ask_single_emulations() {
        const TargetImage& colors = colors_of(asked_.candidate);
        if (colors.pixels() > most_pixels_of_emulations) return;
        const auto& wrong = layers_->wrong_colors();
        const rasterizer::Rect part = !wrong.empty()    ? verdict::most_wrong(wrong, colors.width)
                                      : layers_->single ? verdict::fullest(*layers_->single->fragments)
                                                        : rasterizer::Rect{0, 0, 32, 32};
        try {
            emulated_ = emulated_alone(input_, algorithm_, asked_, part);
        } catch (const pipeline::Refused&) {  // a device that cannot run dual is judged by layers
        }
    }

    // Which of the two decides.
    void weigh() {
        const bool is_of_one_mistake = emulated_.kind == Kind::mistakes && emulated_.is_exact && emulated_.is_single;
        const bool is_right_run = emulated_.kind == Kind::right || emulated_.kind == Kind::other_options;
        if (!layers_) return by_emulation();
        if (!algorithm_.exact) {
            const bool is_run = is_right_run || emulated_.kind == Kind::mistakes;
            if (is_run && emulated_.is_exact) return by_emulation();
            if (is_decided_by_own_structure()) return;
            if (is_right_run) return by_emulation();
        }
        if (layers_->is_undecided() && is_of_another_camera()) return;
        if (layers_->is_right()) return layers_->lost_at_ties() > 0 && is_of_one_mistake ? by_emulation() : by_layers();
        if (is_right_run) return by_emulation();
        if (layers_->is_explained()) {
            if (!layers_->wrong_colors().empty())
                take(forgotten_alpha(input_, layers_->colors(), layers_->wrong_colors(), is_drawn_by()));
            return by_layers();
        }
        if (is_of_one_mistake) return by_emulation();
        if (is_sample_habit()) return;
        const bool is_view = is_right_in_another_view(), is_open = !is_view && !layers_->is_undecided();
        if (is_open && emulated_.kind == Kind::mistakes) return by_emulation();
        if (is_open && is_of_another_peel()) return by_emulation();
        if (!is_view && is_fitted()) return;
        if (is_open && is_of_another_camera()) return;
        by_layers();
        if (fitted_) add_fitted_leads();
    }

    // What a port does once a pixel that others do for every sample.
    [[nodiscard]] bool is_sample_habit() {
        if (!layers_->samples) return false;
        habit_ = sample_habit(input_, layers_->colors(), layers_->wrong_colors().size());
        if (!habit_) return false;
        found_.state = JudgedState::explained;
        found_.mistakes = {habit_->words};
        found_.sentence = "wrong: " + habit_->words;
        return true;
    }

    // Where no algorithm is stated, a peel from the front has mistakes that dual has not.
    [[nodiscard]] bool is_of_another_peel() {
        const TargetImage& colors = colors_of(asked_.candidate);
        if (asked_.algorithm != nullptr || !layers_->single || colors.pixels() > most_pixels_of_emulations)
            return false;
        const auto& wrong = layers_->wrong_colors();
        if (wrong.empty()) return false;
        const peeling::Algorithm& peel = *peeling::find_algorithm("front_to_back");
        Emulated found = emulated_alone(input_, peel, asked_, verdict::most_wrong(wrong, colors.width));
        if (found.kind != Kind::mistakes && found.kind != Kind::other_options) return false;
        emulated_ = std::move(found);
        emulated_.words += ", of front_to_back";
        return true;
    }

    // True if a fit explains the picture. Scenes of many fragments are not fitted.
    [[nodiscard]] bool is_fitted() {
        constexpr std::uint64_t most_fragments = 1'000'000;
        if (!layers_->single) return false;
        const verdict::SceneFragments& fragments = *layers_->single->fragments;
        if (!fragments.keeps() || fragments.count() > most_fragments) return false;
        FittedPicture fitted = fitted_picture(input_, fragments, layers_->colors());
        if (layers_->is_undecided() && fitted.fitting.is_right()) {
            found_.state = JudgedState::right;
            found_.sentence = fitted.right_sentence(asked_.candidate.targets[0].pixels());
            return true;
        }
        // What a right port may produce is wrong only if an explanation leaves next to nothing.
        const bool is_strict = layers_->is_undecided();
        if (!fitted.is_explained() || (is_strict && !(fitted.cost() < 0.12 * fitted.fitting.right.bits))) {
            fitted_ = std::move(fitted);
            return false;
        }
        if (!algorithm_.exact && is_habit_of(fitted, fragments, verdict::Colors{colors_of(own_as_stored())}))
            return false;
        found_.state = JudgedState::explained;
        found_.forgotten.clear();
        found_.mistakes = fitted.mistakes();
        found_.sentence = "wrong: " + found_.mistakes[0];
        fitted_ = std::move(fitted);
        return true;
    }

    // A camera that is a little off moves edges, which another rasterizer's snapping may excuse.
    [[nodiscard]] bool is_of_another_camera() {
        if (!layers_->single) return false;
        const auto camera = another_camera(input_, algorithm_, layers_->colors());
        if (!camera) return false;
        found_.state = JudgedState::explained;
        found_.mistakes = {"another camera: " + camera->words};
        found_.sentence = camera->sentence(asked_.candidate.targets[0].pixels());
        found_.forgotten.clear();
        return true;
    }

    void add_fitted_leads() {
        const std::vector<std::string> leads = fitted_->leads();
        if (!leads.empty() && found_.state == JudgedState::not_explained) found_.state = JudgedState::explained_in_part;
        found_.leads.insert(found_.leads.end(), leads.begin(), leads.end());
    }

    // The right picture of the stated algorithm.
    const Picture& own() {
        if (!own_) own_ = MistakeRenderer{input_, algorithm_}.right();
        return *own_;
    }
    [[nodiscard]] Picture own_as_stored() { return stored_like(own(), asked_.candidate, input_.space); }

    [[nodiscard]] bool is_right_in_another_view() {
        if (layers_->wrong_colors().empty()) return false;
        if (asked_.is_right_in_other_space && asked_.is_right_in_other_space(true))
            take({.sentences = {input_.space == pipeline::ColorSpace::linear
                                    ? "without --color-space linear the picture is right"
                                    : "looks forgotten: --color-space linear; with it the picture is right"},
                  .makes_right = true});
        else
            take(forgotten_options(input_, layers_->colors(), layers_->wrong_colors(), is_drawn_by(), asked_.camera,
                                   asked_.view));
        return makes_right_;
    }

    [[nodiscard]] IsDrawnBy is_drawn_by() const {
        const auto part = verdict::most_wrong(layers_->wrong_colors(), colors_of(asked_.candidate).width);
        return [this, part](const peeling::FrameRequest& so) {
            // Where no algorithm is stated, the two peels blend in different orders.
            return is_picture_of(so, algorithm_, asked_, part) ||
                   (asked_.algorithm == nullptr &&
                    is_picture_of(so, *peeling::find_algorithm("front_to_back"), asked_, part));
        };
    }

    void take(Forgotten view) {
        found_.forgotten = std::move(view.sentences);
        makes_right_ = view.makes_right;
    }

    void by_layers() {
        using enum JudgedState;
        found_.state = layers_->is_right()       ? layers_->is_by_other_rules() ? right_otherwise : right
                       : layers_->is_undecided() ? undecided
                       : layers_->is_explained() ? explained
                                                 : not_explained;
        found_.mistakes = layers_->mistakes(input_.list);
        found_.leads = layers_->leads(input_.list);
        if (found_.state == not_explained && !(found_.leads.empty() && found_.forgotten.empty()))
            found_.state = explained_in_part;
    }

    void by_emulation() {
        using enum JudgedState;
        is_by_emulation_ = true;
        found_.forgotten.clear();
        switch (emulated_.kind) {
            case Kind::none: break;
            case Kind::right: found_.state = right; break;
            case Kind::other_options: found_.state = right_otherwise; break;
            case Kind::mistakes: found_.state = explained; break;
        }
        if (emulated_.kind != Kind::none) {
            found_.sentence = sentence_of(emulated_, algorithm_, asked_.candidate.targets[0].pixels());
            if (found_.state == explained) found_.mistakes = {emulated_.words};
        } else {
            found_.sentence = divided("wrong: " + first_line(emulations_->found)).first;
        }
    }

    // An approximate algorithm has a structure of its own; a port that has it, too, is right. A picture with the exact
    // structure is not that of an algorithm that has another one.
    [[nodiscard]] bool is_decided_by_own_structure() {
        const auto rounded =
            right_but_for_rounding(colors_of(own()), colors_of(asked_.candidate), input_.space, algorithm_);
        if (rounded) {
            found_.state = JudgedState::right;
            found_.sentence = *rounded;
            return true;
        }
        const std::vector<std::string> seen = layers_->mistakes(input_.list);
        if (seen.empty() && !layers_->is_right()) return false;
        const Picture own = own_as_stored();
        const LayersVerdict its =
            judge_layers(input_, {.candidate = own, .has_alpha = asked_.has_alpha, .more = asked_.more});
        if (layers_->is_right()) {
            if (its.is_right()) return false;
            found_.sentence =
                fmt::format("wrong: the picture is right for the scene, but not that of {}", algorithm_.name);
            return true;
        }
        const std::vector<std::string> of_own = its.mistakes(input_.list);
        const auto shared = std::ranges::find_first_of(seen, of_own);
        if (shared == seen.end()) return false;
        found_.state = JudgedState::right;
        found_.sentence = fmt::format("right but for rounding: {}, as {} does", *shared, algorithm_.name);
        return true;
    }

    // Of a picture that something else explains a lead is false.
    void drop_leads() {
        found_.leads.clear();
        if (layers_) layers_->drop_leads();
    }

    // The conclusion of a diagnosis is the judgement's.
    void conclude() {
        Diagnosis& found = emulations_->found;
        const bool is_right_run = emulated_.kind == Kind::right || emulated_.kind == Kind::other_options;
        if (found_.is_right && !is_by_emulation_ && !(is_right_run && emulated_.is_exact)) {
            found.conclusion = Conclusion::right_structure;
            found.is_nearly = false;
        } else if (!found_.is_right && !is_by_emulation_ && emulated_.kind == Kind::mistakes &&
                   !(emulated_.is_single && emulated_.is_exact)) {
            found.conclusion = Conclusion::unknown_mistake;
            found.is_nearly = false;
        }
        const bool is_open =
            found.conclusion == Conclusion::unknown_mistake &&
            (found_.state == JudgedState::not_explained || found_.state == JudgedState::explained_in_part || !layers_);
        found.distinguishing_scene = scene_for(found, is_open);
    }

    void finish() {
        if (layers_ && layers_->single) {
            verdict::PictureVerdict& single = *layers_->single;
            single.found.distinguishing_command = distinguishing_command(single.found);
            if (shows_linear_light() && input_.space == pipeline::ColorSpace::encoded &&
                asked_.is_right_in_other_space && asked_.is_right_in_other_space(false))
                single.reading += "  with --color-space linear the picture is right\n";
        }
        if (makes_right_ || (found_.state == JudgedState::explained && !(layers_ && layers_->is_explained())))
            drop_leads();
        const auto [first, rest] =
            layers_ ? divided(layers_->text(input_.list)) : std::pair<std::string, std::string>{};
        constexpr std::string_view unexplained = ", and no single mistake explains them all";
        if (found_.sentence.empty())
            found_.sentence = makes_right_ && first.ends_with(unexplained)
                                  ? first.substr(0, first.size() - unexplained.size())
                                  : first;
        if (found_.is_right && !is_by_emulation_ && layers_ && layers_->single && is_premultiplied(*layers_->single))
            found_.sentence += "; colours are premultiplied, where such a file has straight ones";
        write_text(rest);
        write_json();
        if (layers_) found_.layers = std::make_shared<const LayersVerdict>(*std::move(layers_));
        if (emulations_) found_.emulations = std::make_shared<const PictureDiagnosis>(*std::move(emulations_));
    }

    [[nodiscard]] bool shows_linear_light() const {
        using verdict::RuleKind;
        return std::ranges::any_of(layers_->single->found.explanations, [](const verdict::CheckedAccount& c) {
            const RuleKind kind = c.account.rules[0].kind;
            return kind == RuleKind::decoded || kind == RuleKind::blended_linear;
        });
    }

    void write_text(const std::string& lines_of_layers) {
        std::string& text = found_.text;
        text = found_.sentence + '\n';
        for (const std::string& sentence : found_.forgotten) text += "  " + sentence + '\n';
        if (fitted_ && (fitted_->is_explained() || !found_.leads.empty()))
            text += fitted_->lines(asked_.candidate.targets[0].pixels());
        if (habit_) text += habit_->line(layers_->wrong_colors().size());
        if (layers_ && !is_by_emulation_ && (found_.state != JudgedState::explained || layers_->is_explained()) &&
            layers_->is_right() == found_.is_right)
            text += lines_of_layers;
        if (!emulations_) {
            if (layers_->samples && found_.state == JudgedState::not_explained)
                text += "  strata diagnose, with the same --samples, names known mistakes\n";
            if (!is_by_emulation_ && emulated_.kind == Kind::mistakes)
                text += "  every pixel is that of: " + emulated_.words + '\n';
            for (const std::string& words : emulated_.alike)
                text += "  the same picture of this scene: " + words + '\n';
            return;
        }
        const bool is_of_layers = emulations_->found.conclusion == Conclusion::right_structure;
        if (!is_by_emulation_ && !is_of_layers) text += "  " + first_line(emulations_->found);
        text += oracle::lines_of(emulations_->found, emulations_->comparison);
    }

    void write_json() {
        ordered_json layers = layers_ ? layers_->json(input_) : ordered_json(nullptr);
        ordered_json document = emulations_ ? json_of(emulations_->found, emulations_->comparison) : layers;
        if (emulations_)
            document["structure"] = std::move(layers);
        else
            document["verdict"] = found_.is_right ? "right" : found_.is_undecided ? "undecided" : "wrong";
        document["state"] = name(found_.state);
        document["sentence"] = found_.sentence;
        document["mistakes"] = found_.mistakes;
        document["forgotten"] = found_.forgotten;
        if (emulations_) document["leads"] = found_.leads;
        found_.json = text_of(document);
    }

    const peeling::FrameRequest& input_;
    const AskedPicture& asked_;
    const peeling::Algorithm& algorithm_;
    Effort effort_;
    std::optional<LayersVerdict> layers_{};
    std::optional<PictureDiagnosis> emulations_{};
    Emulated emulated_{};
    std::optional<FittedPicture> fitted_{};
    std::optional<NamedHabit> habit_{};
    std::optional<Picture> own_{};
    bool is_by_emulation_ = false, makes_right_ = false;
    Judgement found_{};
};

}  // namespace

std::string_view name(JudgedState state) noexcept { return enum_name(state); }

Judgement judge(const peeling::FrameRequest& input, const AskedPicture& asked, Effort effort) {
    return Judge{input, asked, effort}.decide();
}

}  // namespace strata::oracle
