// tools/oracle/folders/compare_folders.cpp - decides each name of two folders, several at a time (compare_folders.h).
#include "tools/oracle/folders/compare_folders.h"

#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <filesystem>
#include <numeric>

#include "rasterizer/base/input_error.h"
#include "rasterizer/base/parallel.h"
#include "tools/oracle/compare/report.h"
#include "tools/oracle/folders/case_pictures.h"

namespace strata::oracle {

namespace {

// So many names are compared before the first of them is taken.
constexpr std::size_t names_at_a_time = 16;

std::string path_in(const std::string& folder, const std::string& path) {
    return (std::filesystem::path(folder) / path).string();
}

// Leaves out what is kept of every pixel and of every distance.
void trim(Comparison& found) {
    found.kind_of.clear();
    found.distance_of.clear();
    found.is_beyond.clear();
    for (TargetReport& target : found.targets) target.distances.clear();
}

std::string sentence_of(const Comparison& found) {
    if (found.equal) return "";
    const auto pixels = static_cast<std::uint64_t>(found.width) * static_cast<std::uint64_t>(found.height);
    const std::uint32_t greatest = found.greatest();
    std::string text = fmt::format("{} of {} pixels differ", found.differing, pixels);
    if (greatest > 0) text += fmt::format(" by at most {} code{}", greatest, greatest == 1 ? "" : "s");
    for (const TargetReport& target : found.targets)
        if (target.rmse && target.part.empty()) text += "; " + noise_of(target);
    for (const TargetReport& target : found.targets)
        if (const std::string numbers = not_finite_of(target); !numbers.empty()) text += "; " + numbers;
    for (const KindReport& kind : found.kinds)
        if (found.accepted || kind.beyond > 0)
            text += fmt::format("; {}: {}", name(kind.kind),
                                found.accepted ? fmt::format("{} pixels", kind.pixels) : failure_of(kind));
    if (!found.explanations.empty() && found.explanations[0].is_whole())
        text += fmt::format("; all of them are those of {}", found.explanations[0].description);
    return text;
}

// A picture, or the sentence that says why there is none.
struct ReadPicture {
    std::optional<Picture> picture{};
    std::string failure{};
};

// Sentences name the picture by what it is: its path may be one of this machine.
constexpr const char *the_reference = "the reference", *the_candidate = "the candidate";

ReadPicture read(const std::function<Picture(const std::string&)>& reader, const std::string& path, const char* whose) {
    try {
        ReadPicture found{.picture = reader(path)};
        found.picture->file = whose;
        return found;
    } catch (const InputError& error) {
        const std::string message = error.what();
        return {.failure = message.starts_with(path) ? whose + message.substr(path.size()) : message};
    }
}

// The result of one reference; of two, the one that says more for the candidate counts.
struct ReferenceResult {
    CaseState state = CaseState::unreadable;
    std::string sentence{};
    std::optional<Comparison> comparison{};
    std::vector<CasePicture> pictures{};

    [[nodiscard]] std::uint64_t rank() const noexcept {
        constexpr std::uint64_t most = ~std::uint64_t{0};
        switch (state) {
            case CaseState::equal: return 0;
            case CaseState::accepted: return 1;
            case CaseState::different: return 2 + comparison->differing;
            case CaseState::other_size: return most - 1;
            default: return most;
        }
    }
};

bool has_other_size(const Picture& reference, const Picture& candidate) {
    const TargetImage &a = reference.targets.at(0), &b = candidate.targets.at(0);
    return a.width != b.width || a.height != b.height;
}

ReferenceResult compare_with(const FolderQuestion& question, const Picture& reference, const Picture& candidate) {
    try {
        Comparison found = compare(reference, candidate, question.tolerances, question.background);
        ReferenceResult result{.state = found.equal      ? CaseState::equal
                                        : found.accepted ? CaseState::accepted
                                                         : CaseState::different};
        result.sentence = sentence_of(found);
        if (question.has_pictures && !found.accepted) result.pictures = case_pictures(reference, candidate, found);
        trim(found);
        result.comparison = std::move(found);
        return result;
    } catch (const InputError& error) {
        const bool is_size = has_other_size(reference, candidate);
        const std::string before_size = std::string(the_candidate) + ": size: ";
        ReferenceResult result{.state = is_size ? CaseState::other_size : CaseState::unreadable,
                               .sentence = error.what()};
        if (result.sentence.starts_with(before_size)) result.sentence.erase(0, before_size.size());
        if (question.has_pictures) result.pictures = case_pictures(reference, candidate);
        return result;
    }
}

FolderCase decide(const FolderQuestion& question, const NamedPictures& named) {
    FolderCase decided{.name = named.name, .candidate = named.candidate, .references = named.references.size()};
    if (!named.references.empty()) decided.reference = named.references[0];
    if (named.references.empty() || named.candidate.empty()) {
        const bool is_extra = named.references.empty();
        decided.state = is_extra ? CaseState::extra : CaseState::missing;
        decided.sentence = is_extra ? "the reference's folder has no picture of this name"
                                    : "the candidate's folder has no picture of this name";
        return decided;
    }
    const ReadPicture candidate =
        read(question.read_candidate, path_in(question.candidate, named.candidate), the_candidate);
    std::optional<ReferenceResult> best;
    for (const std::string& path : named.references) {
        const ReadPicture reference = read(question.read_reference, path_in(question.reference, path), the_reference);
        ReferenceResult found{.sentence = candidate.picture ? reference.failure : candidate.failure};
        if (candidate.picture && reference.picture)
            found = compare_with(question, *reference.picture, *candidate.picture);
        if (best && found.rank() >= best->rank()) continue;
        best = std::move(found);
        decided.reference = path;
        if (best->state == CaseState::equal) break;
    }
    decided.state = best->state;
    decided.sentence = std::move(best->sentence);
    decided.comparison = std::move(best->comparison);
    decided.pictures = std::move(best->pictures);
    return decided;
}

}  // namespace

std::string_view name(CaseState state) noexcept {
    switch (state) {
        case CaseState::equal: return "equal";
        case CaseState::accepted: return "accepted";
        case CaseState::different: return "different";
        case CaseState::other_size: return "other size";
        case CaseState::missing: return "missing";
        case CaseState::extra: return "extra";
        case CaseState::unreadable: break;
    }
    return "unreadable";
}

std::size_t FolderSummary::all() const noexcept { return std::accumulate(cases.begin(), cases.end(), std::size_t{0}); }

FolderSummary compare_folders(const FolderQuestion& question, const std::function<void(FolderCase&&)>& take) {
    const PairedFolders paired = pair_folders(question.reference, question.candidate, question.names);
    FolderSummary summary{.left_out = paired.left_out};
    const std::size_t count = paired.pictures.size();
    std::atomic<std::size_t> done = 0;
    for (std::size_t first = 0; first < count; first += names_at_a_time) {
        std::vector<FolderCase> decided(std::min(names_at_a_time, count - first));
        parallel_for(decided.size(), 0, [&](std::size_t i) {
            decided[i] = decide(question, paired.pictures[first + i]);
            if (question.progress) question.progress(static_cast<double>(++done) / static_cast<double>(count));
        });
        for (FolderCase& one : decided) {
            ++summary.cases[static_cast<std::size_t>(one.state)];
            take(std::move(one));
        }
    }
    return summary;
}

}  // namespace strata::oracle
