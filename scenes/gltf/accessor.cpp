// scenes/gltf/accessor.cpp - decodes elements from buffer bytes and applies sparse values (accessor.h).
#include "scenes/gltf/accessor.h"

#include <cassert>

namespace strata::scenes {
namespace {

std::uint32_t bits(const std::byte* bytes, ComponentType type) {  // little endian
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < component_bytes(type); ++i)
        value |= std::to_integer<std::uint32_t>(bytes[i]) << (8 * i);
    return value;
}

}  // namespace

AccessorReader::AccessorReader(const tinygltf::Model& model, std::size_t accessor, Buffers& buffers,
                               const FileLocation& location)
    : count_{model.accessors[accessor].count},
      components_{static_cast<std::size_t>(
          tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(model.accessors[accessor].type)))},
      type_{static_cast<ComponentType>(model.accessors[accessor].componentType)},
      is_normalized_{model.accessors[accessor].normalized} {
    const tinygltf::Accessor& a = model.accessors[accessor];
    size_ = components_ * component_bytes(type_);
    stride_ = size_;
    // check.h has verified that the whole range is inside the view, so the reads below need no bounds check.
    if (a.bufferView >= 0) {
        const auto view = static_cast<std::size_t>(a.bufferView);
        base_ = buffers.view(view).subspan(a.byteOffset);
        if (model.bufferViews[view].byteStride != 0) stride_ = model.bufferViews[view].byteStride;
    }
    if (a.sparse.isSparse) prepare_sparse(a, buffers, location);
}

void AccessorReader::prepare_sparse(const tinygltf::Accessor& a, Buffers& buffers, const FileLocation& location) {
    sparse_count_ = static_cast<std::size_t>(a.sparse.count);
    sparse_type_ = static_cast<ComponentType>(a.sparse.indices.componentType);
    sparse_indices_ = buffers.view(static_cast<std::size_t>(a.sparse.indices.bufferView))
                          .subspan(static_cast<std::size_t>(a.sparse.indices.byteOffset));
    sparse_values_ = buffers.view(static_cast<std::size_t>(a.sparse.values.bufferView))
                         .subspan(static_cast<std::size_t>(a.sparse.values.byteOffset));
    // Contents are not covered by check.h, which reads no buffer: the indices are checked here, once.
    const FileLocation indices = location.under("sparse").under("indices");
    for (std::size_t k = 0; k < sparse_count_; ++k) {
        if (sparse_index(k) >= count_)
            indices.fail("ACCESSOR_SPARSE_INDEX_OOB", "indices below " + std::to_string(count_),
                         std::to_string(sparse_index(k)));
        if (k > 0 && sparse_index(k) <= sparse_index(k - 1))
            indices.fail("ACCESSOR_SPARSE_INDICES_NON_INCREASING", "indices that increase",
                         std::to_string(sparse_index(k)) + " after " + std::to_string(sparse_index(k - 1)));
    }
}

std::uint32_t AccessorReader::sparse_index(std::size_t k) const {
    return bits(sparse_indices_.data() + k * component_bytes(sparse_type_), sparse_type_);
}

const std::byte* AccessorReader::at(std::size_t i) const {
    assert(i < count_ && "the caller compares with count()");
    // A binary search: the indices are ascending. Sparse values are packed: element lo is at byte lo * size_.
    std::size_t lo = 0, hi = sparse_count_;
    while (lo < hi) {
        const std::size_t middle = (lo + hi) / 2;
        if (sparse_index(middle) < i)
            lo = middle + 1;
        else
            hi = middle;
    }
    if (lo < sparse_count_ && sparse_index(lo) == i) return sparse_values_.data() + lo * size_;
    return base_.empty() ? nullptr : base_.data() + i * stride_;
}

std::array<float, 4> AccessorReader::element(std::size_t i) const {
    assert(components_ <= 4);
    std::array<float, 4> values{};
    const std::byte* bytes = at(i);
    if (bytes == nullptr) return values;
    for (std::size_t c = 0; c < components_; ++c)
        values[c] = component_value(bits(bytes + c * component_bytes(type_), type_), type_, is_normalized_);
    return values;
}

float AccessorReader::component(std::size_t i, std::size_t c) const {
    assert(c < components_ && type_ == ComponentType::f32);
    const std::byte* bytes = at(i);
    return bytes == nullptr ? 0 : component_value(bits(bytes + c * component_bytes(type_), type_), type_, false);
}

std::uint32_t AccessorReader::index(std::size_t i) const {
    const std::byte* bytes = at(i);
    return bytes == nullptr ? 0 : bits(bytes, type_);
}

// 0xff, 0xffff or 0xffffffff, glTF 2.0, 3.7.2.1.
std::uint32_t AccessorReader::restart_index() const {
    return component_bytes(type_) == 4 ? 0xffffffffu : (1u << (8 * component_bytes(type_))) - 1;
}

const AccessorReader& Accessors::operator[](int accessor) {
    const auto index = static_cast<std::size_t>(accessor);
    // Primitives share accessors, so sparse indices are checked once per accessor, not once per primitive.
    const auto found = readers_.find(accessor);
    if (found != readers_.end()) return found->second;
    return readers_
        .emplace(accessor, AccessorReader{model_, index, buffers_, document_.at("accessors", index).location()})
        .first->second;
}

}  // namespace strata::scenes
