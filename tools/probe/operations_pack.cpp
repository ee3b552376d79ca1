#include "tools/probe/operations_pack.h"

#include <fmt/format.h>

#include "rasterizer/base/input_error.h"

namespace strata::probe {

namespace {

using nlohmann::json;

std::vector<std::size_t> shape_of(const Operation& o) {
    return {static_cast<std::size_t>(o.height()), static_cast<std::size_t>(o.width), 4};
}

std::vector<Texel> texels_of(const Operation& o, const std::string& bytes, const std::string& file) {
    const scenes::NumberArray array = scenes::parse_npy(bytes, file);
    if (array.element != scenes::Element::u4 || array.shape != shape_of(o))
        throw InputError(file, "shape", fmt::format("u4 of {} x {} x 4", o.height(), o.width), "another array");
    std::vector<Texel> texels(o.inputs.size());
    for (std::size_t i = 0; i < 4 * texels.size(); ++i) texels[i / 4][i % 4] = array.word(i);
    return texels;
}

}  // namespace

std::string operation_file(const std::string& name) { return fmt::format("probe/operations/{}.npy", name); }

scenes::NumberArray as_array(const Operation& operation, const std::vector<Texel>& texels) {
    scenes::NumberArray array{.element = scenes::Element::u4, .shape = shape_of(operation)};
    for (const Texel& texel : texels)
        for (const std::uint32_t word : texel) array.append(word);
    return array;
}

OperationReplies read_operations(const json& probe, const std::map<std::string, std::string>& files,
                                 const std::string& path) {
    OperationReplies replies;
    if (!probe.contains("operations")) return replies;
    if (probe["operations"] != operations_digest())
        throw InputError(path + "/candidate.json", "/probe/operations",
                         "the operations of this program, " + operations_digest(), probe["operations"].dump());
    const json missing = probe.value("missing", json::object());
    for (const Operation& o : operations()) {
        OperationReply& reply = replies[o.name];
        const std::string file = operation_file(o.name), key = "operations/" + o.name;
        if (const auto found = files.find(file); found != files.end())
            reply.texels = texels_of(o, found->second, path + "/" + file);
        else
            reply.refusal = missing.value(key, "the pack has no results");
    }
    return replies;
}

}  // namespace strata::probe
