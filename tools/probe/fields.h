// tools/probe/fields.h - the fields of a profile as unknowns: which the kit can tell, when a field matters, and in
// which groups they are searched.
//
// Rule     A field that does not matter under the other fields keeps its value and is not searched. Groups are searched
//          in order: the scenes of a group depend on its own fields and on those of the groups before it.
// Tests    tests/tools/probe/kit_test.cpp
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "pipeline/device/profile_fields.h"
#include "tools/probe/item.h"

namespace strata::probe {

using pipeline::DeviceProfile;
using pipeline::ProfileField;

// The key is one of profile_fields().
[[nodiscard]] const ProfileField& field(std::string_view key);

// Whether the field can change a pixel of any scene of the kit, given the others.
[[nodiscard]] bool matters(std::string_view key, const DeviceProfile& profile);

// Whether the field can change a pixel of the scene at all. What is said to change none is not drawn again (scores.h).
[[nodiscard]] bool can_change(std::string_view key, const Item& item);

// Fields that no picture shows: features and limits, which a driver says; the origin, which its client says (--y); and
// whether equal colours are a program's uniform: the kit's are not.
[[nodiscard]] bool is_said(std::string_view key);

// Other fields that no scene of the kit decides, with the reason.
struct Unprobed {
    std::string_view key, reason;
};
[[nodiscard]] std::span<const Unprobed> unprobed_fields();
// All other fields that are rules, in the order of profile_fields().
[[nodiscard]] std::vector<const ProfileField*> probed_fields();

// The values that are searched, as numbers of ProfileField; `current` comes first.
[[nodiscard]] std::vector<int> searched_values(const ProfileField& field, int current);
// Whether the fields go together: a device could be like this.
[[nodiscard]] bool is_valid(const DeviceProfile& profile);

// What of a scene's pictures counts. Where colours are not known yet, whether a pixel is covered still tells an edge.
enum class Part : std::uint8_t { coverage, depth, color, both };

struct FieldGroup {
    std::string_view name;
    Part part{};
    // The scenes whose pixels count, by the beginnings of their names; the first of them sifts the candidates.
    std::vector<std::string_view> items{};
    // Every combination of these is tried,
    std::vector<std::string_view> joint{};
    // and these with them, one and two at a time, on the best of them.
    std::vector<std::string_view> refined{};
};
[[nodiscard]] const std::vector<FieldGroup>& field_groups();

}  // namespace strata::probe
