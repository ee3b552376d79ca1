// Tests NumPy files. The expected headers and elements are written by hand after NumPy Enhancement Proposal 1.
#include "scenes/packs/npy.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"

using namespace strata::scenes;
using Catch::Contains;

namespace {

std::string npy_by_hand(const std::string& dictionary, const std::string& data, std::size_t header_length) {
    std::string header = dictionary;
    header.resize(header_length - 1, ' ');
    std::string file = "\x93NUMPY";
    file += '\x01';
    file += '\0';
    file += static_cast<char>(header_length & 0xff);
    file += static_cast<char>(header_length >> 8);
    return file + header + '\n' + data;
}

}  // namespace

TEST_CASE("an array is written as a NumPy file whose numbers begin at byte 128") {
    NumberArray array{.element = Element::u2, .shape = {2, 3}};
    for (const std::uint32_t word : {1u, 0x1234u, 0xffffu, 0u, 7u, 256u}) array.append(word);
    const std::string data{"\x01\x00\x34\x12\xff\xff\x00\x00\x07\x00\x00\x01", 12};
    CHECK(to_npy(array) == npy_by_hand("{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3), }", data, 118));
    CHECK(to_npy({.element = Element::f4, .shape = {0}}) ==
          npy_by_hand("{'descr': '<f4', 'fortran_order': False, 'shape': (0,), }", "", 118));
    CHECK(parse_npy(to_npy(array), "a.npy") == array);
    CHECK(array.word(1) == 0x1234u);
    for (const Element element : {Element::u1, Element::u2, Element::u4, Element::i4, Element::f2, Element::f4})
        for (const std::vector<std::size_t>& shape :
             {std::vector<std::size_t>{5}, {1, 1}, {0, 3}, {2, 2, 2}, {1, 2, 3, 4}}) {
            NumberArray any{.element = element, .shape = shape};
            for (std::size_t i = 0; i < any.count(); ++i) any.append(static_cast<std::uint32_t>(i * 0x01020304u));
            CHECK(to_npy(any).size() == npy_header_bytes + any.bytes.size());
            CHECK(parse_npy(to_npy(any), "any.npy") == any);
        }
}

TEST_CASE("arrays that NumPy writes are read with any length and version of their header") {
    const std::string data{"\x00\x00\x80\x3f", 4};
    const std::string one = npy_by_hand("{'descr': '<f4', 'fortran_order': False, 'shape': (1,), }", data, 70);
    CHECK(parse_npy(one, "one.npy").word(0) == 0x3f800000u);
    std::string two = one;
    two[6] = 2;
    two.insert(10, 2, '\0');
    CHECK(parse_npy(two, "two.npy").word(0) == 0x3f800000u);
}

TEST_CASE("a file that is not such an array is rejected with its position") {
    const auto fails = [](const std::string& bytes, const std::string& message) {
        CHECK_THROWS_WITH(static_cast<void>(parse_npy(bytes, "x.npy")), Contains(message));
    };
    const std::string four(4, '\0');
    fails("PNG", "x.npy: byte 0: expected the header of a .npy file");
    fails(npy_by_hand("{'descr': '>f4', 'fortran_order': False, 'shape': (1,), }", four, 118), "x.npy: descr:");
    fails(npy_by_hand("{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }", four, 118), "x.npy: descr:");
    fails(npy_by_hand("{'descr': '<f4', 'fortran_order': True, 'shape': (1,), }", four, 118), "fortran_order");
    fails(npy_by_hand("{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }", four, 118),
          "size: expected 8 bytes for 2 elements of 4 bytes each, found 4");
    fails(npy_by_hand("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 1, 1, 1), }", four, 118), "shape");
    fails(npy_by_hand("{'descr': '<f4', 'fortran_order': False, 'shape': (70000, 70000), }", four, 118), "shape");
    fails(npy_by_hand("{'descr': '<f4', 'fortran_order': False, 'shape': (-1,), }", four, 118), "shape");
    const std::string whole = npy_by_hand("{'descr': '<f4', 'fortran_order': False, 'shape': (1,), }", four, 118);
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK_THROWS_AS(static_cast<void>(parse_npy(whole.substr(0, length), "cut.npy")), strata::InputError);
}
