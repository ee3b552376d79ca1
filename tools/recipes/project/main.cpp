#include <fstream>

#include "panes.h"

int main(int count, char** words) {
    if (count != 2) return 2;
    const auto pixels = draw_panes();
    std::ofstream file{words[1], std::ios::binary};
    file.write(reinterpret_cast<const char*>(pixels.data()), static_cast<std::streamsize>(pixels.size()));
    return file ? 0 : 1;
}
