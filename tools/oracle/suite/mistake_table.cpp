// tools/oracle/suite/mistake_table.cpp - diagnoses every mistake on every scene of the suite, finds mistakes that no
// scene tells apart, and writes the table as a page (mistake_table.h).
#include "tools/oracle/suite/mistake_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

TableAnswer cell_of(const MistakeImages& mistake_images, const Mistake& mistake) {
    const Picture* const picture = mistake_images.picture_of(mistake);
    if (picture == nullptr) return TableAnswer::impossible;
    const Diagnosis diagnosis = mistake_images.diagnose(*picture);
    if (!mistake_images.shows(mistake))
        return diagnosis.conclusion == Conclusion::right ? TableAnswer::hidden : TableAnswer::accused;
    const Finding& first = diagnosis.findings.front();
    if (diagnosis.conclusion != Conclusion::one_mistake) return TableAnswer::wrong;
    if (first.mistakes.front() == &mistake) return TableAnswer::named;
    return std::ranges::find(first.alike, &mistake) != first.alike.end() ? TableAnswer::alike : TableAnswer::wrong;
}

char sign_of(TableAnswer cell) noexcept {
    switch (cell) {
        case TableAnswer::named: return '1';
        case TableAnswer::alike: return '=';
        case TableAnswer::wrong: return '!';
        case TableAnswer::hidden: return '.';
        case TableAnswer::accused: return '?';
        case TableAnswer::impossible: break;
    }
    return ' ';
}

}  // namespace

namespace {

struct DeclaredLookAlikes {
    std::string_view first, second;
    const char* reason;
};
constexpr DeclaredLookAlikes declared[] = {
    {"min_for_max", "add_for_max",
     "Both leave no pixel a range that begins before it ends: from (-1, -1) on, MIN stays there, and every sum of "
     "(-z, z) and (-1, -1) has its near end above its far one. Nothing is ever peeled, and zeros are what MIN and ADD "
     "leave of the colours."},
};

}  // namespace

const char* reason_for(const LookAlikes& pair) {
    for (const DeclaredLookAlikes& d : declared)
        if (d.first == pair.first->name && d.second == pair.second->name) return d.reason;
    return nullptr;
}

bool is_declared_look_alike(const Mistake& mistake) {
    return std::ranges::find(declared, mistake.name, &DeclaredLookAlikes::second) != std::end(declared);
}

TableColumn table_column(const SuiteScene& scene) {
    const OpenScene opened = open(scene);
    const MistakeRenderer mistake_renderer{opened.input(), *opened.algorithm};
    const MistakeImages mistake_images{mistake_renderer};
    TableColumn column{&scene, {}, {}};
    std::vector<const Picture*> different;
    for (const Mistake& mistake : catalogue()) {
        column.cells.push_back(cell_of(mistake_images, mistake));
        std::size_t number = 0;
        if (mistake_images.shows(mistake)) {
            const Picture* const picture = mistake_images.picture_of(mistake);
            const auto same = [&](const Picture* p) { return p->targets[0].codes == picture->targets[0].codes; };
            number = 1 + static_cast<std::size_t>(std::ranges::find_if(different, same) - different.begin());
            if (number > different.size()) different.push_back(picture);
        }
        column.picture.push_back(number);
    }
    return column;
}

std::vector<LookAlikes> look_alikes(const std::vector<TableColumn>& columns) {
    std::vector<LookAlikes> found;
    const auto all = catalogue();
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = a + 1; b < all.size(); ++b)
            if (std::ranges::all_of(columns, [&](const TableColumn& c) { return c.picture[a] == c.picture[b]; }))
                found.push_back({&all[a], &all[b]});
    return found;
}

std::vector<const SuiteScene*> named_in(const std::vector<TableColumn>& columns, std::size_t mistake) {
    std::vector<const SuiteScene*> scenes;
    for (const TableColumn& column : columns)
        if (column.cells[mistake] == TableAnswer::named) scenes.push_back(column.scene);
    return scenes;
}

std::vector<const Mistake*> unnamed(const std::vector<TableColumn>& columns) {
    std::vector<const Mistake*> found;
    const auto all = catalogue();
    for (std::size_t m = 0; m < all.size(); ++m)
        if (named_in(columns, m).empty()) found.push_back(&all[m]);
    return found;
}

namespace {

// The first scene in which a mistake is reported first, and the number of such scenes; for the second of a declared
// pair, the mistake that is reported instead.
std::string first_scene(const std::vector<TableColumn>& columns, std::size_t mistake) {
    const auto scenes = named_in(columns, mistake);
    if (!scenes.empty()) return fmt::format("{} ({} in all)", scenes.front()->name, scenes.size());
    const auto look_alike = std::ranges::find(declared, catalogue()[mistake].name, &DeclaredLookAlikes::second);
    return look_alike == std::end(declared) ? "nowhere" : fmt::format("named as {}, its equal", look_alike->first);
}

// "none", or their names with the mistakes that they are equal to.
std::string unnamed_text(const std::vector<TableColumn>& columns) {
    std::string text;
    for (const Mistake* mistake : unnamed(columns)) {
        const auto look_alike = std::ranges::find(declared, mistake->name, &DeclaredLookAlikes::second);
        text += fmt::format("{}{}", text.empty() ? "" : ", ", mistake->name);
        if (look_alike != std::end(declared))
            text += fmt::format(" (its picture always equals {}'s)", look_alike->first);
    }
    return text.empty() ? "none" : text;
}

bool shows_in(const TableColumn& column, std::size_t mistake) {
    const TableAnswer cell = column.cells[mistake];
    return cell == TableAnswer::named || cell == TableAnswer::alike || cell == TableAnswer::wrong;
}

std::ptrdiff_t number_of(const std::vector<TableColumn>& columns, std::initializer_list<TableAnswer> cells) {
    std::ptrdiff_t number = 0;
    for (const TableColumn& column : columns)
        for (const TableAnswer cell : cells) number += std::ranges::count(column.cells, cell);
    return number;
}

// The results, in three sentences.
std::string findings(const std::vector<TableColumn>& columns) {
    const std::size_t all = catalogue().size();
    std::size_t in_one = 0, most = 0;
    const TableColumn* best = nullptr;
    for (std::size_t m = 0; m < all; ++m)
        in_one += std::ranges::count_if(columns, [&](const TableColumn& c) { return shows_in(c, m); }) == 1 ? 1 : 0;
    for (const TableColumn& column : columns) {
        std::size_t shown = 0;
        for (std::size_t m = 0; m < all; ++m) shown += shows_in(column, m) ? 1 : 0;
        if (best == nullptr || shown > most) best = &column, most = shown;
    }
    const std::ptrdiff_t wrong = number_of(columns, {TableAnswer::wrong, TableAnswer::accused});
    const std::ptrdiff_t diagnoses =
        wrong + number_of(columns, {TableAnswer::named, TableAnswer::alike, TableAnswer::hidden});
    return fmt::format(
        "Of {} mistakes {} are named first in at least one of {} scenes; never named: {}.\n"
        "{} of {} diagnoses name another mistake. Pairs of mistakes with equal pictures of all scenes: {}.\n"
        "The scene {} shows most of them, {}; {} are visible in one scene only, so that no single scene tests a "
        "port.\n",
        all, all - unnamed(columns).size(), columns.size(), unnamed_text(columns), wrong, diagnoses,
        look_alikes(columns).size(), best->scene->name, most, in_one);
}

}  // namespace

std::string to_page(const std::vector<TableColumn>& columns, const std::string& plot) {
    const auto all = catalogue();
    std::string page = "# Mistakes and the scenes that show them\n\n" + findings(columns);
    if (!plot.empty()) page += fmt::format("\n![What each scene of the suite shows of the mistakes]({})\n", plot);
    page +=
        "\n`strata diagnose --list --table` wrote this page: every scene is drawn with every mistake alone, "
        "and the picture is diagnosed as that of an unknown port.\n"
        "1 named first; = the picture of a mistake above it, which is named; . not visible, and the right "
        "emulation is named; blank: not applicable to the scene.\n\n| mistake |";
    for (std::size_t c = 0; c < columns.size(); ++c) page += fmt::format(" {} |", c + 1);
    page += "\n|---|";
    for (std::size_t c = 0; c < columns.size(); ++c) page += "---|";
    for (std::size_t m = 0; m < all.size(); ++m) {
        page += fmt::format("\n| {} |", all[m].name);
        for (const TableColumn& column : columns) page += fmt::format(" {} |", sign_of(column.cells[m]));
    }
    page += "\n\n| scene | | command |\n|---|---|---|\n";
    for (std::size_t c = 0; c < columns.size(); ++c)
        page += fmt::format("| {} {} | {} | `{}` |\n", c + 1, columns[c].scene->name, columns[c].scene->why,
                            command_of(*columns[c].scene));
    for (const LookAlikes& pair : look_alikes(columns))
        if (const char* reason = reason_for(pair))
            page += fmt::format("\n{} and {} have equal pictures of all scenes. {}\n", pair.first->name,
                                pair.second->name, reason);
    page += "\n| mistake | a picture has this mistake if its pixels are those of | named first in |\n|---|---|---|\n";
    for (std::size_t m = 0; m < all.size(); ++m)
        page += fmt::format("| {} | {} | {} |\n", all[m].name, all[m].description, first_scene(columns, m));
    return page;
}

}  // namespace strata::oracle
