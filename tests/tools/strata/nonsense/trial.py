"""One execution of the program with an invalid value, and the checks of its output."""
import dataclasses
import os
import subprocess
import tempfile

SECONDS = 60  # limit for a command that should end at once, on a busy machine


def output_of(program, words):
    return subprocess.run([program, *words], capture_output=True, check=True, timeout=SECONDS).stdout.decode()


@dataclasses.dataclass
class Trial:
    group: str  # the option or field under test
    words: list
    names: tuple  # the message must name one of them
    files: dict = dataclasses.field(default_factory=dict)  # by name, with their text

    def fault(self, program):
        """A description of the fault; empty if the program ended as required."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in self.files.items():
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(text)
            try:
                ended = subprocess.run([program, *self.words], cwd=folder, capture_output=True, timeout=SECONDS)
            except subprocess.TimeoutExpired:
                return self.told("did not end")
            left = sorted(set(os.listdir(folder)) - self.files.keys())
        return self.judged(ended, left)

    def judged(self, ended, left):
        err = ended.stderr.decode(errors="backslashreplace")
        if ended.returncode != 2:
            return self.told(f"status {ended.returncode}: {err[:300]!r}")
        if not err.startswith("strata: ") or err.count("\n") != 1 or not err.endswith("\n"):
            return self.told(f"no one sentence: {err[:300]!r}")
        if not is_utf8(ended.stderr):
            return self.told(f"a sentence that is not UTF-8: {err[:300]!r}")
        if not any(name in err for name in self.names):
            return self.told(f"the sentence does not name {' or '.join(self.names)}: {err[:300]!r}")
        if ended.stdout or left:
            return self.told(f"output beside the sentence: {ended.stdout[:80]!r}, files {left}")
        return ""

    def told(self, what):
        shown = " ".join(repr(w)[:80] if isinstance(w, bytes) else w[:80] for w in self.words)
        texts = "".join(f" [{name}: {text[-120:]!r}]" for name, text in self.files.items())
        return f"{self.group}: strata {shown}{texts}: {what}"


def is_utf8(data):
    try:
        data.decode()
        return True
    except UnicodeDecodeError:
        return False
