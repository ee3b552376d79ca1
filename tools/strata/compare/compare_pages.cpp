// tools/strata/compare/compare_pages.cpp - builds the page of compare --report and paints the verdict's first line
// (compare_pages.h).
#include "tools/strata/compare/compare_pages.h"

#include <algorithm>
#include <filesystem>

#include "tools/oracle/compare/drawings.h"
#include "tools/oracle/compare/report.h"
#include "tools/strata/messages.h"

namespace strata::tools {

namespace {

std::string file_name(std::string path) {
    while (path.size() > 1 && path.back() == '/') path.pop_back();  // "mine/" also names a folder
    return std::filesystem::path(path).filename().string();
}

std::string title_of(bool equal, bool accepted) {
    return equal ? "Equal" : accepted ? "Within the tolerance" : "Different";
}

std::string command_of(const ComparedPaths& paths) {
    return "strata compare " + file_name(paths.reference) + " " + file_name(paths.candidate);
}

void add_pictures(PlainPage& page, const ShownPair& shown, const ComparedPaths& paths) {
    page.begin_pictures();
    page.picture(oracle::as_shown(shown.reference, shown.target),
                 "The reference, " + file_name(paths.reference) + shown.what);
    page.picture(oracle::as_shown(shown.candidate, shown.target),
                 "The candidate, " + file_name(paths.candidate) + shown.what);
    add_heat_map(page, shown.comparison);
    page.end_pictures();
}

std::string count_of(const oracle::Comparison& found) {
    if (found.equal) return "equal in every bit.";
    std::uint32_t greatest = 0;
    for (const oracle::TargetReport& target : found.targets) greatest = std::max(greatest, target.greatest);
    const auto pixels = static_cast<std::uint64_t>(found.width) * static_cast<std::uint64_t>(found.height);
    return std::to_string(found.differing) + " of " + std::to_string(pixels) + " pixels differ, by at most " +
           std::to_string(greatest) + " code" + (greatest == 1 ? "" : "s") +
           (found.accepted ? ", which the tolerance allows." : ".");
}

// Adds one sentence each for the picture, the layers and the passes of an algorithm. The tables show the differences
// within a picture.
void add_findings(PlainPage& page, const oracle::PackComparison& c) {
    if (!c.is_there) return page.paragraph("Not compared: the candidate has nothing of it.");
    std::vector<std::string> messages;
    if (c.picture) messages.push_back("Picture: " + count_of(*c.picture));
    if (c.layers) messages.push_back("Layers: " + count_of(*c.layers));
    if (c.first)
        messages.push_back("Passes: the first that differs is " + std::to_string(c.first->number) + ", a " +
                           c.first->kind + " pass of iteration " + std::to_string(c.first->iteration) + ".");
    else if (!c.passes.empty())
        messages.push_back("Passes: all " + std::to_string(c.passes.size()) + " are " +
                           (c.equal ? "equal." : "alike within the tolerance."));
    for (const std::string& what : c.missing) messages.push_back("The candidate has no " + what + ".");
    page.items(messages);
}

// "1 of 2 algorithms come out as the pack has them; 3 are not compared."
std::string description_of(const std::vector<oracle::PackComparison>& found) {
    const auto compared = std::ranges::count_if(found, &oracle::PackComparison::is_there);
    const auto right =
        std::ranges::count_if(found, [](const oracle::PackComparison& c) { return c.is_there && c.accepted; });
    const auto left_out = static_cast<std::ptrdiff_t>(found.size()) - compared;
    return std::to_string(right) + " of " + std::to_string(compared) +
           (compared == 1 ? " algorithm comes out as the pack has it" : " algorithms come out as the pack has them") +
           (left_out > 0 ? "; " + std::to_string(left_out) + (left_out == 1 ? " is" : " are") + " not compared." : ".");
}

struct ComparisonVerdict {
    std::string_view words;
    Paint paint;
};
constexpr ComparisonVerdict verdicts[] = {{"equal", Paint::green},
                                          {"right", Paint::green},
                                          {"wrong", Paint::red},
                                          {"accepted", Paint::yellow},
                                          {"within the tolerance", Paint::yellow},
                                          {"different", Paint::red}};

// "equal", "different: 3 of 9 pixels differ", "dual: equal".
std::string painted_line(const std::string& line) {
    for (const ComparisonVerdict& v : verdicts) {
        const std::string words(v.words), painted_words = painted(v.words, v.paint, Stream::output);
        if (line == words || line.starts_with(words + ":")) return painted_words + line.substr(words.size());
        if (line.ends_with(": " + words) && !line.starts_with(' '))
            return line.substr(0, line.size() - words.size()) + painted_words;
    }
    return line;
}

}  // namespace

void add_heat_scale(PlainPage& page, const oracle::Comparison& found) {
    if (found.kinds.empty()) return;
    const oracle::HeatScale scale = oracle::heat_scale(found);
    std::vector<PlainPage::Mark> marks;
    for (const std::uint32_t distance : scale.marks())
        marks.push_back({scale.position(distance), std::to_string(distance) + (distance == 1 ? " code" : "")});
    page.scale(oracle::HeatScale::stops(), marks);
}

void add_heat_map(PlainPage& page, const oracle::Comparison& found) {
    page.picture(oracle::heat_map(found),
                 found.equal ? "How far apart: nowhere, so all of it is black"
                             : "How far apart each pixel is, in codes of the reference's format: black is equal");
    if (found.kinds.empty()) return page.beside_pictures();
    page.picture(oracle::kind_map(found), "Which kind of difference is where: black is equal");
    page.beside_pictures();
    add_heat_scale(page, found);
    std::vector<PlainPage::Swatch> kinds;
    for (const oracle::KindReport& kind : found.kinds)
        kinds.push_back({oracle::color_of(kind.kind), std::string(name(kind.kind))});
    page.legend(kinds);
}

void add_tables(PlainPage& page, const oracle::Comparison& found) {
    Table targets{{{"target"}, {"reference"}, {"candidate"}, {"pixels that differ"}, {"at most, codes"}}, {}};
    for (const oracle::TargetReport& t : found.targets)
        targets.rows.push_back({t.part.empty() ? t.name : t.part + " " + t.name, std::string(oracle::name(t.reference)),
                                std::string(oracle::name(t.candidate)), std::to_string(t.differing),
                                std::to_string(t.greatest)});
    page.table(targets, "Each target that both pictures have");
    if (!found.kinds.empty()) {
        Table kinds{{{"kind"}, {"pixels"}, {"beyond the tolerance"}, {"first at"}, {"what is seen of it"}}, {}};
        for (const oracle::KindReport& k : found.kinds)
            kinds.rows.push_back({std::string(name(k.kind)), std::to_string(k.pixels), std::to_string(k.beyond),
                                  std::to_string(k.first_x) + "," + std::to_string(k.first_y),
                                  k.detail.empty() ? "-" : k.detail});
        page.table(kinds, "Kinds of differences");
    }
    if (!found.explanations.empty()) {
        Table known{{{"known mistake"},
                     {"differing pixels that it explains"},
                     {"of"},
                     {"equal pixels against it"},
                     {"they are those of"}},
                    {}};
        for (const oracle::Explanation& e : found.explanations)
            known.rows.push_back({std::string(e.mistake), std::to_string(e.explained), std::to_string(e.of),
                                  std::to_string(e.contradicted), std::string(e.description)});
        page.table(known, "Known mistakes whose picture is near");
    }
    std::vector<std::string> left_out;
    for (const std::string& what : found.not_compared) left_out.push_back("Not compared: " + what);
    page.items(left_out);
}

std::string description_of(const oracle::Comparison& found) {
    return found.equal ? "The pictures are equal in every bit." : count_of(found);
}

PlainPage page_of(const ComparedPaths& paths, const oracle::Picture& reference, const oracle::Picture& candidate,
                  const oracle::Comparison& found) {
    PlainPage page{title_of(found.equal, found.accepted), command_of(paths)};
    page.lead(description_of(found));
    add_pictures(page, {reference, candidate, found, "", ""}, paths);
    page.heading("What differs");
    add_tables(page, found);
    return page;
}

namespace {

const oracle::PackPictures& of_algorithm(const std::vector<oracle::PackPictures>& all, const std::string& algorithm) {
    return *std::ranges::find(all, algorithm, &oracle::PackPictures::algorithm);
}

// The first pass that differs.
std::optional<ShownPair> pass_pair(const std::vector<oracle::PackPictures>& reference,
                                   const std::vector<oracle::PackPictures>& candidate,
                                   const oracle::PackComparison& found) {
    if (!found.is_there || !found.first) return std::nullopt;
    const auto of = [&](const std::vector<oracle::PackPictures>& all) -> const oracle::Picture& {
        const auto& passes = of_algorithm(all, found.algorithm).passes;
        return std::ranges::find(passes, found.first->number, &oracle::PassPicture::number)->targets;
    };
    const auto& targets = found.first->comparison.targets;
    const auto wrong =
        std::ranges::find_if(targets, [](const oracle::TargetReport& target) { return target.differing > 0; });
    const std::string target = wrong == targets.end() ? "" : wrong->name;
    return ShownPair{
        of(reference), of(candidate), found.first->comparison,
        (target.empty() ? "" : ", target " + target) + ", after pass " + std::to_string(found.first->number), target};
}

// Every target of every pass that differs.
void add_passes(PlainPage& page, const oracle::PackComparison& c) {
    Table table{{{"pass"}, {"kind"}, {"target"}, {"pixels that differ"}, {"at most, codes"}}, {}};
    for (const oracle::ComparedPass& pass : c.passes)
        for (const oracle::TargetReport& target : pass.targets)
            if (target.differing > 0)
                table.rows.push_back({std::to_string(pass.number), pass.kind, target.name,
                                      std::to_string(target.differing), std::to_string(target.greatest)});
    if (!table.rows.empty()) page.table(table, "The targets that differ, pass by pass");
}

}  // namespace

std::optional<ShownPair> shown_pair(const std::vector<oracle::PackPictures>& reference,
                                    const std::vector<oracle::PackPictures>& candidate,
                                    const oracle::PackComparison& found) {
    if (found.first && (!found.picture || found.picture->equal)) return pass_pair(reference, candidate, found);
    if (!found.is_there || !found.picture) return std::nullopt;
    return ShownPair{of_algorithm(reference, found.algorithm).picture, of_algorithm(candidate, found.algorithm).picture,
                     *found.picture, "", ""};
}

PlainPage page_of(const ComparedPaths& paths, const std::vector<oracle::PackPictures>& reference,
                  const std::vector<oracle::PackPictures>& candidate,
                  const std::vector<oracle::PackComparison>& found) {
    PlainPage page{title_of(std::ranges::all_of(found, &oracle::PackComparison::equal),
                            std::ranges::all_of(found, &oracle::PackComparison::accepted)),
                   command_of(paths)};
    page.lead(description_of(found));
    for (const oracle::PackComparison& c : found) {
        page.heading(c.algorithm);
        add_findings(page, c);
        if (const auto shown = shown_pair(reference, candidate, c)) {
            add_pictures(page, *shown, paths);
            if (!shown->comparison.equal) add_tables(page, shown->comparison);
        }
        add_passes(page, c);
        const bool has_shown_pass = !c.picture || c.picture->equal;
        if (const auto pass = pass_pair(reference, candidate, c); pass && !has_shown_pass)
            add_pictures(page, *pass, paths);
    }
    return page;
}

std::string with_painted_verdicts(const std::string& text) {
    std::string all;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        all += painted_line(text.substr(begin, end - begin));
        if (end < text.size()) all += '\n';
        begin = end + 1;
    }
    return all;
}

}  // namespace strata::tools
