// scenes/gltf/accessor.h - reads the elements of a checked accessor one by one, with sparse values applied.
//
// Rule     An accessor without a bufferView is zero everywhere; sparse values replace elements; sparse indices strictly
//          increase.
// Source   glTF 2.0, 3.6.2. What a component's bits mean: element.h.
// Tests    tests/scenes/gltf/gltf_accessor_test.cpp
#pragma once
#include <array>
#include <map>

#include "scenes/gltf/document/buffers.h"
#include "scenes/gltf/element.h"
#include "scenes/gltf/model.h"

namespace strata::scenes {

// Refers to the document's buffers, which must outlive it. The caller must keep indices in 0 to count() - 1.
class AccessorReader {
  public:
    AccessorReader(const tinygltf::Model& model, std::size_t accessor, Buffers& buffers, const FileLocation& location);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t components() const { return components_; }  // 16 of a MAT4
    [[nodiscard]] std::array<float, 4> element(std::size_t i) const;      // of 1 to 4 components; missing ones are 0
    [[nodiscard]] float component(std::size_t i, std::size_t c) const;    // of a matrix of binary32: column by column
    [[nodiscard]] std::uint32_t index(std::size_t i) const;               // for a scalar of unsigned integers
    [[nodiscard]] std::uint32_t restart_index() const;                    // the type's largest value: not a valid index

  private:
    [[nodiscard]] const std::byte* at(std::size_t i) const;  // null: zero
    [[nodiscard]] std::uint32_t sparse_index(std::size_t k) const;
    void prepare_sparse(const tinygltf::Accessor& accessor, Buffers& buffers, const FileLocation& location);

    // stride_: bytes from one element to the next; size_: bytes of an element.
    std::size_t count_, components_, stride_ = 0, size_;
    ComponentType type_;
    bool is_normalized_;
    Bytes base_;  // empty: all elements are 0
    std::size_t sparse_count_ = 0;
    ComponentType sparse_type_ = ComponentType::u8;
    Bytes sparse_indices_, sparse_values_;
};

// The readers of a document, created on first use.
class Accessors {
  public:
    Accessors(const Document& document, const tinygltf::Model& model, Buffers& buffers)
        : document_{document}, model_{model}, buffers_{buffers} {}

    // The reference stays valid: a map does not move its elements.
    const AccessorReader& operator[](int accessor);

  private:
    const Document& document_;
    const tinygltf::Model& model_;
    Buffers& buffers_;
    std::map<int, AccessorReader> readers_;
};

}  // namespace strata::scenes
