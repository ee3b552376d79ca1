// scenes/gltf/check_buffers.cpp - byte ranges: buffers, bufferViews, accessors. See check.h.
#include <array>
#include <string_view>

#include "scenes/gltf/check.h"
#include "scenes/gltf/element.h"

namespace strata::scenes {
namespace {

std::uint64_t byte_offset(const JsonAt& at) {
    const auto offset = at.find("byteOffset");
    return offset ? offset->integer(0, max_bytes) : 0;
}

// A view must be inside its buffer's declared length. Whether the buffer really has that many bytes is checked when it
// is read.
void check_view(const JsonAt& view, const JsonAt& root, const std::vector<std::uint64_t>& buffer_lengths) {
    const std::size_t buffer = view.member("buffer").index(root.size("buffers"));
    const JsonAt length = view.member("byteLength");
    const std::uint64_t end = byte_offset(view) + length.integer(1, max_bytes);
    if (end > buffer_lengths[buffer])
        length.location().fail("BUFFER_VIEW_TOO_LONG",
                               "an end within the buffer's " + std::to_string(buffer_lengths[buffer]) + " bytes",
                               "one at " + std::to_string(end));
    // glTF's bounds for a stride: 4 to 252 and a multiple of 4.
    const auto stride = view.find("byteStride");
    if (stride && stride->integer(4, 252) % 4 != 0) stride->fail("VALUE_MULTIPLE_OF", "a multiple of 4");
}

// The part of a bufferView that an accessor, or one half of its sparse part, reads: `count` elements of `size` bytes.
struct ElementRun {
    std::uint64_t count, size, component_size;
};

// glTF 2.0, 3.6.2.4: offsets are multiples of the component's size, in the view and in the buffer. The last element
// needs no padding after it, hence stride * (count - 1) + size; count is at least 1, and all of it
// fits 64 bits (see check.h).
void check_range(const JsonAt& at, const JsonAt& root, const ElementRun& range) {
    const std::size_t view_index = at.member("bufferView").index(root.size("bufferViews"));
    const JsonAt view{root.json()["bufferViews"][view_index], root.location().under("bufferViews").under(view_index)};
    const std::uint64_t offset = byte_offset(at);
    const FileLocation offset_location = at.has("byteOffset") ? at.location().under("byteOffset") : at.location();
    const std::string multiple = "a multiple of " + std::to_string(range.component_size);
    if (offset % range.component_size != 0)
        offset_location.fail("ACCESSOR_OFFSET_ALIGNMENT", multiple, std::to_string(offset));
    const std::uint64_t total = offset + byte_offset(view);
    if (total % range.component_size != 0)
        offset_location.fail("ACCESSOR_TOTAL_OFFSET_ALIGNMENT", multiple + " with the bufferView's",
                             std::to_string(total));
    const auto stride_at = view.find("byteStride");
    const std::uint64_t stride = stride_at ? stride_at->integer(4, 252) : range.size;
    if (stride < range.size)
        stride_at->fail("ACCESSOR_SMALL_BYTESTRIDE",
                        "a stride of at least the element's " + std::to_string(range.size) + " bytes");
    const std::uint64_t end = offset + stride * (range.count - 1) + range.size;
    const std::uint64_t length = view.member("byteLength").integer(1, max_bytes);
    if (end > length)
        at.location().fail("ACCESSOR_TOO_LONG", "an end within the bufferView's " + std::to_string(length) + " bytes",
                           "one at " + std::to_string(end));
}

ComponentType component_type(const JsonAt& at) {
    const JsonAt code = at.member("componentType");
    if (const auto type = to_component_type(code.integer(0, max_bytes))) return *type;
    code.fail("VALUE_NOT_IN_LIST", "5120, 5121, 5122, 5123, 5125 or 5126");
}

ElementType element_type(const JsonAt& at) {
    const JsonAt name = at.member("type");
    if (const auto type = to_element_type(name.string())) return *type;
    name.fail("VALUE_NOT_IN_LIST", "SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
}

// Sparse indices and values are packed, glTF 2.0, 3.6.2.3: a stride is not allowed.
void check_sparse_half(const JsonAt& half, const JsonAt& root, const ElementRun& range) {
    const std::size_t view = half.member("bufferView").index(root.size("bufferViews"));
    if (root.json()["bufferViews"][view].contains("byteStride"))
        half.fail("BUFFER_VIEW_INVALID_BYTE_STRIDE", "a bufferView without byteStride");
    check_range(half, root, range);
}

// `base` is the accessor's own range; the values have its element type, the indices a type of their own.
void check_sparse(const JsonAt& sparse, const JsonAt& root, const ElementRun& base) {
    const JsonAt count = sparse.member("count");
    const std::uint64_t changed = count.integer(1, max_bytes);
    if (changed > base.count)
        count.fail("ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", "at most the accessor's count " + std::to_string(base.count));
    const JsonAt indices = sparse.member("indices");
    const ComponentType type = component_type(indices.object());
    if (!is_index_type(type)) indices.member("componentType").fail("VALUE_NOT_IN_LIST", "5121, 5123 or 5125");
    const std::uint64_t index_size = component_bytes(type);
    check_sparse_half(indices, root, {changed, index_size, index_size});
    check_sparse_half(sparse.member("values"), root, {changed, base.size, base.component_size});
}

void check_accessor(const JsonAt& accessor, const JsonAt& root) {
    const ComponentType component = component_type(accessor);
    const ElementType type = element_type(accessor);
    const ElementRun range{accessor.member("count").integer(1, max_bytes), element_bytes(type, component),
                           component_bytes(component)};
    const auto normalized = accessor.find("normalized");
    if (normalized && normalized->boolean() && (component == ComponentType::f32 || component == ComponentType::u32))
        normalized->fail("ACCESSOR_NORMALIZED_INVALID", "normalized integers of 8 or 16 bits");
    // An accessor without a view is all zeros; a byteOffset without a view is an error of the file.
    if (accessor.has("bufferView"))
        check_range(accessor, root, range);
    else if (const auto offset = accessor.find("byteOffset"))
        offset->fail("UNSATISFIED_DEPENDENCY", "a bufferView next to byteOffset");
    if (const auto sparse = accessor.find("sparse")) check_sparse(*sparse, root, range);
}

}  // namespace

void check_buffers(const JsonAt& root, Faults& faults) {
    std::vector<std::uint64_t> lengths;
    faults.collect_each(root, "buffers", [&](const JsonAt& buffer) {
        lengths.push_back(max_bytes);  // for a buffer without a valid length: its views get no further fault
        lengths.back() = buffer.member("byteLength").integer(1, max_bytes);
        if (const auto uri = buffer.find("uri")) (void)uri->string();
    });
    // The views are checked second, because each is compared with the length of its buffer.
    faults.collect_each(root, "bufferViews", [&](const JsonAt& view) { check_view(view, root, lengths); });
}

void check_accessors(const JsonAt& root, Faults& faults) {
    faults.collect_each(root, "accessors", [&](const JsonAt& accessor) { check_accessor(accessor, root); });
}

}  // namespace strata::scenes
