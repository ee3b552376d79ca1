// Tests the steps of depth buffers by distance against the derivatives of their depths, and the table of the command.
#include "tools/lab/invariance/precision.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tools/program.h"

namespace {

using namespace strata::test;
using namespace strata::tools;

constexpr DepthSpan span{0.1, 10000};

const DepthChoice& choice_named(const std::string& name) {
    const auto all = depth_choices();
    return *std::ranges::find(all, name, &DepthChoice::name);
}

// The real step of a code of `bits` bits: its width over the derivative of depth by distance.
double linear_step(double d, int bits) {
    return d * d * (span.far - span.near) / (span.far * span.near) * std::exp2(-bits);
}
double logarithmic_step(double d, int bits) { return (1 + d) * std::log(1 + span.far) * std::exp2(-bits); }

}  // namespace

TEST_CASE("steps of fixed-point buffers are those of the derivative, from half a step to two and vertices' roundings") {
    for (const double d : {1.0, 10.0, 100.0, 1000.0}) {
        const double of_vertex = d * 0x1p-22;  // positions and the products of their transform are binary32
        const auto is_near = [&](const char* name, double right) {
            const auto step = depth_step(choice_named(name), span, d);
            INFO(name << " at " << d << ": " << step.value_or(-1) << ", real " << right);
            REQUIRE(step.has_value());
            CHECK(*step > 0.5 * right);
            CHECK(*step < 2 * right + 2 * of_vertex + right * d / 1000);
        };
        if (linear_step(d, 16) < 0.05 * d) is_near("d16", linear_step(d, 16));
        if (linear_step(d, 24) < 0.05 * d) is_near("d24", linear_step(d, 24));
        is_near("d24 logarithmic", logarithmic_step(d, 24));
    }
}

TEST_CASE("reversed binary32 keeps a step that grows with the distance alone and linear depth grows with its square") {
    const auto step = [](const char* name, double d) { return depth_step(choice_named(name), span, d).value_or(1e30); };
    for (const double d : {10.0, 100.0, 1000.0}) {
        CHECK(step("d32f reversed", d) < d * 0x1p-20);
        CHECK(step("d32f", d) > 100 * step("d32f reversed", d));
    }
    // 2 units in the last place of the greatest depths are lost between a written and a read packed depth.
    CHECK(step("packed_rgba8", 100) < 8 * step("d32f", 100));
    CHECK(depth_step(choice_named("d16"), span, 9000) == std::nullopt);
}

TEST_CASE("the precision table has a row for each distance and its file the same numbers") {
    const Folder folder;
    const CommandResult told = run_strata(folder, {"invariance", "--precision", "1:100", "-o", "out"});
    CHECK(told.status == 0);
    const auto rows = lines_of(told.out), csv = lines_of(content_of(folder / "out/precision.csv"));
    REQUIRE(rows.size() == 7);  // 1, 2, 5, 10, 20, 50
    REQUIRE(csv.size() == rows.size());
    CHECK(csv[0] == "distance,d16,d24,d32f,d32f reversed,d24 logarithmic,d32f logarithmic,packed_rgba8,d24 w buffer");
    CHECK(csv[6].starts_with("50,"));
    CHECK(run_strata(folder, {"invariance", "--precision", "5:1"}).err ==
          "strata: --precision: expected two distances such as 0.1:10000, from 1e-12 to 1e12, found '5:1'\n");
    CHECK(run_strata(folder, {"invariance", "teapot", "--precision", "1:5"}).err ==
          "strata: --precision takes neither a scene nor a plan\n");
}
