// tools/probe/kit.h - the scenes that measure a device: each is made so that a few fields of a profile decide its
// pixels.
//
// Rule     Names are unique. A kit is the same bits on every machine; its digest is that of its JSON.
// Tests    tests/tools/probe/kit_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/probe/item.h"

namespace strata::probe {

// Both orientations draw every item: clip-space +y up in memory as glClipControl(GL_UPPER_LEFT) has it, or down, which
// is what OpenGL without that call does to a framebuffer object.
[[nodiscard]] const std::vector<Item>& kit();

// Scenes that no field was thought of for: random triangles and models through a camera, to test a profile that was
// inferred. `count` of them, from `first` on.
[[nodiscard]] Item unseen_scene(int number);
[[nodiscard]] std::vector<Item> unseen_scenes(int first, int count);

// {"format": "strata-kit", "version": 1, "digest": "...", "items": [...]}: floats as the 8 hexadecimal digits of their
// bits. With operations: their list as "operations", its digest as "operations_digest".
[[nodiscard]] std::string to_json(const std::vector<Item>& items, bool with_operations = false);
// Of the array of items as JSON without a space: a pack names the kit that it answers by it.
[[nodiscard]] std::string digest(const std::vector<Item>& items);

// One HTML page that draws these items by WebGL 2 and offers the answers as an archive; it loads nothing.
[[nodiscard]] std::string page_of(const std::vector<Item>& items, bool with_operations = false);

// How far the triangles reach that tell a guard band, in pixels: each a twenty-fourth further than the one before.
[[nodiscard]] std::vector<int> guard_reaches();

// Parts of the kit (kit_*.cpp).
void add_coverage(std::vector<Item>& items);
void add_positions(std::vector<Item>& items);
void add_depth(std::vector<Item>& items);
void add_clip(std::vector<Item>& items);
void add_colors(std::vector<Item>& items);
void add_blending(std::vector<Item>& items);

}  // namespace strata::probe
