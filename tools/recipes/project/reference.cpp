#include <strata/scenes/files/image_io.h>

#include "wanted.h"

int main(int count, char** words) {
    if (count != 2) return 2;
    strata::scenes::write_image(words[1], {.color = reference_panes().color()});
}
