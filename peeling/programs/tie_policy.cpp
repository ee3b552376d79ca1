// peeling/programs/tie_policy.cpp - the names of tie policies in reports (tie_policy.h).
#include "peeling/programs/tie_policy.h"

namespace strata::peeling {

// The name in reports.
std::string_view name(TiePolicy policy) noexcept {
    switch (policy) {
        case TiePolicy::none: return "none";
        case TiePolicy::first: return "first";
        case TiePolicy::last: return "last";
        case TiePolicy::unique: return "unique";
        case TiePolicy::merged: return "merged";
        case TiePolicy::first_then_last: return "first_then_last";
    }
    return "";  // unreachable: the enum is closed
}

}  // namespace strata::peeling
