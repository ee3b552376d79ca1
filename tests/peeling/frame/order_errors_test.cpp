// Tests the cause that is reported for an audit's order errors, against a table of the causes in
// peeling/reference/keys-and-counts.md 7.3.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "peeling/frame/render_diagnostics.h"
#include "peeling/registry.h"
#include "peeling/render_options.h"

namespace {

using namespace strata::peeling;
using strata::pipeline::Diagnostic;
using strata::pipeline::Fault;

struct Cause {
    std::string algorithm;
    bool is_invariant = true;
    Fault fault = Fault::out_of_order;
    std::string message;  // empty: nothing is reported
};

const std::vector<Cause> causes{
    {"painter", true, Fault::out_of_order, "triangles sorted by their centroids overlap out of order"},
    {"painter", false, Fault::out_of_order, "triangles sorted by their centroids overlap out of order"},
    {"object_sorted", true, Fault::out_of_order, "objects or their own triangles overlap out of order"},
    {"hybrid", true, Fault::out_of_order, "the ordered set (--sorted) does not arrive front to back"},
    {"batched", false, Fault::unlike_depths, "3 layers lost, repeated or misplaced"},
    {"front_to_back", false, Fault::unlike_depths, "3 layers lost, repeated or misplaced"},
    {"k_buffer", false, Fault::unlike_depths, "3 layers lost, repeated or misplaced"},
    {"k_buffer", true, {}, ""},
    {"unsorted", true, {}, ""},
    {"weighted_average", true, {}, ""}};

}  // namespace

TEST_CASE("order errors are attributed to the cause given by the algorithm's order and its depths") {
    AuditResult audit;
    audit.order_errors = 3;
    audit.misordered = {2, 1, 0};
    for (const Cause& cause : causes) {
        INFO(cause.algorithm << (cause.is_invariant ? "" : ", unlike depths"));
        std::vector<Diagnostic> all;
        add_audit_diagnostics(*find_algorithm(cause.algorithm), {}, {.is_invariant = cause.is_invariant}, audit, all);
        REQUIRE(all.size() == (cause.message.empty() ? 0u : 1u));
        if (!all.empty()) CHECK(all[0] == Diagnostic{cause.fault, 2, 1, 0, cause.message});
    }
}

TEST_CASE("options have the specification's default values") {
    const RenderOptions options;
    CHECK(options.fragment_memory == 268435456u);
    CHECK(options.average_count == strata::pipeline::Format::r16f);
}
