// scenes/gltf/check.h - validates a glTF document before any buffer is read or a library parses it.
//
// Rule     After check_document every index is valid, every byte range is inside its buffer's declared length, every
//          value has its type and range, and the nodes form a forest. Faults have the Khronos validator's codes; an
//          unsupported feature is an error if required, else a warning (table in tools/docs/files.md).
// Source   glTF 2.0 specification; issue codes: KhronosGroup/glTF-Validator, ISSUES.md.
// Numbers  Lengths, offsets and counts are below 2^31, element sizes below 2^8: every sum and product fits 64 bits.
// Tests    tests/scenes/gltf/gltf_bad_*_test.cpp
#pragma once
#include <cstdint>
#include <optional>

#include "scenes/gltf/document/faults.h"
#include "scenes/gltf/document/json.h"
#include "scenes/gltf/document/warnings.h"

namespace strata::scenes {

inline constexpr std::uint64_t max_bytes = 0x7fffffff;  // of a buffer; also the limit of counts and offsets

// Throws InputErrors with every fault found: at most one per element (an accessor, a material, a primitive), and none
// for meshes whose accessors or materials are faulty themselves.
void check_document(const JsonAt& root, Warnings& warnings);

// The checks of the parts, in the order of their dependencies; `root` is the document.
void check_extensions(const JsonAt& root, Warnings& warnings, Faults& faults);
void check_buffers(const JsonAt& root, Faults& faults);  // buffers and bufferViews
void check_accessors(const JsonAt& root, Faults& faults);
void check_images(const JsonAt& root, Faults& faults);  // images, samplers, textures
void check_materials(const JsonAt& root, Warnings& warnings, Faults& faults);
void check_meshes(const JsonAt& root, Warnings& warnings, Faults& faults);
void check_cameras(const JsonAt& root, Faults& faults);
void check_nodes(const JsonAt& root, Warnings& warnings, Faults& faults);  // nodes, scenes, scene

void check_skins(const JsonAt& root, Faults& faults);   // after accessors
void check_lights(const JsonAt& root, Faults& faults);  // and the nodes' references to them (lights.cpp)

// How a user can remove an extension that is not read, in parentheses; "" if no way is known.
[[nodiscard]] std::string way_out_of(const std::string& extension);

// True if extensionsUsed contains the extension.
[[nodiscard]] bool uses_extension(const JsonAt& root, const char* name);

// Checks an optional member that is an index into the top-level array `target`.
std::optional<std::size_t> check_reference(const JsonAt& owner, const char* key, const JsonAt& root,
                                           const char* target);

}  // namespace strata::scenes
