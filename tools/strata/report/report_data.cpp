// tools/strata/report/report_data.cpp - collects a report's JSON and blobs: fragments, pictures, audits and histories
// of each algorithm, within the limits of a page (report_data.h).
#include "tools/strata/report/report_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "pipeline/device/sample_points.h"
#include "rasterizer/base/input_error.h"
#include "tools/oracle/explain/history_report.h"
#include "tools/request/option_fields.h"
#include "tools/strata/progress.h"
#include "tools/strata/render/stats.h"
#include "tools/strata/report/survey.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

// Limits of a page: the number of its fragments, 30 bytes each of which about 20 remain after packing, and the packed
// bytes of its whole histories.
constexpr std::size_t most_fragments = 150'000, most_history_bytes = std::size_t{5} << 19;
// Limit of lines of histories that are in memory at once, about a kilobyte each.
constexpr std::size_t most_lines = 150'000;

struct Kept {
    std::uint32_t nearest = 0;                  // of every pixel that has at least that many
    std::vector<std::uint32_t> fragments{};     // their indices in the columns
    std::vector<std::uint16_t> count{}, all{};  // per pixel: kept fragments, and all
};

std::size_t number_with(const Columns& columns, std::uint32_t nearest) {
    std::size_t number = 0;
    for (std::size_t pixel = 0; pixel + 1 < columns.first.size(); ++pixel)
        number += std::min(columns.first[pixel + 1] - columns.first[pixel], nearest);
    return number;
}

// Keeps the nearest fragments of every pixel, as many as the limit allows.
Kept keep(const Columns& columns) {
    Kept kept;
    for (std::size_t pixel = 0; pixel + 1 < columns.first.size(); ++pixel)
        kept.nearest = std::max(kept.nearest, columns.first[pixel + 1] - columns.first[pixel]);
    while (kept.nearest > 1 && number_with(columns, kept.nearest) > most_fragments) --kept.nearest;
    for (std::size_t pixel = 0; pixel + 1 < columns.first.size(); ++pixel) {
        const std::uint32_t all = columns.first[pixel + 1] - columns.first[pixel], count = std::min(all, kept.nearest);
        kept.all.push_back(static_cast<std::uint16_t>(std::min<std::uint32_t>(all, 0xffff)));
        kept.count.push_back(static_cast<std::uint16_t>(count));
        for (std::uint32_t f = 0; f < count; ++f) kept.fragments.push_back(columns.first[pixel] + f);
    }
    return kept;
}

template <class Word, class Of>
std::vector<Word> of_kept(const Kept& kept, const Of& of) {
    std::vector<Word> values;
    values.reserve(kept.fragments.size());
    for (const std::uint32_t f : kept.fragments) values.push_back(of(f));
    return values;
}

ordered_json fragments_of(const Columns& columns, const Kept& kept, Blobs& blobs) {
    const auto words = [&](const auto& of) { return blobs.add(of_kept<std::uint32_t>(kept, of)); };
    ordered_json document{
        {"count", blobs.add(kept.count)},
        {"all", blobs.add(kept.all)},
        {"z", words([&](std::uint32_t f) { return std::bit_cast<std::uint32_t>(columns.fragments[f].shader_z); })},
        {"code", words([&](std::uint32_t f) { return columns.fragments[f].code; })},
        {"primitive", words([&](std::uint32_t f) { return columns.fragments[f].primitive; })},
        {"arrival", words([&](std::uint32_t f) { return columns.arrival[f]; })},
        {"color", ordered_json::array()}};
    for (std::size_t c = 0; c < 4; ++c)
        document["color"].push_back(
            words([&](std::uint32_t f) { return std::bit_cast<std::uint32_t>(columns.fragments[f].color[c]); }));
    return document;
}

// So that the page does not depend on how it was made.
PictureRequest with_usual_execution(PictureRequest request) {
    for (const OptionField& field : option_fields())
        if (keeps_bits(field.group)) field.copy(request, {});
    return request;
}

// The names of the meshes that are peeled, each with the index of its first triangle in submission order.
ordered_json meshes_of(const RunOptions& options, const pipeline::DrawList& list) {
    ordered_json meshes = ordered_json::array();
    std::uint64_t first = 0;
    for (const pipeline::Instance& instance : list.instances) {
        const bool is_drawn = options.render.alpha.has_value() ||
                              list.materials[instance.material].alpha_mode == pipeline::AlphaMode::blend;
        if (!is_drawn) continue;
        const pipeline::Mesh& mesh = list.meshes[instance.mesh];
        meshes.push_back({{"name", mesh.name}, {"first", first}});
        first += mesh.indices.size() / 3;
    }
    return meshes;
}

// The pixels of a rectangle of the frame.
pipeline::Image cropped(const pipeline::Image& image, const rasterizer::Rect& region) {
    pipeline::Image part{image.format, region.width(), region.height()};
    for (int y = 0; y < part.height; ++y)
        std::copy_n(image.codes.begin() + static_cast<std::ptrdiff_t>(image.index(region.x0, region.y0 + y)),
                    part.width * part.channels(), part.codes.begin() + static_cast<std::ptrdiff_t>(part.index(0, y)));
    return part;
}

ordered_json picture_of(const pipeline::Image& image, const std::string& digest, Blobs& blobs) {
    return {{"format", pipeline::info(image.format).name},
            {"channels", pipeline::info(image.format).channels},
            {"codes", blobs.add(image.codes)},
            {"digest", digest}};
}

ordered_json algorithm_of(const peeling::Algorithm& algorithm) {
    return {{"name", algorithm.name},       {"summary", algorithm.summary},     {"paper", algorithm.paper},
            {"section", algorithm.section}, {"passes", algorithm.pass_formula}, {"exact", algorithm.exact}};
}

peeling::RenderOptions with_samples_kept(peeling::RenderOptions options) {
    options.keep_samples = true;
    return options;
}

class Builder {
  public:
    Builder(const RunOptions& options, const Session& session, const rasterizer::Rect& region)
        : options_{options},
          session_{session},
          region_{region},
          samples_{options.render.sampling.samples},
          renderer_{session.request(with_samples_kept(options.render))} {
        check_samples();
    }

    ReportData build() {
        ordered_json& document = data_.document;
        document = {
            {"scene", options_.scene},
            {"version", STRATA_VERSION},
            {"profile", session_.profile.name},
            {"width", region_.width()},
            {"height", region_.height()},
            {"origin", {region_.x0, region_.y0}},
            {"frame", {options_.render.width, options_.render.height}},
            {"depth_format", pipeline::info(pipeline::target_format(renderer_.depth_format())).name},
            {"colour", options_.scene_options.color_space == pipeline::ColorSpace::linear ? "linear" : "encoded"},
            {"most_bytes", most_bytes},
            {"left_out", ordered_json::array()},
            {"meshes", meshes_of(options_, session_.scene.list)},
            {"fragments", nullptr},
            {"history", nullptr},
            {"algorithms", ordered_json::array()}};
        if (region_.area() < rasterizer::Rect{0, 0, options_.render.width, options_.render.height}.area())
            leave_out(fmt::format("pixels of the frame outside columns {} to {} and rows {} to {}", region_.x0,
                                  region_.x1 - 1, region_.y0, region_.y1 - 1));
        if (samples_ > 1)
            leave_out(
                fmt::format("fragments and histories of samples 1 to {}: those of pixels are of sample 0, pictures "
                            "and numbers are of all samples",
                            samples_ - 1));
        add_fragments();
        for (std::size_t i = 0; i < options_.algorithms.size(); ++i) {
            show(static_cast<double>(i));
            add(*options_.algorithms[i], static_cast<double>(i));
        }
        if (inspected_ != nullptr) add_history(*inspected_);
        data_.has_run = inspected_ != nullptr;
        return std::move(data_);
    }

  private:
    // Sample 0 stores and loads the same in a frame by itself, unless it loads what others store.
    void check_samples() const {
        if (samples_ == 1) return;
        if (const auto lacking = pipeline::check_multisampling(session_.profile, samples_))
            throw CLI::ValidationError("--samples", lacking->message(session_.profile));
        for (const pipeline::LoadedSample loads : {options_.sampling.loads, options_.sampling.composites})
            if (loads == pipeline::LoadedSample::resolved)
                throw CLI::ValidationError(
                    "a report cannot show --load-sample or --composite-sample resolved; use own or 0");
    }

    // Of sample 0.
    [[nodiscard]] peeling::FrameRequest input() const {
        peeling::FrameRequest input = session_.request(options_.render);
        if (samples_ > 1) pipeline::set_sample(input.options.raster, session_.profile.sample_positions, samples_, 0);
        input.options.sampling = {};
        return input;
    }

    void leave_out(const std::string& message) { data_.document["left_out"].push_back(message); }

    // Collects all fragments with the A-buffer, which every profile can run; depths are exact, in the profile's depth
    // format.
    void add_fragments() {
        frame_ = columns_of(
            renderer_.fragments(*peeling::find_algorithm("a_buffer")).of_sample(0).all,
            static_cast<std::size_t>(options_.render.width) * static_cast<std::size_t>(options_.render.height));
        take_region();
        kept_ = keep(columns_);
        data_.document["fragments"] = fragments_of(columns_, kept_, data_.blobs);
        if (kept_.fragments.size() < columns_.fragments.size())
            leave_out(fmt::format(
                "{} of {} fragments, which lie behind the nearest {} of their pixel: layers and pixels show the "
                "nearest",
                columns_.fragments.size() - kept_.fragments.size(), columns_.fragments.size(), kept_.nearest));
    }

    // Copies the region's fragments, with their indices in the frame.
    void take_region() {
        columns_.first = {0};
        for_region([&](std::size_t pixel) {
            for (std::uint32_t f = frame_.first[pixel]; f < frame_.first[pixel + 1]; ++f) {
                columns_.fragments.push_back(frame_.fragments[f]);
                columns_.arrival.push_back(frame_.arrival[f]);
                in_frame_.push_back(f);
            }
            columns_.first.push_back(static_cast<std::uint32_t>(in_frame_.size()));
        });
    }

    // Calls visit(index of the pixel in the frame) row by row.
    void for_region(const auto& visit) const {
        for (int y = region_.y0; y < region_.y1; ++y)
            for (int x = region_.x0; x < region_.x1; ++x)
                visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(options_.render.width) +
                      static_cast<std::size_t>(x));
    }

    // `position`: how many algorithms are complete; the history at the end counts as one.
    void show(double position) { progress_.show(position / static_cast<double>(options_.algorithms.size() + 1)); }

    void add(const peeling::Algorithm& algorithm, double position) {
        ordered_json entry = algorithm_of(algorithm);
        entry["command"] = canonical_command("render", options_, algorithm);
        const peeling::RenderResult result = renderer_.render(
            algorithm, [&](double share) { show(position + share / 2); });  // the other half is its survey
        if (result.outcome == peeling::Outcome::refused) {
            entry["refusal"] = result.refusal->message(session_.profile);
            data_.document["algorithms"].push_back(std::move(entry));
            return;
        }
        if (inspected_ == nullptr || (algorithm.takes_both_ends && !inspected_->takes_both_ends))
            inspected_ = &algorithm;
        entry["refusal"] = nullptr;
        entry["stats"] = to_row({&algorithm, result, pipeline::digest(result.frame.color), ""},
                                {session_.profile.name, with_usual_execution(options_)});
        entry["stats"].erase("seconds");  // so that the same command writes the same bytes
        entry["picture"] =
            picture_of(cropped(result.frame.color, region_), pipeline::digest(result.frame.color), data_.blobs);
        entry["samples"] = ordered_json::array();  // none of a frame of one
        for (const pipeline::Image& sample : result.frame.samples)
            entry["samples"].push_back(picture_of(cropped(sample, region_), pipeline::digest(sample), data_.blobs));
        if (!algorithm.is_oracle) add_survey(algorithm, entry);
        data_.document["algorithms"].push_back(std::move(entry));
    }

    void add_survey(const peeling::Algorithm& algorithm, ordered_json& entry) {
        const Survey found = survey(input(), algorithm, frame_);
        std::vector<std::uint8_t> killer;
        for_region([&](std::size_t pixel) { killer.push_back(found.killer[pixel]); });
        entry["killer"] = data_.blobs.add(killer);
        entry["taken"] = nullptr;
        if (found.has_taken)
            entry["taken"] = data_.blobs.add(
                of_kept<std::uint16_t>(kept_, [&](std::uint32_t f) { return found.taken[in_frame_[f]]; }));
    }

    // In this function and the following ones x and y are relative to the region.
    [[nodiscard]] std::uint32_t count_at(int x, int y) const {
        const auto pixel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(region_.width()) + static_cast<std::size_t>(x);
        return columns_.first[pixel + 1] - columns_.first[pixel];
    }

    // The bounding rectangle of the pixels that have fragments.
    [[nodiscard]] rasterizer::Rect drawn() const {
        rasterizer::Rect box{region_.width(), region_.height(), 0, 0};
        for (int y = 0; y < region_.height(); ++y)
            for (int x = 0; x < region_.width(); ++x)
                if (count_at(x, y) > 0)
                    box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
        return box;
    }

    [[nodiscard]] std::size_t lines_in(const rasterizer::Rect& box, std::size_t passes) const {
        std::size_t lines = 0;
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = box.x0; x < box.x1; ++x) lines += (count_at(x, y) + 4) * (passes + 1);
        return lines;
    }

    static void shrink(rasterizer::Rect& box) {
        if (box.width() >= box.height()) {
            const int cut = std::max(1, box.width() / 4);
            box.x0 += cut / 2, box.x1 -= cut - cut / 2;
        } else {
            const int cut = std::max(1, box.height() / 4);
            box.y0 += cut / 2, box.y1 -= cut - cut / 2;
        }
    }

    // Adds whole histories for a rectangle in the middle of the pixels with fragments, as large as the limit allows.
    void add_history(const peeling::Algorithm& algorithm) {
        std::size_t passes = 1;
        for (const ordered_json& entry : data_.document["algorithms"])
            if (entry["name"] == algorithm.name) passes = entry["stats"]["geometry_passes"];
        rasterizer::Rect box = drawn();
        while (box.width() > 0 && box.height() > 0 && lines_in(box, passes) > most_lines) shrink(box);
        for (; box.width() > 0 && box.height() > 0; shrink(box))
            if (try_history(algorithm, box)) return;
        leave_out("whole histories of pixels: not one has room, or nothing is drawn");
    }

    bool try_history(const peeling::Algorithm& algorithm, const rasterizer::Rect& box) {
        std::string text;
        std::vector<std::uint32_t> begin;
        const rasterizer::Rect there{box.x0 + region_.x0, box.y0 + region_.y0, box.x1 + region_.x0,
                                     box.y1 + region_.y0};
        for (const oracle::History& history : oracle::explain(input(), algorithm, there)) {
            begin.push_back(static_cast<std::uint32_t>(text.size()));
            if (!history.fragments.empty()) text += oracle::to_text(history);
        }
        begin.push_back(static_cast<std::uint32_t>(text.size()));
        if (packed_size(text) > most_history_bytes) return false;
        data_.document["history"] = {{"algorithm", algorithm.name},
                                     {"box", {box.x0, box.y0, box.x1, box.y1}},
                                     {"begin", data_.blobs.add(begin)},
                                     {"text", data_.blobs.add_text(text)}};
        const rasterizer::Rect all = drawn();
        if (box.width() < all.width() || box.height() < all.height())
            leave_out(fmt::format("whole histories outside columns {} to {} and rows {} to {}", there.x0, there.x1 - 1,
                                  there.y0, there.y1 - 1));
        return true;
    }

    const RunOptions& options_;
    const Session& session_;
    rasterizer::Rect region_;
    int samples_;
    peeling::Renderer renderer_;
    Progress progress_{"report"};
    ReportData data_;
    Columns frame_, columns_;              // of the whole frame; of the region
    std::vector<std::uint32_t> in_frame_;  // index in `frame_` of each fragment of the region
    Kept kept_;
    // Dual if the profile can run it, else the first algorithm that it can run.
    const peeling::Algorithm* inspected_ = nullptr;
};

}  // namespace

ReportData report_data(const RunOptions& options, const Session& session, const rasterizer::Rect& region) {
    return Builder{options, session, region}.build();
}

}  // namespace strata::tools
