// Reference image of the scene in panes.h: the painter's algorithm on the geforce8 profile. Used by panes_test.cpp and
// reference.cpp.
#pragma once
#include <strata/strata.h>

#include "panes.h"

inline strata::Rendering reference_panes() {
    strata::Scene scene;
    for (const Pane& pane : panes) scene.add({.positions = {pane.corners, 3}, .color = std::to_array(pane.color)});
    return strata::render(scene, strata::algorithm("painter"), strata::profile("geforce8"),
                          {.width = width, .height = height});
}
