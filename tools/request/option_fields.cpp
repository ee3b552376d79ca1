#include "tools/request/option_fields.h"

#include <fmt/format.h>

#include <algorithm>

#include "rasterizer/base/input_error.h"
#include "tools/request/groups.h"
#include "tools/request/names.h"

namespace strata::tools {

namespace {

std::vector<OptionField> all_fields() {
    std::vector<OptionField> all;
    for (auto* part : {view_fields, device_fields, algorithm_fields, sample_fields, order_fields, execution_fields})
        std::ranges::move(part(), std::back_inserter(all));
    all.reserve(all.size() + 1);  // commands hold references to entries while a test adds one
    return all;
}

std::vector<OptionField>& table() {
    static std::vector<OptionField> all = all_fields();
    return all;
}

// "depth_format" is "depth-format".
bool is_same_name(std::string_view a, std::string_view b) {
    const auto dashed = [](char c) { return c == '_' ? '-' : c; };
    return std::ranges::equal(a, b, {}, dashed, dashed);
}

}  // namespace

std::span<const OptionField> option_fields() { return table(); }

AddedOption::AddedOption(OptionField field) { table().push_back(std::move(field)); }
AddedOption::~AddedOption() { table().pop_back(); }

std::string OptionField::key() const {
    std::string key = name;
    std::ranges::replace(key, '-', '_');
    return key;
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

void set_option(PictureRequest& request, std::string_view name, std::string_view text, const std::string& source,
                bool (*known)(const OptionField&)) {
    const OptionField* const field = find_option(name);
    if (field == nullptr || !known(*field)) {
        std::vector<std::string> keys;
        for (const OptionField& other : option_fields())
            if (known(other)) keys.push_back(other.key());
        throw InputError(source, "option", "the name of an option", found_but_near(name, keys));
    }
    if (!field->set(request, text)) throw InputError(source, field->key(), field->expected, fmt::format("'{}'", text));
}

std::string text_of_parts(const OptionField& field, const std::vector<std::string>& parts) {
    if (parts.size() != 1) return fmt::format("{}", fmt::join(parts, field.name == "size" ? "x" : ","));
    const auto is_word = [&](const std::string& word) { return is_same_name(word, parts[0]); };
    const auto found = std::ranges::find_if(field.words, is_word);
    return found == field.words.end() ? parts[0] : *found;
}

bool is_of_frame(const OptionField& field) {
    return !keeps_bits(field.group) && field.group != OptionGroup::reading && field.group != OptionGroup::view;
}

std::string expectation(const OptionField& field, std::string_view found) {
    return fmt::format("expected {}, found {}", field.expected,
                       field.words.empty() ? fmt::format("'{}'", found) : found_but_near(found, field.words));
}

namespace {

std::vector<std::string> words_if(const PictureRequest& request, const auto& is_wanted) {
    std::vector<std::string> words;
    for (const OptionField& field : option_fields()) {
        if (!is_wanted(field) || field.is_default(request)) continue;
        words.push_back(field.option());
        if (!field.is_flag) words.push_back(field.text(request));
    }
    return words;
}

}  // namespace

std::vector<std::string> words_of(const PictureRequest& request, OptionGroup group) {
    return words_if(request, [&](const OptionField& field) { return field.group == group; });
}

std::vector<std::string> words_of(const PictureRequest& request) {
    return words_if(request, [](const OptionField&) { return true; });
}

}  // namespace strata::tools
