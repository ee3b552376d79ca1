// tools/oracle/suite/mistake_table.cpp - renders a scene of the suite with each mistake, diagnoses the picture, and
// numbers the different pictures (mistake_table.h).
#include "tools/oracle/suite/mistake_table.h"

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

}  // namespace

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

const char* reason_for(const LookAlikes& pair) {
    if (pair.first->name != "min_for_max" || pair.second->name != "add_for_max") return nullptr;
    return "Both leave no pixel a range that begins before it ends: from (-1, -1) on, MIN stays there, and every sum "
           "of "
           "(-z, z) and (-1, -1) has its near end above its far one. Nothing is ever peeled, and zeros are what MIN "
           "and "
           "ADD leave of the colours.";
}

}  // namespace strata::oracle
