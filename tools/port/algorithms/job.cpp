// tools/port/algorithms/job.cpp - the list of algorithms that the OpenGL port (tools/port) draws, by the names of the
// command line, and what a job, one frame of one algorithm, records of its passes (job.h).
#include "tools/port/algorithms/job.h"

#include <algorithm>
#include <stdexcept>

namespace strata::port {

namespace {

// A name and the function that makes its job.
struct Maker {
    std::string name;
    Job (*make)(const JobInput&);
};

const std::vector<Maker>& makers() {
    static const std::vector<Maker> all{{"depth", depth_job},
                                        {"front_to_back", front_to_back_job},
                                        {"dual", dual_job},
                                        {"weighted_average", weighted_average_job},
                                        {"weighted_average_pow", weighted_average_pow_job},
                                        {"coherent_stencil", coherent_stencil_job},
                                        {"depth_units", depth_units_job},
                                        {"weighted_blended", weighted_blended_job},
                                        {"moments", moments_job},
                                        {"moments_log", moments_log_job},
                                        {"linked_list", linked_list_job},
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

Job make_job(const std::string& name, const JobInput& input) {
    const auto found = std::ranges::find(makers(), name, &Maker::name);
    if (found == makers().end()) throw std::invalid_argument("no algorithm " + name);
    JobInput chosen = input;
    if (input.settings.depth != nullptr) chosen.formats.depth = *input.settings.depth;
    return found->make(chosen);
}

namespace {

bool shows_all_samples() { return samples_per_pixel() > 1 && samples_shown() < 0; }

}  // namespace

// Layers are kept of one sample: those of several would have to be resolved.
bool keeps_layers(const Record* record) { return record != nullptr && !shows_all_samples(); }

void show_pass(Record* record, FrameSize size, const std::string& kind, std::initializer_list<NamedTexture> targets,
               std::optional<std::uint64_t> query) {
    if (record == nullptr) return;
    RecordedPass& shown = record->passes.emplace_back(RecordedPass{kind, {}, query});
    for (const NamedTexture& target : targets)
        shown.targets.push_back({target.name, shows_all_samples() ? read_samples(target.texture, target.format, size)
                                                                  : read_back(target.texture, target.format, size)});
}

}  // namespace strata::port
