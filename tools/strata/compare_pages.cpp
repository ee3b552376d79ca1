#include "tools/strata/compare_pages.h"

#include <algorithm>
#include <filesystem>

#include "tools/oracle/drawings.h"
#include "tools/oracle/report.h"
#include "tools/strata/messages.h"

namespace strata::tools {

namespace {

std::string file_name(std::string path) {
    while (path.size() > 1 && path.back() == '/') path.pop_back();  // "mine/" is a folder, too
    return std::filesystem::path(path).filename().string();
}

std::string title_of(bool equal, bool accepted) {
    return equal ? "Equal" : accepted ? "Within the tolerance" : "Different";
}

std::string command_of(const ComparedPaths& paths) {
    return "strata compare " + file_name(paths.reference) + " " + file_name(paths.candidate);
}

void add_pictures(PlainPage& page, const ShownPair& shown, const ComparedPaths& paths) {
    page.picture(oracle::as_shown(shown.reference), "The reference, " + file_name(paths.reference) + shown.what);
    page.picture(oracle::as_shown(shown.candidate), "The candidate, " + file_name(paths.candidate) + shown.what);
    add_heat_map(page, shown.comparison);
}

struct Verdict {
    std::string_view words;
    Paint paint;
};
constexpr Verdict verdicts[] = {{"equal", Paint::green},
                                {"right", Paint::green},
                                {"wrong", Paint::red},
                                {"accepted", Paint::yellow},
                                {"within the tolerance", Paint::yellow},
                                {"different", Paint::red}};

// "equal", "different: 3 of 9 pixels differ", "dual: equal".
std::string painted_line(const std::string& line) {
    for (const Verdict& v : verdicts) {
        const std::string words(v.words), painted_words = painted(v.words, v.paint, Stream::output);
        if (line == words || line.starts_with(words + ":")) return painted_words + line.substr(words.size());
        if (line.ends_with(": " + words) && !line.starts_with(' '))
            return line.substr(0, line.size() - words.size()) + painted_words;
    }
    return line;
}

}  // namespace

void add_heat_map(PlainPage& page, const oracle::Comparison& found) {
    page.picture(oracle::heat_map(found),
                 found.equal
                     ? "Where they differ: nowhere, so all of it is black"
                     : "Where they differ: black is equal, a colour is a kind, and the brighter the further apart");
    std::vector<PlainPage::Swatch> kinds;
    for (const oracle::KindReport& kind : found.kinds)
        kinds.push_back({oracle::color_of(kind.kind), std::string(name(kind.kind))});
    if (!kinds.empty()) page.legend(kinds);
}

PlainPage page_of(const ComparedPaths& paths, const oracle::Picture& reference, const oracle::Picture& candidate,
                  const oracle::Comparison& found) {
    PlainPage page{title_of(found.equal, found.accepted), command_of(paths)};
    page.heading("What differs");
    page.lines(oracle::to_text(found));
    page.heading("Pictures");
    add_pictures(page, {reference, candidate, found, ""}, paths);
    return page;
}

std::optional<ShownPair> shown_pair(const std::vector<oracle::PackPictures>& reference,
                                    const std::vector<oracle::PackPictures>& candidate,
                                    const oracle::PackComparison& found) {
    const bool shows_pass = found.first && (!found.picture || found.picture->equal);
    if (!found.is_there || (!found.picture && !shows_pass)) return std::nullopt;
    const auto of = [&](const std::vector<oracle::PackPictures>& all) -> const oracle::Picture& {
        const auto& pictures = *std::ranges::find(all, found.algorithm, &oracle::PackPictures::algorithm);
        if (!shows_pass) return pictures.picture;
        return std::ranges::find(pictures.passes, found.first->number, &oracle::PassPicture::number)->targets;
    };
    if (shows_pass)
        return ShownPair{of(reference), of(candidate), found.first->comparison,
                         ", after pass " + std::to_string(found.first->number)};
    return ShownPair{of(reference), of(candidate), *found.picture, ""};
}

PlainPage page_of(const ComparedPaths& paths, const std::vector<oracle::PackPictures>& reference,
                  const std::vector<oracle::PackPictures>& candidate,
                  const std::vector<oracle::PackComparison>& found) {
    PlainPage page{title_of(std::ranges::all_of(found, &oracle::PackComparison::equal),
                            std::ranges::all_of(found, &oracle::PackComparison::accepted)),
                   command_of(paths)};
    for (const oracle::PackComparison& c : found) {
        page.heading(c.algorithm);
        page.lines(oracle::to_text(std::vector{c}));
        if (const auto shown = shown_pair(reference, candidate, c)) add_pictures(page, *shown, paths);
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
