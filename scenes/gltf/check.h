// scenes/gltf/check.h - a glTF document is proved sound before a buffer is touched or a library sees it.
//
// Rule     After check_document every index leads somewhere, every byte range lies in its buffer's declared length,
//          every value has its type and range, the nodes form a forest. Faults have the Khronos
//          validator's code; what is sound but not supported is refused if required, else a warning (the table in
//          tools/docs/files.md).
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

inline constexpr std::uint64_t max_bytes = 0x7fffffff;  // of a buffer: also the bound of counts and offsets

// Throws InputErrors with every fault that it finds: one an element (an accessor, a material, a primitive) at most, and
// none of meshes whose accessors or materials are wrong themselves.
void check_document(const JsonAt& root, Warnings& warnings);

// The parts, in the order in which they rely on each other; `root` is the document.
void check_extensions(const JsonAt& root, Warnings& warnings, Faults& faults);
void check_buffers(const JsonAt& root, Faults& faults);  // buffers and bufferViews
void check_accessors(const JsonAt& root, Faults& faults);
void check_images(const JsonAt& root, Faults& faults);  // images, samplers, textures
void check_materials(const JsonAt& root, Warnings& warnings, Faults& faults);
void check_meshes(const JsonAt& root, Warnings& warnings, Faults& faults);
void check_cameras(const JsonAt& root, Faults& faults);
void check_nodes(const JsonAt& root, Warnings& warnings, Faults& faults);  // nodes, scenes, scene

// Is the extension named in extensionsUsed?
[[nodiscard]] bool uses_extension(const JsonAt& root, const char* name);

// An optional member that is an index into the top-level array `target`.
std::optional<std::size_t> check_reference(const JsonAt& owner, const char* key, const JsonAt& root,
                                           const char* target);

}  // namespace strata::scenes
