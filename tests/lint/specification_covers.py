#!/usr/bin/env python3
"""Checks that the specification has a rule for everything that a user can name: fields, algorithms, errata, formats, depth paths, faults.

usage: specification_covers.py REPOSITORY [--list]

The lists come from the sources. The specification must have, of each

    field of a profile          a bullet of devices.md that begins with it, says something, and names each of its values or its range
    algorithm                   a heading of algorithms.md with its name, and a formula below
    erratum E1 to E26           its heading in errata.md, and the test that proves it
    format                      a full row in the table of formats.md 1
    depth path                  a heading of depth.md with its name, and a formula below
    fault of the diagnostics    a full row in the table of keys-and-counts.md 7.2

--list prints the location of each. Exit status 1 and one line per missing rule; also if a list has become shorter, because then the sources are no
longer parsed correctly.
"""
import argparse
import glob
import os
import re
import sys

import specification

FIELDS = "pipeline/device/profile_fields.cpp"
FORMATS = "pipeline/formats/format.h"
PATHS = "rasterizer/rules/rules.h"
FAULTS = "pipeline/frame/diagnostics.h"
SOURCES = (FIELDS, FORMATS, PATHS, FAULTS)
# The files of the algorithms, and the headers that declare the fields; each is read as one text.
ALGORITHMS = ("peeling/algorithms/*.cpp", "peeling/algorithms/*/*.cpp")
DECLARATIONS = ("rasterizer/rules/*.h", "pipeline/device/*.h", "pipeline/formats/*.h")
PAGES = ("algorithms.md", "depth.md", "devices.md", "errata.md", "formats.md", "keys-and-counts.md")
# The numbers when this script was written; a parser that finds fewer is broken.
FEWEST = {"field": 70, "algorithm": 20, "erratum": 26, "format": 16, "depth path": 6, "fault": 14}
FEWEST_WORDS = 6
RANGE = r"(?<![\w.]){}(?: to |, [\d, ]*or ){}(?!\w|\.\d)"
ROW = re.compile(r'\b(integer|choice|boolean|interpolant_bits)(?:<&(\w+)::(\w+)>)?\(\s*"([^"]+)"(?:,\s*(\{[\d, ]+\}))?')
NAME = '[`"]{}[`"]'


class Blind(Exception):
    """A source no longer has the form that this script parses."""


# --- what there is

def enumerators(text, name):
    match = re.search(rf"enum class {name}\b[^{{]*{{(.*?)}};", text, re.DOTALL)
    if not match:
        raise Blind(f"no enum class {name}")
    return re.findall(r"\b([a-z]\w*)\b\s*(?:,|$)", re.sub(r"//[^\n]*", "", match[1]).strip() + ",")


def values_of(owner, member, declarations):
    """The enumerators of the member's type."""
    body = re.search(rf"struct {owner} \{{(.*?)\n\}};", declarations, re.DOTALL)
    declared = body and re.search(rf"(\w+) {member}(?: =|\{{|;)", body[1])
    if not declared:
        raise Blind(f"no declaration of {owner}::{member}")
    return enumerators(declarations, declared[1])


def profile_fields(text, declarations):
    """{field: {value: pattern by which its bullet names it}}: each value of an enumeration, the range of a number, empty for booleans."""
    owners = dict(re.findall(r"using (\w+) = (?:\w+::)*(\w+);", text))
    table = text[text.find("constexpr std::array fields{"):]
    fields = {}
    for kind, owner, member, key, rest in ROW.findall(table):
        if kind == "integer":
            ends = re.findall(r"\d+", rest)[:2]
            fields[key] = {" to ".join(ends): RANGE.format(*ends)}
        elif kind == "choice":
            fields[key] = {name: NAME.format(name) for name in values_of(owners.get(owner, owner), member, declarations)}
        else:
            fields[key] = {name: NAME.format(name) for name in ("16", "24", "double")} if kind == "interpolant_bits" else {}
    return fields


def everything(sources, errata):
    registry = re.findall(r'\.name = "([a-z_]+)"', sources[ALGORITHMS])
    return {
        "field": profile_fields(sources[FIELDS], sources[DECLARATIONS]),
        "algorithm": registry,
        "erratum": [f"E{k}" for k in range(1, max([FEWEST["erratum"], *numbers_of(errata)]) + 1)],
        "format": enumerators(sources[FORMATS], "Format"),
        "depth path": enumerators(sources[PATHS], "DepthPath"),
        "fault": enumerators(sources[FAULTS], "Fault"),
    }


def numbers_of(errata):
    return [int(title[1]) for section in errata.sections.values() if (title := re.match(r"E(\d+):", section.title))]


# --- what the specification says

def items(text):
    """Bullets and table rows, each as one line."""
    found, open_item = [], False
    for line in text.split("\n"):
        if re.match(r"\s*(?:- |\|)", line):
            found.append(line.strip())
            open_item = line.lstrip().startswith("- ")
        elif open_item and line.strip() and line.startswith(" "):
            found[-1] += " " + line.strip()
        else:
            open_item = False
    return found


def cells(row):
    return [cell.strip() for cell in row.strip("|").split("|")]


def has_formula(text):
    return "```" in text or re.search(r"\S = \S", text) is not None


def field(page, key, values):
    """Finds the bullet of devices.md (not the table of values) that begins with the field, has a description, and names each value or both ends."""
    for section in page.sections.values():
        for item in items(section.own):
            opening = re.match(r"- ((?:`[^`]+`(?:, )?)+)(.*)", item)
            if not opening or f"`{key}`" not in opening[1]:
                continue
            lacking = [value for value, pattern in values.items() if not re.search(pattern, item)]
            words = len(re.findall(r"[A-Za-z]{2,}", opening[2]))
            if lacking:
                return None, f"{section} does not say what {lacking[0]} means"
            if words < FEWEST_WORDS:
                return None, f"{section} has {words} words on it, expected {FEWEST_WORDS} or more"
            return section, ""
    return None, "devices.md has no bullet that opens with it"


def titled(page, word):
    """A section with the word in backticks in its heading and a formula below."""
    for section in page.sections.values():
        if f"`{word}`" in section.title:
            return (section, "") if has_formula(section.text) else (None, f"{section} has no formula")
    return None, f"{page.base} has no heading with it"


def row(page, number, word, columns):
    """A row of the section's table whose first cell has the word; no cell is empty."""
    section = page.sections.get(number)
    for item in items(section.own) if section else []:
        found = cells(item)
        if item.startswith("|") and f"`{word}`" in found[0]:
            return (section, "") if len(found) >= columns and all(found) else (None, f"its row of {section} has an empty cell")
    return None, f"the table of {page.base} {number} has no row of it"


def erratum(page, word):
    """Finds the erratum's heading, text about what is printed or done instead, and a test."""
    for section in page.sections.values():
        if section.title.startswith(word + ":"):
            return (section, "") if re.search(r"\*Test\*:\s*[a-z_0-9]+_test", section.own) else (None, f"{section} names no test of it")
    return None, "errata.md has no heading of it"


def find(pages, kind, word, values):
    if kind == "field":
        return field(pages["devices.md"], word, values)
    if kind == "algorithm":
        return titled(pages["algorithms.md"], word)
    if kind == "erratum":
        return erratum(pages["errata.md"], word)
    if kind == "format":
        return row(pages["formats.md"], "1", word, 5)
    if kind == "depth path":
        return titled(pages["depth.md"], word)
    return row(pages["keys-and-counts.md"], "7.2", word, 3)


def check(sources, pages):
    """The faults, and where each rule was found."""
    faults, places = [], []
    for name in PAGES:
        if name not in pages:
            return [f"the specification has no page {name}"], []
    for kind, words in everything(sources, pages["errata.md"]).items():
        if len(words) < FEWEST[kind]:
            faults.append(f"{kind}: found {len(words)} in the sources, expected {FEWEST[kind]} or more: are they still read rightly?")
        for word in words:
            section, lack = find(pages, kind, word, words[word] if isinstance(words, dict) else [])
            if section:
                places.append((kind, word, f"{section} {section.title}"))
            else:
                faults.append(f"{kind} {word}: {lack}")
    return faults, places


def load(root):
    sources = {}
    for name in SOURCES:
        if not os.path.isfile(os.path.join(root, name)):
            raise Blind(f"there is no {name}")
        sources[name] = specification.read(os.path.join(root, name))
    for patterns in (ALGORITHMS, DECLARATIONS):
        paths = [path for pattern in patterns for path in sorted(glob.glob(os.path.join(root, pattern)))]
        sources[patterns] = "".join(specification.read(path) for path in paths)
    found = [os.path.relpath(path, root) for path in glob.glob(os.path.join(root, "*", "reference", "*.md"))]
    texts = {name: specification.read(os.path.join(root, name)) for name in found if os.path.basename(name) in PAGES}
    return sources, {page.base: page for page in specification.pages(specification.Given(texts))}


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    options.add_argument("repository")
    options.add_argument("--list", action="store_true", help="print the section of each thing")
    given = options.parse_args()
    try:
        faults, places = check(*load(given.repository))
    except Blind as problem:
        print(f"specification_covers.py: {problem}; it reads the sources, mend it with them")
        return 1
    for place in places if given.list else []:
        print("{:12} {:32} {}".format(*place))
    for fault in faults:
        print(fault)
    print(f"{len(places)} things have their section of the specification, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
