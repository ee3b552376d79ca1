#include "tools/strata/options/option_readers.h"

#include <fmt/format.h>

#include <algorithm>

#include "peeling/registry.h"
#include "tools/request/option_fields.h"
#include "tools/strata/messages.h"

namespace strata::tools {

void refuse_unread(const CLI::App& app, const Algorithms& algorithms, const PictureRequest& request) {
    for (const OptionField& field : option_fields()) {
        const CLI::Option* const found = app.get_option_no_throw(field.option());
        const auto is_reader = [&](const peeling::Algorithm& algorithm) { return reads(algorithm, field, request); };
        const auto is_chosen = [&](const peeling::Algorithm* algorithm) { return is_reader(*algorithm); };
        if (found == nullptr || found->count() == 0 || std::ranges::any_of(algorithms, is_chosen)) continue;
        std::vector<std::string_view> chosen, readers;
        for (const peeling::Algorithm* algorithm : algorithms) chosen.push_back(algorithm->name);
        for (const peeling::Algorithm& algorithm : peeling::algorithms())
            if (is_reader(algorithm)) readers.push_back(algorithm.name);
        throw CLI::ValidationError(fmt::format("{} has no effect on {}; algorithms that use it: {}", field.option(),
                                               fmt::join(chosen, ", "), fmt::join(readers, ", ")));
    }
}

void refuse_others(const CLI::App& app, const std::vector<std::string_view>& read, const std::string& why) {
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();
        if (option->count() > 0 && !is_message_option(*option) && std::ranges::find(read, name) == read.end())
            throw CLI::ValidationError(name + " has no effect " + why);
    }
}

}  // namespace strata::tools
