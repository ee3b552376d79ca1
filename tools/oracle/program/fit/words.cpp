// tools/oracle/program/fit/words.cpp - sentences, made of the entries' and the properties' words (fitting.h).
#include <fmt/args.h>
#include <fmt/format.h>

#include "tools/oracle/program/fit/fitting.h"

namespace strata::oracle::program {

namespace {

// "of back faces", "with depth at least 0.7"
std::string words_of(const Condition& condition) {
    const FragmentProperty& property = *condition.property;
    if (property.kind == FragmentProperty::Kind::flag)
        return fmt::format("of {}", condition.holds(1) ? property.name : property.no);
    const std::string_view relation = condition.is == Condition::Is::equal   ? ""
                                      : condition.is == Condition::Is::below ? "below "
                                                                             : "at least ";
    return fmt::format("with {} {}{:.6g}", property.name, relation, condition.threshold);
}

}  // namespace

std::string joined_words(std::span<const Condition> conditions) {
    std::string all;
    for (const Condition& condition : conditions)
        all += fmt::format("{}{}", all.empty() ? "" : " and ", words_of(condition));
    return all;
}

namespace {

std::string joined(const Edit& edit, bool is_of_pixel) {
    std::vector<Condition> some = edit.conditions;
    std::erase_if(some, [&](const Condition& c) { return c.property->is_of_pixel != is_of_pixel; });
    return some.empty() ? std::string{} : fmt::format(" {}", joined_words(some));
}

std::string done(const Edit& edit) {
    fmt::dynamic_format_arg_store<fmt::format_context> values;
    for (const double p : edit.parameters) values.push_back(fmt::format("{:.4g}", p + 0.0));  // no -0
    return fmt::vformat(edit.entry->words, values);
}

std::string describe(const Edit& edit) {
    const std::string of_pixels = joined(edit, true), pixels = of_pixels.empty() ? "" : " at pixels" + of_pixels;
    if (edit.entry->step != PortStep::list) return done(edit) + pixels;
    const std::string fragments = joined(edit, false);
    return fmt::format("{}{}{} {}", fragments.empty() ? "all fragments" : "fragments", fragments, pixels, done(edit));
}

}  // namespace

std::string describe(const Program& program) {
    std::string all = program.drawing;
    for (const Edit& edit : program.edits) all += (all.empty() ? "" : "; and ") + describe(edit);
    return all.empty() ? "right" : all;
}

std::string to_text(const Fitting& fitting) {
    using State = Fitting::State;
    const Fitness& right = fitting.right;
    if (fitting.is_right())
        return fmt::format(
            "right: at most {:.2g} codes from compositing {}{}\n", right.worst, describe(right.rounding),
            right.lost_at_ties == 0
                ? ""
                : fmt::format("; of fragments at one depth some are lost at {} pixels", right.lost_at_ties));
    if (fitting.found.empty())
        return fmt::format("wrong: {} of {} pixels, and nothing explains them\n", right.beyond, right.pixels);
    std::string text = fitting.state == State::explained ? "wrong: " : "wrong, explained in part: ";
    for (std::size_t i = 0; i < fitting.found.size(); ++i) {
        const Proof& proof = fitting.found[i];
        text += fmt::format(
            "{}{}\n    {} of {} pixels are wrong then{}, {:.3g} bits per covered pixel instead of {:.3g}\n",
            i == 0           ? ""
            : proof.is_equal ? "  the same on this scene: "
                             : "  or: ",
            describe(proof.program), proof.fitness.beyond, proof.fitness.pixels,
            proof.open == 0 ? "" : fmt::format(" ({} of them are as near to the threshold as rounding)", proof.open),
            proof.fitness.bits_per_covered(), right.bits_per_covered());
    }
    return text;
}

}  // namespace strata::oracle::program
