"""Reads the repository as text, and the specification as pages with numbered sections, for the tests of the specification."""
import bisect
import os
import re
import subprocess

LEADERS = {
    ".h": r"//+", ".cpp": r"//+", ".py": r"#+", ".sh": r"#+", ".txt": r"#+", ".cmake": r"#+", "run": r"#+",
}
HEADING = re.compile(r"^(#{1,6}) +(.*?) *$")
NUMBERED = re.compile(r"^(\d+(?:\.\d+)*) +(.*)$")


class NoCheckout(Exception):
    """The list of files comes from git; without a checkout nothing can be checked."""


class Text:
    """A file as one line without comment signs and line ends, so that a sentence is found wherever its lines break."""

    def __init__(self, name, content):
        self.name, self.content = name, content
        leader = LEADERS.get(os.path.splitext(name)[1] or os.path.basename(name))
        strip = re.compile(rf"^\s*(?:{leader}\s?)?\s*" if leader else r"^\s*")
        parts, self._starts, place = [], [], 0
        for line in content.split("\n"):
            self._starts.append(place)
            parts.append(strip.sub("", line).rstrip())
            place += len(parts[-1]) + 1
        self.flat = " ".join(parts)

    def where(self, place):
        return f"{self.name}:{bisect.bisect_right(self._starts, place)}"


class Section:
    """A numbered section: its own text ends at the next numbered heading; `text` continues to the end of its subsections."""

    def __init__(self, page, number, title, own, text):
        self.page, self.number, self.title, self.own, self.text = page, number, title, own, text

    def __str__(self):
        return f"{self.page} {self.number}"


class Page:
    def __init__(self, name, content):
        self.name, self.base, self.content = name, os.path.basename(name), content
        self.repeated = []
        self.sections = {}
        for section in sections_of(self.base, content):
            if section.number in self.sections:
                self.repeated.append(section.number)
            self.sections[section.number] = section


def headings(content):
    """(line number from 0, level, title) of every heading outside of code blocks."""
    fenced = False
    for number, line in enumerate(content.split("\n")):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        match = None if fenced else HEADING.match(line)
        if match:
            yield number, len(match[1]), match[2]


def sections_of(page, content):
    lines = content.split("\n")
    found = [(at, level, NUMBERED.match(title)) for at, level, title in headings(content)]
    for index, (at, level, title) in enumerate(found):
        if not title:
            continue
        after = found[index + 1:]
        own_end = after[0][0] if after else len(lines)
        end = next((other for other, other_level, _ in after if other_level <= level), len(lines))
        yield Section(page, title[1], title[2], "\n".join(lines[at + 1:own_end]), "\n".join(lines[at:end]))


class Checkout:
    """The files of a git checkout, including new ones that git does not ignore. Throws NoCheckout if there is none."""

    def __init__(self, root):
        self.root, self._read = root, {}
        try:
            listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root, capture_output=True,
                                    text=True, check=True).stdout
        except (OSError, subprocess.CalledProcessError) as problem:
            raise NoCheckout from problem
        self.names = sorted(name for name in listed.split("\0") if name and os.path.isfile(os.path.join(root, name)))
        if not self.names:
            raise NoCheckout

    def read(self, name):
        if name not in self._read:
            self._read[name] = read(os.path.join(self.root, name))
        return self._read[name]


class Given:
    """Files that exist only in the caller's table {name: text}."""

    def __init__(self, texts):
        self.names, self.read = sorted(texts), texts.get


def read(path):
    """A file's text; None if it is not a text file."""
    with open(path, "rb") as file:
        content = file.read()
    if b"\0" in content:
        return None
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        return None


def is_page(name):
    return "/reference/" in name and name.endswith(".md") and os.path.basename(name) != "README.md"


def pages(files):
    return [Page(name, files.read(name)) for name in files.names if is_page(name)]
