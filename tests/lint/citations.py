#!/usr/bin/env python3
"""Checks that references in the repository's text exist: sections of the specification, errata, quotations, links, files; and that result pages are
short.

usage: citations.py REPOSITORY

Exit status 1 and one line per missing target; 77 without git. A page is a Markdown file in a folder `reference`; its name is unique
in the repository. Text that git tracks is read without line ends and comment signs, so that a citation may break over lines.

    depth.md 4.4                      the page has a heading with that number
    depth.md 2, 3 and 4.4; 2 to 5     so for each number that is written. A number after a comma counts as a section: put a colon or a semicolon
                                      before other numbers
    depth.md 4.4, "It needs"          the words are in the last section named or in its subsections, whatever the line breaks, backticks, asterisks
    errata.md                         a file of that name is there; names in capitals, like README, are checked as paths and links alone
    E16                               errata.md has the heading `E16:`
    audit_test, "every tie policy"    the file of that test has the words
    pipeline/stages/blend.h           the file or folder is there; `*` and `{a,b}` are a shell's; .cpp and .h are optional; a part in capitals,
                                      like FOLDER, stands for the reader's own
    `blend_*.cpp`, `audit_test`       in the specification and in READMEs: a file of that name is there
    [words](file#heading)             the file and its heading are there

A page is linked from the README of its folder, and another file names it. A section's number occurs once on a page.
"""
import argparse
import fnmatch
import os
import re
import sys

import specification

FLOORS = "rasterizer|pipeline|peeling|scenes|tools|tests"
NUMBER = r"\d+(?:\.\d+)*(?![\w%]|\.\d|,\d)"
PAGE = re.compile(r"(?<![\w/*.-])(?:(?:[a-z_]+/)+)?([a-z0-9][a-z0-9-]*\.md)\b`?")
LIST = re.compile(rf" (?:`?{NUMBER}`?)(?:(?:, and |, | and | to )`?{NUMBER}`?)*")
QUOTED = re.compile(r'[,:]? "([^"]+)"')
ERRATUM = re.compile(r"(?<![\w/#.-])E(\d{1,2})\b(?!\.\d|[/-])")
CASE = re.compile(r'(?<![\w/])([a-z0-9_]+_test)((?:, (?:and )?"[^"]+")+)')
PATH = re.compile(rf"(?<![\w./$}}-])(?:{FLOORS})/[\w.*{{}}/,-]*[\w*}}]")
TEST_FILE = re.compile(r"(?<![\w/*])([a-z0-9_]+_test\.(?:cpp|py|sh))\b")
SOURCE_NAME = re.compile(r"`([\w*-]+\.(?:h|cpp|py|sh|\*))`")
TEST_NAME = re.compile(r"`?(?<![\w/*.-])([a-z0-9_*]+_test)\b(?!\.)")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
# Written by a program, so not in a checkout.
MADE = {"report.md"}
# Names of pipeline state that look like names of tests, and fields that look like names of files.
STATE = {"alpha_test", "depth_test", "stencil_test", "raster.*"}
# These files contain wrong references on purpose.
WRONG_ON_PURPOSE = {"tests/lint/faults.py"}
FEWEST_CITATIONS = 300
RESULTS = ("RESULTS.md", "MISTAKES.md", "BLIND.md", "PERFORMANCE.md", "PEELS.md", "DIFFERENCES.md")  # written by scripts
MOST_WORDS = 600  # limit of such a page; complete tables are written to build/


def plain(words):
    return " ".join(re.sub(r"[`*]", "", words).split())


def slug(title):
    """The anchor that Markdown viewers give a heading."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


class Checker:
    def __init__(self, files, fewest=FEWEST_CITATIONS):
        self.files, self.names, self.fewest = files, files.names, fewest
        self.known = set(self.names)
        self.folders = {"/".join(name.split("/")[:k]) for name in self.names for k in range(1, name.count("/") + 1)}
        self.bases = {}
        for name in self.names:
            self.bases.setdefault(os.path.basename(name), []).append(name)
        self.pages = {page.base: page for page in specification.pages(files)}
        errata = self.pages.get("errata.md")
        self.errata = {} if not errata else {
            int(title[1]): section for section in errata.sections.values() if (title := re.match(r"E(\d+):", section.title))}
        self.faults, self.named, self.count = [], set(), 0

    def fault(self, where, text):
        self.faults.append(f"{where}: {text}")

    # --- the specification

    def check_pages(self):
        for base, page in self.pages.items():
            if len(self.bases[base]) != 1:
                self.fault(page.name, f"a page's name stands once in the repository, but there are {', '.join(self.bases[base])}")
            for number in page.repeated:
                self.fault(page.name, f"section {number} stands there twice")

    def check_citations(self, text):
        for match in PAGE.finditer(text.flat):
            base, where = match[1], text.where(match.start())
            if base not in self.pages:
                if base not in self.bases and base not in MADE:
                    self.fault(where, f"cites {base}, but the repository has no such page")
                continue
            if text.name != self.pages[base].name:
                self.named.add(base)
            numbers = LIST.match(text.flat, match.end())
            if numbers:
                self.check_numbers(text, where, base, numbers)

    def check_numbers(self, text, where, base, numbers):
        sections = []
        for number in re.findall(NUMBER, numbers[0]):
            self.count += 1
            section = self.pages[base].sections.get(number)
            if section:
                sections.append(section)
            else:
                self.fault(where, f"cites {base} {number}, but {self.pages[base].name} has no section {number}")
        quoted = QUOTED.match(text.flat, numbers.end())
        if quoted and sections and plain(quoted[1]) not in plain(sections[-1].text):
            self.fault(where, f'cites "{quoted[1]}" of {sections[-1]}, but the words do not stand there')

    def check_errata(self, text):
        for match in ERRATUM.finditer(text.flat):
            if int(match[1]) not in self.errata:
                self.fault(text.where(match.start()), f"cites erratum E{match[1]}, but errata.md has no heading of that number")

    def check_orphans(self):
        for base, page in self.pages.items():
            readme = os.path.dirname(page.name) + "/README.md"
            linked = {os.path.normpath(os.path.join(os.path.dirname(readme), target.split("#")[0]))
                      for target in LINK.findall(self.files.read(readme) or "")} if readme in self.known else set()
            if page.name not in linked:
                self.fault(page.name, f"is not linked from {readme}")
            if base not in self.named:
                self.fault(page.name, "is an orphan: nothing but itself names it")

    # --- tests, files, links

    def check_cases(self, text):
        for match in CASE.finditer(text.flat):
            where = text.where(match.start())
            files = self.bases.get(match[1] + ".cpp", [])
            if not files:
                self.fault(where, f"names {match[1]}, but there is no such test")
                continue
            said = plain(" ".join(re.sub(r'"\s*\n\s*"', "", self.files.read(name)) for name in files)).replace('\\"', '"')
            for words in re.findall(r'"([^"]+)"', match[2]):
                if plain(words) not in said:
                    self.fault(where, f'names the case "{words}" of {match[1]}, but {files[0]} has no such words')

    def exists(self, path):
        """True if a file or folder exists; * and {a,b} as in a shell; the ending of tests and headers may be missing."""
        braces = re.search(r"\{([^}]*)\}", path)
        if braces:
            return all(self.exists(path[:braces.start()] + part + path[braces.end():]) for part in braces[1].split(","))
        if "*" in path:
            return any(fnmatch.fnmatchcase(name, path) for name in self.known | self.folders)
        return path in self.known or path in self.folders or path + ".cpp" in self.known or path + ".h" in self.known

    def check_paths(self, text):
        for match in PATH.finditer(text.flat):
            path = match[0].rstrip(".,")
            if re.search(r"(?:^|/)[A-Z]+(?:_\w+)?(?:\.\w+)?(?:/|$)", path) and not self.exists(path):
                continue  # FOLDER, SCENE: placeholders
            if not self.exists(path):
                self.fault(text.where(match.start()), f"names {path}, but the repository has no such file")
        for match in TEST_FILE.finditer(text.flat):
            if match[1] not in self.bases:
                self.fault(text.where(match.start()), f"names {match[1]}, but the repository has no such test")

    def check_names(self, text):
        """Checks names of sources and tests in backticks, in the specification and in READMEs."""
        for match in SOURCE_NAME.finditer(text.flat):
            if match[1] not in STATE and not fnmatch.filter(self.bases, match[1]):
                self.fault(text.where(match.start()), f"names {match[1]}, but no file of the repository is called so")
        for match in TEST_NAME.finditer(text.flat):
            if match[1] not in STATE and not fnmatch.filter(self.bases, match[1] + ".cpp"):
                self.fault(text.where(match.start()), f"names {match[1]}, but there is no such test")

    def check_links(self, name, content):
        outside = re.sub(r"^```.*?^```", lambda block: "\n" * block[0].count("\n"), content, flags=re.MULTILINE | re.DOTALL)
        outside = re.sub(r"`[^`\n]*`", "", outside)
        for match in LINK.finditer(outside):
            target, where = match[1], f"{name}:{outside.count(chr(10), 0, match.start()) + 1}"
            if re.match(r"[a-z][a-z0-9+.-]*:", target):
                continue
            path, _, anchor = target.partition("#")
            file = os.path.normpath(os.path.join(os.path.dirname(name), path)) if path else name
            if file not in self.known and file not in self.folders:
                self.fault(where, f"links to {target}, but there is no {file}")
            elif anchor and anchor not in {slug(title) for _, _, title in specification.headings(self.files.read(file) or "")}:
                self.fault(where, f"links to {target}, but {file} has no heading with that anchor")

    def check_length(self, name, content):
        if os.path.basename(name) in RESULTS and len(content.split()) > MOST_WORDS:
            self.fault(name, f"has {len(content.split())} words; a page of results has at most {MOST_WORDS}")

    def run(self):
        self.check_pages()
        for name in self.names:
            content = self.files.read(name)
            if content is None or name in WRONG_ON_PURPOSE:
                continue
            text = specification.Text(name, content)
            self.check_citations(text)
            self.check_errata(text)
            self.check_cases(text)
            self.check_paths(text)
            if name.endswith(".md"):
                self.check_links(name, content)
                self.check_length(name, content)
                if specification.is_page(name) or os.path.basename(name) == "README.md":
                    self.check_names(text)
        self.check_orphans()
        if self.count < self.fewest:
            self.fault("citations.py", f"found {self.count} citations of sections, expected {self.fewest} or more: does it still read them?")
        return self.faults


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    options.add_argument("repository")
    given = options.parse_args()
    try:
        checker = Checker(specification.Checkout(given.repository))
    except specification.NoCheckout:
        print("SKIPPED: the list of files comes from git, and this is no checkout")
        return 77
    for fault in sorted(checker.run()):
        print(fault)
    print(f"{checker.count} citations of sections of {len(checker.pages)} pages, {len(checker.faults)} faults")
    return 1 if checker.faults else 0


if __name__ == "__main__":
    sys.exit(main())
