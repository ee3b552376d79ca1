#!/usr/bin/env python3
"""Inserts faults into a small repository and into copies of the specification's pages, and checks that citations.py and specification_covers.py find
them.

usage: faults.py REPOSITORY

Exit status 1 and one line per fault that was not found, or was reported with other words.
"""
import sys

import specification
import specification_covers
import type_names
import citations

SOUND = {
    "peeling/reference/README.md": "# Book\n[layers.md](layers.md) [errata.md](errata.md)\n",
    "peeling/reference/layers.md": "# Layers\n## 1 Keys\nCodes order like depths (`errata.md 1.1`).\n### 1.1 Ties\nThe first\nsubmitted stays.\n"
                                   "## 2 End\nA query ends it.\n",
    "peeling/reference/errata.md": "# Errata\n## 1 Paper\n### 1.1 E1: a slip\n*Test*: peel_test, \"the first of equals\".\n",
    "peeling/peel.cpp": "// layers.md 1 and 1.1; layers.md 1.1, \"first submitted stays\". E1.\n// Tests tests/peeling/peel_test.cpp\n",
    "tests/peeling/peel_test.cpp": 'TEST_CASE("the first of equals stays") {}\n',
    "tools/RESULTS.md": "# Found\n" + "word " * 598,
    "README.md": "# All\n[ties](peeling/reference/layers.md#11-ties), `peel_test`, `peel.cpp`, `peeling/{peel.cpp,reference}`\n",
}

# (file, text in it, replacement or None to remove the file, words of the expected report)
CITATIONS = [
    ("peeling/peel.cpp", "layers.md 1 and", "layers.md 3 and", "peeling/peel.cpp:1: cites layers.md 3, but peeling/reference/layers.md has no section 3"),
    ("peeling/peel.cpp", "1 and 1.1;", "1 and 1.2;", "has no section 1.2"),
    ("peeling/peel.cpp", "1 and 1.1;", "1 to 4;", "has no section 4"),
    ("peeling/peel.cpp", "first submitted stays", "last arrival stays", 'cites "last arrival stays" of layers.md 1.1, but the words do not stand there'),
    ("peeling/peel.cpp", "layers.md 1 and", "layer.md 1 and", "cites layer.md, but the repository has no such page"),
    ("peeling/peel.cpp", "layers.md 1 and 1.1; layers.md", "layers.md 1 and 1.1;\n// layers.md 9; layers.md", "peeling/peel.cpp:2: cites layers.md 9"),
    ("peeling/peel.cpp", "E1.", "E2.", "cites erratum E2, but errata.md has no heading of that number"),
    ("peeling/peel.cpp", "tests/peeling/peel_test", "tests/peeling/peal_test", "names tests/peeling/peal_test.cpp, but the repository has no such file"),
    ("peeling/reference/layers.md", "## 2 End", "## 1 End", "section 1 stands there twice"),
    ("peeling/reference/layers.md", "errata.md 1.1", "errata.md 1.3", "peeling/reference/layers.md:3: cites errata.md 1.3"),
    ("peeling/reference/errata.md", "the first of equals", "the last of equals", 'names the case "the last of equals" of peel_test'),
    ("peeling/reference/errata.md", "peel_test", "pool_test", "names pool_test, but there is no such test"),
    ("peeling/reference/README.md", "[layers.md](layers.md)", "", "layers.md: is not linked from peeling/reference/README.md"),
    ("peeling/reference/errata.md", "# Errata", None, "cites errata.md, but the repository has no such page"),
    ("README.md", "#11-ties", "#12-ties", "README.md:2: links to peeling/reference/layers.md#12-ties, but peeling/reference/layers.md has no heading"),
    ("README.md", "(peeling/reference/layers.md#11-ties)", "(peeling/layers.md)", "links to peeling/layers.md, but there is no peeling/layers.md"),
    ("README.md", "`peel.cpp`", "`peal.cpp`", "names peal.cpp, but no file of the repository is called so"),
    ("README.md", "{peel.cpp,reference}", "{peel.cpp,other}", "names peeling/{peel.cpp,other}"),
    ("tools/RESULTS.md", "Found", "Found more", "tools/RESULTS.md: has 601 words; a page of results has at most 600"),
    ("README.md", "`peel_test`", "`pool_test`", "names pool_test, but there is no such test"),
]

SPECIFICATION = [
    ("devices.md", "- `raster.snap` `", "- `raster.snip` `", "field raster.snap: devices.md has no bullet that opens with it"),
    ("devices.md", "- `raster.snap`: `", "- `raster.snip`: `", "field raster.snap: devices.md has no bullet that opens with it"),
    ("devices.md", "`fused` rounded once", "the other one rounded once", "field raster.viewport: devices.md 3.3 does not say what fused means"),
    ("devices.md", "`raster.sum_bits` 24 to 29", "`raster.sum_bits` 24 to 28", "field raster.sum_bits: devices.md 3.7 does not say what 24 to 29 means"),
    ("devices.md", ": samples of a pixel in targets that a pass fills sample by sample", " a pixel", "field max_samples: devices.md 7 has "),
    ("algorithms.md", "## 14 `k_buffer`", "## 14 The k-buffer", "algorithm k_buffer: algorithms.md has no heading with it"),
    ("depth.md", "### 4.2 `float32`", "### 4.2 Floats", "depth path float32: depth.md has no heading with it"),
    ("errata.md", "### 3.2 E16:", "### 3.2 The sixteenth:", "erratum E16: errata.md has no heading of it"),
    ("formats.md", "| `s8` | stencil |", "| `s8` | |", "format s8: its row of formats.md 1 has an empty cell"),
    ("keys-and-counts.md", "| `endless` |", "| `endlos` |", "fault endless: the table of keys-and-counts.md 7.2 has no row of it"),
]

SOURCES = [
    (specification_covers.FORMATS, "    s8,", "    s8, y16,", "format y16: the table of formats.md 1 has no row of it"),
    (specification_covers.ALGORITHMS, '.name = "dual"', '.name = "triple"', "algorithm triple: algorithms.md has no heading with it"),
    (specification_covers.FAULTS, "endless,", "endless, tired,", "fault tired: the table of keys-and-counts.md 7.2 has no row of it"),
    (specification_covers.DECLARATIONS, "{ clip, drop }", "{ clip, drop, keep }", "field raster.w_clip: devices.md 3.2 does not say what keep means"),
    (specification_covers.FIELDS, "boolean<", "flag<", "field: found"),
]


def told_by_citations(texts):
    return citations.Checker(specification.Given(texts), fewest=0).run()


def faults_of_citations():
    yield from (f"citations.py finds a fault in a sound repository: {fault}" for fault in told_by_citations(SOUND))
    for name, old, new, expected in CITATIONS:
        assert old in SOUND[name], (name, old)
        files = {**SOUND, name: SOUND[name].replace(old, new or "", 1)}
        if new is None:
            del files[name]
        told = told_by_citations(files)
        if not any(expected in fault for fault in told):
            yield f"citations.py: {name}: '{old}' became '{new}'; expected '{expected}', found {told or 'nothing'}"


def faults_of_specification(root):
    sources, pages = specification_covers.load(root)
    tried = [(pages, name, pages[name].content, old, new, expected) for name, old, new, expected in SPECIFICATION]
    tried += [(sources, name, sources[name], old, new, expected) for name, old, new, expected in SOURCES]
    used = set()
    for table, name, content, old, new, expected in tried:
        if old not in content:
            continue
        used.add(expected)
        changed = content.replace(old, new)
        put = {**table, name: specification.Page(pages[name].name, changed) if table is pages else changed}
        told, _ = specification_covers.check(*((sources, put) if table is pages else (put, pages)))
        if not any(fault.startswith(expected) for fault in told):
            yield f"specification_covers.py: {name}: '{old}' became '{new}'; expected '{expected}', found {told or 'nothing'}"
    for *_, expected in tried:
        if expected not in used:
            yield f"faults.py: nothing left to change for '{expected}': name other words of the page or source"


# What type_names.py counts: types at namespace scope, also in unnamed namespaces, and no others.
TYPES = """
namespace a { struct Plain; struct Plain { int x; struct Inner { }; }; enum class Kind : std::uint8_t { one, two }; }
namespace { template <class T> class Local final : public Base<T> { void f() { struct Hidden {}; } }; }
struct Plain::Inner::Deep { }; template <> struct Plain<int> { }; // struct Comment { };
const char* text = "struct Text {"; struct Named returned(struct Named given) { return given; }
union Both { int i; float f; };
"""


def faults_of_types():
    told = list(type_names.types_of(TYPES))
    if told != ["Plain", "Kind", "Local", "Both"]:
        yield f"type_names.py finds {told}"


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    faults = [*faults_of_citations(), *faults_of_specification(sys.argv[1]), *faults_of_types()]
    for fault in faults:
        print(fault)
    print(f"{len(CITATIONS) + len(SPECIFICATION) + len(SOURCES)} faults put in, {len(faults)} not found as they should be")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
