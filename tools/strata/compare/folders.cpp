// tools/strata/compare/folders.cpp - runs compare on two folders of pictures and writes what it found (folders.h).
#include "tools/strata/compare/folders.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "tools/oracle/compare/report_json.h"
#include "tools/oracle/folders/folders_report.h"
#include "tools/strata/compare/compare_pages.h"
#include "tools/strata/compare/tolerances.h"
#include "tools/strata/options/option.h"
#include "tools/strata/progress.h"
#include "tools/strata/report/plain_page.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using oracle::FolderCase;

// Collects the page while cases arrive: what failed with pictures, then a table of all.
class FolderPage {
  public:
    void add(const FolderCase& one) {
        if (table_.rows.size() < most_rows)
            table_.rows.push_back(row_of(one));
        else
            ++rows_left_out_;
        if (one.is_accepted()) return;
        std::size_t characters = 0;
        for (const oracle::CasePicture& picture : one.pictures) characters += picture.png.size() / 3 * 4;
        if (left_out_ > 0 || failed_.size() == most_cases || characters_ + characters > most_characters) {
            ++left_out_;
            return;
        }
        characters_ += characters;
        failed_.push_back(one);
    }

    [[nodiscard]] PlainPage page(const std::string& command, const oracle::FolderSummary& summary) const {
        PlainPage page{summary.failed() > 0                          ? "Different"
                       : summary.of(oracle::CaseState::accepted) > 0 ? "Within the tolerance"
                                                                     : "Equal",
                       command};
        page.lead(oracle::counts_of(summary) + ".");
        for (const FolderCase& one : failed_) {
            page.heading(one.name);
            page.paragraph(oracle::words_of(one));
            if (one.pictures.empty()) continue;
            page.begin_row();
            for (const oracle::CasePicture& picture : one.pictures) page.png_picture(picture.png, picture.words);
            page.end_row();
        }
        if (left_out_ > 0)
            page.paragraph(std::to_string(left_out_) +
                           " more failed cases are shown in the table alone, to keep this page small.");
        page.heading("All pictures");
        page.table(table_, "A heading sorts its column");
        if (rows_left_out_ > 0) page.paragraph(std::to_string(rows_left_out_) + " more pictures have no row here.");
        return page;
    }

  private:
    static constexpr std::size_t most_characters = 4'000'000, most_cases = 100, most_rows = 5000;

    static std::vector<std::string> row_of(const FolderCase& one) {
        std::vector<std::string> row{one.name, std::string(name(one.state)),
                                     one.reference.empty() ? "-" : one.reference};
        if (!one.comparison) {
            row.insert(row.end(), {"-", "-", one.sentence});
            return row;
        }
        row.insert(row.end(), {std::to_string(one.comparison->differing), std::to_string(one.comparison->greatest()),
                               one.sentence.empty() ? "-" : one.sentence});
        return row;
    }

    std::vector<FolderCase> failed_;
    Table table_{{{"name"}, {"result"}, {"reference"}, {"pixels that differ"}, {"at most, codes"}, {"sentence"}}, {}};
    std::size_t characters_ = 0, left_out_ = 0, rows_left_out_ = 0;
};

std::string folder_name(std::string path) {
    while (path.size() > 1 && path.back() == '/') path.pop_back();
    return std::filesystem::path(path).filename().string();
}

}  // namespace

void add_folder_options(CLI::App& app, oracle::PictureNames& names) {
    add_option(app, names,
               {"--names", "PATTERN[,PATTERN]",
                "of two folders: which files are pictures and what their names are, in both, or in the reference's and "
                "the candidate's, as '{name}-expected.png,{name}-actual.png' (default: the path with its ending)",
                "one or two patterns with {name} such as '{name}-expected.png,{name}-actual.png'"},
               [baselines = &names.baselines](std::string_view text) -> std::optional<oracle::PictureNames> {
                   const auto found = oracle::name_patterns(text);
                   if (!found || found->size() > 2) return std::nullopt;
                   return oracle::PictureNames{found->front(), found->back(), *baselines};
               });
    add_option(app, names.baselines,
               {"--baselines", "PATTERN[,PATTERN...]",
                "of two folders: further references of a name, of which the candidate has to fit one, as "
                "'{name}@*.png' for menu@mac.png",
                "patterns with {name} such as '{name}@*.png'"},
               oracle::name_patterns);
}

bool is_folder(const std::string& path) {
    std::error_code unreadable;
    return std::filesystem::is_directory(path, unreadable);
}

bool are_folders(const std::string& reference, const std::string& candidate) {
    const bool is_first = is_folder(reference), is_second = is_folder(candidate);
    std::error_code unreadable;
    if (is_first && !is_second) {
        if (!std::filesystem::exists(candidate, unreadable)) throw InputError(candidate, "no such folder");
        throw InputError(candidate, "type", "a folder, as the reference is", "a file");
    }
    if (is_second && !is_first && std::filesystem::exists(reference, unreadable))
        throw InputError(candidate, "type", "a picture, as the reference is", "a folder");
    return is_first && is_second;
}

int compare_two_folders(oracle::FolderQuestion question, const FolderOutputs& outputs) {
    question.has_pictures = !outputs.report.empty();
    FolderPage page;
    std::vector<oracle::JunitCase> cases;
    nlohmann::ordered_json documents = nlohmann::ordered_json::array();
    std::string lines;
    Progress bar("pictures", Remaining::shown);
    question.progress = [&](double share) { bar.show(share); };
    std::set<std::string> targets;
    const oracle::FolderSummary summary = oracle::compare_folders(question, [&](FolderCase&& one) {
        if (one.comparison)
            for (const oracle::TargetReport& target : one.comparison->targets) targets.insert(target.name);
        cases.push_back(oracle::junit_case(one));
        if (outputs.json)
            documents.push_back(oracle::json_of(one));
        else
            lines += oracle::line_of(one) + '\n';
        if (question.has_pictures) page.add(one);
    });
    check_targets(question.tolerances, {targets.begin(), targets.end()});
    if (!outputs.junit.empty()) scenes::write_file(outputs.junit, oracle::to_junit(cases));
    write_page(outputs.report,
               page.page("strata compare " + folder_name(question.reference) + " " + folder_name(question.candidate),
                         summary));
    print(outputs.json ? oracle::text_of(oracle::json_of(summary, std::move(documents)))
                       : with_painted_verdicts(oracle::first_line(summary) + '\n' + lines));
    return summary.failed() == 0 ? 0 : 1;
}

}  // namespace strata::tools
