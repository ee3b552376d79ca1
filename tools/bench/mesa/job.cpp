#include "tools/bench/mesa/job.h"

#include <algorithm>
#include <stdexcept>

namespace strata::mesa {

namespace {

// A name and the function that makes its job.
struct Maker {
    std::string name;
    Job (*make)(const GpuScene&, Size, const TargetFormats&);
};

const std::vector<Maker>& makers() {
    static const std::vector<Maker> all{{"depth", depth_job},
                                        {"front_to_back", front_to_back_job},
                                        {"dual", dual_job},
                                        {"weighted_average", weighted_average_job},
                                        {"sums", sums_job}};
    return all;
}

}  // namespace

const std::vector<std::string>& job_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Maker& maker : makers()) all.push_back(maker.name);
        return all;
    }();
    return names;
}

Job make_job(const std::string& name, const GpuScene& scene, Size size, const TargetFormats& formats) {
    const auto found = std::ranges::find(makers(), name, &Maker::name);
    if (found == makers().end()) throw std::invalid_argument("no algorithm " + name);
    return found->make(scene, size, formats);
}

}  // namespace strata::mesa
