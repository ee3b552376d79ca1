// Tests the diagnostics for given figures of an audit, and for given properties of a device.
#include "peeling/frame/render_diagnostics.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "peeling/registry.h"

namespace {

using namespace strata::peeling;
using namespace strata::pipeline;

std::vector<Diagnostic> audited(const char* algorithm, bool invariant) {
    AuditResult audit;
    audit.order_errors = 3;
    audit.misordered = {2, 1, 0};
    std::vector<Diagnostic> all;
    add_audit_diagnostics(*find_algorithm(algorithm), {}, {.is_invariant = invariant}, audit, all);
    return all;
}

bool says_quantized(const char* algorithm, DepthFormat format, bool quantizes) {
    std::vector<Diagnostic> all;
    note_extensions(*find_algorithm(algorithm), format, quantizes, all);
    return std::ranges::any_of(all, [](const Diagnostic& d) { return d.fault == Fault::depth_quantized; });
}

}  // namespace

TEST_CASE(
    "an approximation's order errors are reported where its passes see different depths and not if they are its own") {
    REQUIRE_FALSE(find_algorithm("k_buffer")->exact);
    CHECK(audited("k_buffer", true).empty());
    const auto unlike = audited("k_buffer", false);
    REQUIRE(unlike.size() == 1);
    CHECK(unlike[0].fault == Fault::unlike_depths);
    CHECK(unlike[0].pixels == 2);
    CHECK(unlike[0].first_x == 1);
    CHECK(unlike[0].first_y == 0);
}

TEST_CASE("a program's conversion of its depth is reported where it converts and where the buffer is not binary32") {
    REQUIRE_FALSE(find_algorithm("front_to_back")->compares_own_codes);
    CHECK(says_quantized("front_to_back", DepthFormat::d24, true));
    CHECK_FALSE(says_quantized("front_to_back", DepthFormat::d24, false));
    CHECK_FALSE(says_quantized("front_to_back", DepthFormat::d32f, true));
    for (const Algorithm& algorithm : algorithms())
        if (algorithm.compares_own_codes && says_quantized(algorithm.name.c_str(), DepthFormat::d24, true))
            CHECK(says_quantized(algorithm.name.c_str(), DepthFormat::d24, false));
}
