// Infers random profiles from their answers: probe_round_trips [first=0] [count=200] [unseen=100]. Prints a line per
// profile with the fields that differ, true and found value; exits with status 1 if an inferred profile draws one of 20
// unseen scenes, starting at number `unseen`, differently.
#include "rasterizer/base/numerics.h"
#include "tests/tools/lab/probe/round_trip.h"

using namespace strata::probe;

int main(int argc, char** argv) {
    const int first = setting(argc, argv, "first", 0), count = setting(argc, argv, "count", 200);
    const std::vector<Item> unseen = unseen_scenes(setting(argc, argv, "unseen", 100), 20);
    int equal = 0, whole = 0;
    for (int i = first; i < first + count; ++i) {
        const RoundTrip trip = round_trip(random_profile(i), unseen, i % 2 == 0 ? YDirection::up : YDirection::down);
        const Difference& d = trip.unseen;
        equal += trip.is_equal() ? 1 : 0;
        whole += trip.found.tally.equal == trip.found.tally.all ? 1 : 0;
        fmt::print(
            "{} {}: kit {} of {}, unseen {} of {} differ (coverage {}, depth {}, colour {}), refused by one {}; "
            "open: {}:{}\n",
            i, trip.is_equal() ? "equal" : "OTHER", trip.found.tally.all - trip.found.tally.equal, trip.found.tally.all,
            d.coverage + d.depth + d.color, d.pixels, d.coverage, d.depth, d.color, trip.refused_by_one,
            fmt::join(trip.open_but_visible, " "), other_values_of(trip));
        std::fflush(stdout);
    }
    fmt::print("{} of {} profiles come back with every pixel of 20 unseen scenes; {} with every pixel of the kit\n",
               equal, count, whole);
    return equal == count ? 0 : 1;
}
