// tools/lab/probe/search/fields.h - the fields of a profile as unknowns: those that the kit can determine, when a field
// matters, and the groups in which they are searched.
//
// Rule     A field that has no effect given the other fields keeps its value and is not searched. Groups are searched
//          in order: the scenes of a group depend on its own fields and on those of the groups before it.
// Tests    tests/tools/lab/probe/kit_test.cpp
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "pipeline/device/profile_fields.h"
#include "tools/lab/probe/kit/item.h"

namespace strata::probe {

using pipeline::DeviceProfile;
using pipeline::ProfileField;

// The key is one of profile_fields().
[[nodiscard]] const ProfileField& field(std::string_view key);

// True if the field can change a pixel of any scene of the kit, given the other fields.
[[nodiscard]] bool matters(std::string_view key, const DeviceProfile& profile);

// True if the field can change a pixel of the scene. A scene that a field cannot change is not drawn again (scores.h).
[[nodiscard]] bool can_change(std::string_view key, const Item& item);

// Fields that no picture determines: features and limits, which the driver reports; the origin, which the client states
// (--y); the default convention of depth, which scenes of the kit do not use; and whether equal colours are a uniform
// of a program, which the kit's are not.
[[nodiscard]] bool is_reported(std::string_view key);

// Other fields that no scene of the kit determines, with the reason.
struct Unprobed {
    std::string_view key, reason;
};
[[nodiscard]] std::span<const Unprobed> unprobed_fields();
// All other fields that are rules, in the order of profile_fields().
[[nodiscard]] std::vector<const ProfileField*> probed_fields();

// The values to search, as numbers of ProfileField; `current` is first.
[[nodiscard]] std::vector<int> searched_values(const ProfileField& field, int current);
// True if the fields are consistent, so that a device could have them.
[[nodiscard]] bool is_valid(const DeviceProfile& profile);

// The part of a scene's pictures that is compared. While colours are not known, coverage alone still determines edges.
enum class Part : std::uint8_t { coverage, depth, color, both };

struct FieldGroup {
    std::string_view name;
    Part part{};
    // The scenes to compare, by the beginnings of their names; candidates are preselected on the first of them.
    std::vector<std::string_view> items{};
    // Every combination of these fields is tried.
    std::vector<std::string_view> joint{};
    // Then these and the joint fields are tried one and two at a time, starting from the best combinations.
    std::vector<std::string_view> refined{};
};
[[nodiscard]] const std::vector<FieldGroup>& field_groups();

}  // namespace strata::probe
