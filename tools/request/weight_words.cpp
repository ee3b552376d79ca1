// tools/request/weight_words.cpp - reads formulas of weights (weight_words.h).
#include "tools/request/weight_words.h"

#include <algorithm>
#include <array>
#include <string>

#include "tools/request/parse.h"

namespace strata::tools {

namespace {

using peeling::WeightFormula;
using peeling::WeightStep;
using peeling::WeightTerm;

constexpr std::size_t longest_text = 400;  // bounds the depth of brackets, too

struct NamedTerm {
    std::string_view name;
    WeightTerm term;
    int arguments;
};
constexpr std::array named_terms{
    NamedTerm{"z", WeightTerm::depth, 0},     NamedTerm{"distance", WeightTerm::distance, 0},
    NamedTerm{"alpha", WeightTerm::alpha, 0}, NamedTerm{"exp", WeightTerm::exponential, 1},
    NamedTerm{"min", WeightTerm::least, 2},   NamedTerm{"max", WeightTerm::greatest, 2},
    NamedTerm{"pow", WeightTerm::power, 2}};

bool is_letter(char c) { return c >= 'a' && c <= 'z'; }
bool is_of_number(char c) { return (c >= '0' && c <= '9') || c == '.'; }

// Appends steps while it reads. Every function returns false at the first fault.
class FormulaReader {
  public:
    explicit FormulaReader(std::string_view text) : text_{text} {}

    [[nodiscard]] bool is_all_read() { return sum() && at_ == text_.size(); }
    std::vector<WeightStep> steps;

  private:
    [[nodiscard]] bool takes(char c) {
        if (at_ == text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    bool add(WeightTerm term, float number = 0) {
        steps.push_back({term, number});
        return true;
    }
    // Operands of `next`, joined by one of two operators.
    [[nodiscard]] bool joined(bool (FormulaReader::*next)(), char first, WeightTerm of_first, char second,
                              WeightTerm of_second) {
        if (!(this->*next)()) return false;
        while (true) {
            const bool is_first = takes(first);
            if (!is_first && !takes(second)) return true;
            if (!(this->*next)()) return false;
            add(is_first ? of_first : of_second);
        }
    }
    [[nodiscard]] bool sum() {
        return joined(&FormulaReader::product, '+', WeightTerm::sum, '-', WeightTerm::difference);
    }
    [[nodiscard]] bool product() {
        return joined(&FormulaReader::factor, '*', WeightTerm::product, '/', WeightTerm::quotient);
    }
    [[nodiscard]] bool factor() {
        if (takes('-')) return factor() && add(WeightTerm::negated);
        if (takes('(')) return sum() && takes(')');
        if (at_ == text_.size()) return false;
        return is_letter(text_[at_]) ? name() : number();
    }
    [[nodiscard]] bool number() {
        std::size_t end = at_;
        while (end < text_.size() && is_of_number(text_[end])) ++end;
        if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
            ++end;
            if (end < text_.size() && (text_[end] == '-' || text_[end] == '+')) ++end;
            while (end < text_.size() && is_of_number(text_[end])) ++end;
        }
        const auto value = to_number<float>(text_.substr(at_, end - at_));
        at_ = end;
        return value && add(WeightTerm::number, *value);
    }
    [[nodiscard]] bool name() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
        const std::string_view name = text_.substr(begin, at_ - begin);
        if (name == "clamp") return clamp();
        const auto* const found = std::ranges::find(named_terms, name, &NamedTerm::name);
        if (found == named_terms.end()) return false;
        if (found->arguments == 0) return add(found->term);
        if (!takes('(') || !sum()) return false;
        const std::size_t before_second = steps.size();
        if (found->arguments == 2 && !(takes(',') && sum())) return false;
        if (!takes(')')) return false;
        return found->term == WeightTerm::power ? power(before_second) : add(found->term);
    }
    // The exponent's steps begin at `first`.
    bool power(std::size_t first) {
        const WeightStep exponent = steps[first];
        const bool is_whole = steps.size() == first + 1 && exponent.term == WeightTerm::number &&
                              std::trunc(exponent.number) == exponent.number && exponent.number >= 2 &&
                              exponent.number <= peeling::most_whole_power;
        if (!is_whole) return add(WeightTerm::power);
        steps.pop_back();
        return add(WeightTerm::whole_power, exponent.number);
    }
    [[nodiscard]] bool clamp() {
        return takes('(') && sum() && takes(',') && sum() && add(WeightTerm::greatest) && takes(',') && sum() &&
               add(WeightTerm::least) && takes(')');
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

std::optional<WeightFormula> to_weight_formula(std::string_view text) {
    WeightFormula formula;
    for (const char c : text)
        if (c != ' ') formula.text += c;
    if (formula.text.size() > longest_text) return std::nullopt;
    FormulaReader reader{formula.text};
    if (!reader.is_all_read()) return std::nullopt;
    formula.steps = std::move(reader.steps);
    return is_complete(formula) ? std::optional{std::move(formula)} : std::nullopt;
}

}  // namespace strata::tools
