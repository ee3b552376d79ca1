#include "tools/request/option_fields.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/request/groups.h"
#include "tools/request/names.h"

namespace strata::tools {

namespace {

std::vector<OptionField> all_fields() {
    std::vector<OptionField> all;
    for (auto* part : {view_fields, device_fields, algorithm_fields, sample_fields, order_fields, execution_fields})
        std::ranges::move(part(), std::back_inserter(all));
    return all;
}

// "depth_format" is "depth-format".
bool is_same_name(std::string_view a, std::string_view b) {
    const auto dashed = [](char c) { return c == '_' ? '-' : c; };
    return std::ranges::equal(a, b, {}, dashed, dashed);
}

}  // namespace

std::span<const OptionField> option_fields() {
    static const std::vector<OptionField> all = all_fields();
    return all;
}

const OptionField* find_option(std::string_view name) {
    const auto fields = option_fields();
    const auto found = std::ranges::find_if(fields, [&](const OptionField& f) { return is_same_name(f.name, name); });
    return found == fields.end() ? nullptr : &*found;
}

bool reads(const peeling::Algorithm& algorithm, const OptionField& field, const PictureRequest& request) {
    const bool has_weighted_tail = request.render.algorithm.tail == peeling::Tail::weighted;
    if (field.name == "weight" && has_weighted_tail && reads(algorithm, *find_option("tail"), request)) return true;
    if (field.is_read_by != nullptr) return field.is_read_by(algorithm);
    return field.readers.empty() || std::ranges::find(field.readers, algorithm.name) != field.readers.end();
}

std::string expectation(const OptionField& field, std::string_view found) {
    return fmt::format("expected {}, found {}", field.expected,
                       field.words.empty() ? fmt::format("'{}'", found) : found_but_near(found, field.words));
}

std::vector<std::string> words_of(const PictureRequest& request, OptionGroup group) {
    std::vector<std::string> words;
    for (const OptionField& field : option_fields()) {
        if (field.group != group || field.is_default(request)) continue;
        words.push_back(field.option());
        if (!field.is_flag) words.push_back(field.text(request));
    }
    return words;
}

}  // namespace strata::tools
