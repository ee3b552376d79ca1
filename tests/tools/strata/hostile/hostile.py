#!/usr/bin/env python3
"""Runs the program on malicious files and checks that they do no harm.

    tests/tools/strata/hostile/hostile.py build/release/strata           # every attempt, some seconds
    tests/tools/strata/hostile/hostile.py build/release/strata --list    # the attempts by kind of file
    tests/tools/strata/hostile/hostile.py build/release/strata exr pack  # those whose kind or description contains one of these

The attempts are derived from the documentation, not from the sources. Each runs in a separate folder, with files outside of it that an attacker would
want to read or write. An attempt has succeeded, and this script exits with 1, if the program
  - wrote, changed or removed anything but the output that the command names, or left an output of a run that failed, except
    the report of --junit, which says that it failed;
  - used a file outside of the folder (the attempt states this: such a file would be usable, so the command must fail), or used the network;
  - executed a word of the file as a command;
  - ended by a signal or with the status of a system failure, took more than 20 s of processor time, or 600 MB, or more than 5 minutes;
  - wrote a control character, or a byte that is not UTF-8, to a stream, printed more than 40 lines or 20,000 bytes of errors, or wrote
    JSON, XML or HTML in which a name of the file became a part of the document.
"""
import argparse
import hashlib
import html.parser
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import attempts  # noqa: E402

PROCESSOR_SECONDS, SECONDS, MEGABYTES = 20, 300, 600  # processor time does not depend on other load
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")


def tree(folder):
    """Every name below the folder with its content: a link's target or a file's bytes. A pipe has neither."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_symlink():
            found[name] = "link " + os.readlink(path)
        elif path.is_file():
            found[name] = hashlib.sha256(path.read_bytes()).hexdigest() if path.stat().st_size < 1 << 26 else str(path.stat().st_size)
        else:
            found[name] = "folder" if path.is_dir() else "other"
    return found


def measured(words, place):
    """Status (negative: a signal), output, errors, megabytes; None for the status of a command that took too long."""
    environment = {**os.environ, "HOME": str(place / "outside"), "TMPDIR": str(place / "tmp"), "TERM": "xterm"}

    def limit():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_SECONDS, PROCESSOR_SECONDS + 5))
    with open(place / "out", "wb") as out, open(place / "err", "wb") as err, \
            subprocess.Popen(words, cwd=place / "here", stdin=subprocess.DEVNULL, stdout=out, stderr=err, env=environment,
                             preexec_fn=limit) as child:
        late = threading.Event()
        timer = threading.Timer(SECONDS, lambda: (late.set(), child.kill()))
        timer.start()
        _, status, used = os.wait4(child.pid, 0)
        timer.cancel()
        child.returncode = os.waitstatus_to_exitcode(status)
    written = [(place / name).read_bytes() for name in ("out", "err")]
    for name in ("out", "err"):
        (place / name).unlink()
    is_late = late.is_set() or used.ru_utime + used.ru_stime >= PROCESSOR_SECONDS
    return None if is_late else child.returncode, *written, used.ru_maxrss // 1024


class Page(html.parser.HTMLParser):
    """Finds the elements of attempts.MARKUP."""

    def __init__(self):
        super().__init__()
        self.found, self.script = [], False

    def handle_starttag(self, tag, attrs):
        self.script = tag == "script"
        if any(key.startswith("on") and value == "pwned()" for key, value in attrs):
            self.found.append(tag)

    def handle_data(self, data):
        if self.script and data.strip() == "pwned()":
            self.found.append("script")


def document_faults(path):
    try:
        if path.suffix == ".json":
            json.loads(path.read_bytes())
        if path.suffix in (".xml", ".svg"):
            root = xml.etree.ElementTree.parse(path)
            if any(e.tag.endswith("script") or any(k.startswith("on") for k in e.attrib) for e in root.iter()):
                yield f"{path.name}: a name became an element"
        if path.suffix == ".html":
            page = Page()
            page.feed(path.read_text(encoding="utf-8"))
            if page.found:
                yield f"{path.name}: a name became {page.found}"
    except (ValueError, xml.etree.ElementTree.ParseError) as error:
        yield f"{path.name}: {error}"


def stream_faults(name, written, is_json):
    try:
        text = written.decode("utf-8")
    except UnicodeDecodeError as error:
        yield f"{name}: {error}"
        return
    if CONTROL.search(text):
        yield f"{name}: the control character {CONTROL.search(text).group()!r}"
    if name == "standard error" and (len(text) > 20000 or text.count("\n") > 40):
        yield f"{name}: {len(text)} bytes in {text.count(chr(10))} lines"
    if is_json:
        try:
            json.loads(text)
        except ValueError as error:
            yield f"{name}: {error}"


def faults(program, attempt, root):
    """Descriptions of what the attempt achieved; empty if the program was safe."""
    place = pathlib.Path(tempfile.mkdtemp(dir=root))
    for name in ("here", "outside", "tmp"):
        (place / name).mkdir()
    network = attempt.make(place, program)
    before = tree(place)
    for command in attempt.commands:
        words = [str(program), *command]
        status, out, err, megabytes = measured(words, place)
        after = tree(place)
        said = err.decode("utf-8", "replace").strip()[:200]
        shown = " ".join(w if len(w) < 60 else w[:57] + "..." for w in command)
        about = lambda sentence: f"strata {shown}: {sentence} ({said})"  # noqa: E731, B023
        if status is None:
            yield about(f"not done after {PROCESSOR_SECONDS} s of a processor, or {SECONDS} s")
            return
        if status not in (0, 1, 2):
            yield about(f"status {status}")
        if attempt.harmless and status != 0:
            yield about(f"status {status} for a file as it should be")
        if attempt.must_fail and status != 2:
            yield about(f"status {status}, as if the file were fine")
        if megabytes > MEGABYTES:
            yield about(f"{megabytes} MB")
        changed = {name for name in before | after if before.get(name) != after.get(name)}
        outputs = {name for name in changed if re.match(r"here/out(?=[./]|$)", name) and name not in before}
        if changed - outputs:
            yield about(f"changed {sorted(changed - outputs)[:3]}")
        reports = {f"here/{file}" for option, file in zip(command, command[1:]) if option == "--junit"}
        if outputs - reports and status == 2:
            yield about(f"left {sorted(outputs - reports)[:3]}")
        for name in sorted(outputs):
            yield from map(about, document_faults(place / name))
        for name, written in (("standard output", out), ("standard error", err)):
            yield from map(about, stream_faults(name, written, name == "standard output" and "--json" in command and status != 2))
        if hasattr(network, "was_asked") and network.was_asked():
            yield about("the network was asked")
        for name in sorted(outputs, reverse=True):
            path = place / name
            path.rmdir() if path.is_dir() and not path.is_symlink() else path.unlink()
    shutil.rmtree(place, ignore_errors=True)


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    options.add_argument("program", type=lambda path: pathlib.Path(path).resolve())
    options.add_argument("words", nargs="*")
    options.add_argument("--list", action="store_true", help="print the attempts")
    given = options.parse_args()
    chosen = [a for a in attempts.ALL if not given.words or any(w in f"{a.kind}: {a.what}" for w in given.words)]
    if given.list:
        for kind in dict.fromkeys(a.kind for a in chosen):
            print(f"{kind}:", "; ".join(a.what for a in chosen if a.kind == kind and not a.harmless))
        return 0
    harmless = sum(a.harmless for a in chosen)
    succeeded = 0
    with tempfile.TemporaryDirectory() as root:
        for attempt in chosen:
            found = list(faults(given.program, attempt, root))
            succeeded += bool(found)
            for sentence in found:
                print(f"{attempt.kind}: {attempt.what}: {sentence}")
    print(f"{len(chosen) - harmless} attempts and {harmless} harmless files, {succeeded} successes")
    return 1 if succeeded or not chosen else 0


if __name__ == "__main__":
    sys.exit(main())
