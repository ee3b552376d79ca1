// tools/library/options.cpp - the options of a frame by name, from the table of options.
#include "rasterizer/base/input_error.h"
#include "strata/render.h"
#include "tools/request/complete.h"
#include "tools/request/option_fields.h"

namespace strata {
inline namespace v0_1 {

RenderOptions options_of(const NamedOptions& named, DeviceProfile& profile) {
    tools::PictureRequest request;
    for (const auto& [name, text] : named)
        tools::set_option(request, name, text, "options", [](const tools::OptionField& field) {
            return field.group != tools::OptionGroup::reading && field.name != "camera" && field.name != "orbit";
        });
    if (!request.scene_options.alpha.empty())
        throw InputError("options", "alpha", "a number from 0 to 1", "alphas of materials");
    if (const auto found = tools::option_conflict(request))
        throw InputError("options", found->option.empty() ? found->sentence : found->option + ": " + found->sentence);
    if (request.origin) profile = with_origin(profile, *request.origin);
    tools::complete(request, profile);
    return request.render;
}

}  // namespace v0_1
}  // namespace strata
