#include "scenes/images/orientation.h"

#include <utility>

namespace strata::scenes::images {

void turn_upright(FileCodes& stored, int orientation) {
    if (orientation < 2 || orientation > 8) return;
    const bool is_transposed = orientation >= 5;  // the first row is the left or the right side
    const bool is_first_row_last = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    const bool is_first_column_last = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    FileCodes upright = stored;
    if (is_transposed) std::swap(upright.width, upright.height);
    upright.codes.clear();
    for (int y = 0; y < upright.height; ++y)
        for (int x = 0; x < upright.width; ++x) {
            int row = is_transposed ? x : y, column = is_transposed ? y : x;
            if (is_first_row_last) row = stored.height - 1 - row;
            if (is_first_column_last) column = stored.width - 1 - column;
            const auto first = stored.codes.begin() + (std::ptrdiff_t{row} * stored.width + column) * stored.channels;
            upright.codes.insert(upright.codes.end(), first, first + stored.channels);
        }
    stored = std::move(upright);
}

}  // namespace strata::scenes::images
