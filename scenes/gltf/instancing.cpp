// scenes/gltf/instancing.cpp - checks and reads the attributes of EXT_mesh_gpu_instancing (instancing.h).
#include "scenes/gltf/instancing.h"

#include <cmath>

namespace strata::scenes {

namespace {

struct Attribute {
    const char* name;
    ElementType type;
    bool may_be_normalized;
};
constexpr Attribute instance_attributes[]{{"TRANSLATION", ElementType::vec3, false},
                                          {"ROTATION", ElementType::vec4, true},
                                          {"SCALE", ElementType::vec3, false}};

// The reader of an attribute, or null; the check has verified that all attributes have the same count.
const AccessorReader* reader_of(const JsonAt& instancing, const char* name, Accessors& accessors) {
    const auto at = instancing.member("attributes").find(name);
    return at ? &accessors[static_cast<int>(at->json().get<std::size_t>())] : nullptr;
}

template <std::size_t n>
std::array<double, n> value_or(const AccessorReader* reader, std::size_t i, const std::array<double, n>& otherwise,
                               const FileLocation& location) {
    if (reader == nullptr) return otherwise;
    const std::array<float, 4> read = reader->element(i);
    std::array<double, n> value{};
    for (std::size_t c = 0; c < n; ++c) {
        value[c] = double{read[c]};
        if (!std::isfinite(value[c]))
            location.fail("ACCESSOR_INVALID_FLOAT", "finite numbers",
                          "NaN or infinity at instance " + std::to_string(i));
    }
    return value;
}

}  // namespace

std::optional<JsonAt> instancing_of(const JsonAt& node) {
    const auto extensions = node.find("extensions");
    return extensions ? extensions->find("EXT_mesh_gpu_instancing") : std::nullopt;
}

void check_instancing(const JsonAt& instancing, const JsonAt& root) {
    const JsonAt given = instancing.member("attributes").object();
    std::optional<std::uint64_t> count;
    for (const Attribute& attribute : instance_attributes) {
        const auto at = given.find(attribute.name);
        if (!at) continue;
        const Json& accessor = root.json()["accessors"][at->index(root.size("accessors"))];
        const auto component = *to_component_type(accessor["componentType"].get<std::uint64_t>());
        const bool is_float = component == ComponentType::f32;
        const bool is_normalized =
            accessor.value("normalized", false) && (component == ComponentType::i8 || component == ComponentType::i16);
        if (*to_element_type(accessor["type"].get<std::string>()) != attribute.type ||
            !(is_float || (attribute.may_be_normalized && is_normalized)))
            at->fail("INVALID_FORMAT",
                     std::string("an accessor whose type and componentType ") + attribute.name + " allows");
        const auto own = accessor["count"].get<std::uint64_t>();
        if (count.value_or(own) != own)
            at->location().fail("UNEQUAL_ACCESSOR_COUNT",
                                "as many elements as the other attributes: " + std::to_string(*count),
                                std::to_string(own));
        count = own;
    }
    if (!count) given.fail("UNDEFINED_PROPERTY", "TRANSLATION, ROTATION or SCALE");
}

std::vector<pipeline::Matrix> instance_transforms(const JsonAt& instancing, Accessors& accessors, Budget& budget) {
    const auto [moved, turned, scaled] =
        std::array{reader_of(instancing, "TRANSLATION", accessors), reader_of(instancing, "ROTATION", accessors),
                   reader_of(instancing, "SCALE", accessors)};
    const AccessorReader& any = *(moved != nullptr ? moved : turned != nullptr ? turned : scaled);
    budget.pay_elements(any.count(), sizeof(pipeline::Matrix) + sizeof(pipeline::Instance), instancing.location());
    std::vector<pipeline::Matrix> transforms;
    transforms.reserve(any.count());
    for (std::size_t i = 0; i < any.count(); ++i)
        transforms.push_back(transform_of(value_or<3>(moved, i, {0, 0, 0}, instancing.location()),
                                          value_or<4>(turned, i, {0, 0, 0, 1}, instancing.location()),
                                          value_or<3>(scaled, i, {1, 1, 1}, instancing.location())));
    return transforms;
}

}  // namespace strata::scenes
