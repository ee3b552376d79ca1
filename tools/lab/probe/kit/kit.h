// tools/lab/probe/kit/kit.h - the scenes that measure a device: each is constructed so that a few fields of a profile
// determine its pixels.
//
// Rule     Names are unique. A kit is the same bits on every machine; its digest is that of its JSON.
// Tests    tests/tools/lab/probe/kit_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/lab/probe/kit/item.h"

namespace strata::probe {

// Both orientations draw every item: with clip-space +y up in memory as with glClipControl(GL_UPPER_LEFT), or down, as
// OpenGL draws into a framebuffer object without that call.
[[nodiscard]] const std::vector<Item>& kit();

// Scenes that are not designed for any field: random triangles and models through a camera, to test an inferred
// profile. unseen_scenes: `count` of them, starting with number `first`.
[[nodiscard]] Item unseen_scene(int number);
[[nodiscard]] std::vector<Item> unseen_scenes(int first, int count);

// {"format": "strata-kit", "version": 1, "digest": "...", "items": [...]}: floats are the 8 hexadecimal digits of their
// bits.
[[nodiscard]] std::string to_json(const std::vector<Item>& items);
// Digest of the array of items as JSON without spaces, by which a pack identifies the kit that it answers.
[[nodiscard]] std::string digest(const std::vector<Item>& items);

// An HTML page that draws these items with WebGL 2 and offers the answers as an archive; it loads no other file.
[[nodiscard]] std::string page_of(const std::vector<Item>& items);

// The reaches of the triangles that determine the guard band, in pixels: each is a twenty-fourth larger than the
// previous one.
[[nodiscard]] std::vector<int> guard_reaches();

// Parts of the kit (kit_*.cpp).
void add_coverage(std::vector<Item>& items);
void add_positions(std::vector<Item>& items);
void add_depth(std::vector<Item>& items);
void add_clip(std::vector<Item>& items);
void add_orientation(std::vector<Item>& items);
void add_colors(std::vector<Item>& items);
void add_blending(std::vector<Item>& items);

}  // namespace strata::probe
