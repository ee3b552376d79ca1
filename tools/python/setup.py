"""Builds the extension with CMake: against the shared libraries in the folder STRATA_PREFIX of the environment, else from these sources."""
import os
import pathlib
import re
import subprocess
import sys

import setuptools
from setuptools.command.build_ext import build_ext


def terminal():
    """The terminal, for progress: pip keeps what a build prints to itself. None if there is no terminal."""
    try:
        return open("/dev/tty", "w", encoding="utf-8")
    except OSError:
        return None


def build_with_progress(build):
    """Builds; the output is printed as it comes, and its share of steps is shown on the terminal."""
    shown = None if sys.stderr.isatty() else terminal()
    running = subprocess.Popen(["cmake", "--build", build], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    for line in running.stdout:
        print(line, end="", flush=True)
        step = re.match(r"\[(\d+)/(\d+)\]", line)
        if shown and step:
            print(f"\rstrata: {100 * int(step[1]) // int(step[2])} % of {step[2]} steps built", end="", file=shown, flush=True)
    if shown:
        print("\r" + 60 * " " + "\r", end="", file=shown, flush=True)
        shown.close()
    if running.wait() != 0:
        raise subprocess.CalledProcessError(running.returncode, running.args)


class CMakeBuild(build_ext):
    def run(self):
        source = pathlib.Path(__file__).resolve().parent
        build = pathlib.Path(os.environ.get("STRATA_PYTHON_BUILD") or self.build_temp).resolve()
        target = pathlib.Path(self.get_ext_fullpath("strata._strata")).resolve().parent
        options = ["-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}", f"-DCMAKE_INSTALL_PREFIX={target}"]
        if "STRATA_PREFIX" in os.environ:
            options.append(f"-DSTRATA_PREFIX={os.environ['STRATA_PREFIX']}")
        # --fresh: a failed installation leaves a cache, whose values would be used again.
        subprocess.run(["cmake", "--fresh", "-S", source, "-B", build, "-G", "Ninja", *options], check=True)
        build_with_progress(build)
        subprocess.run(["cmake", "--install", build], check=True)


# All intermediate files are in the repository's build folder: files of an earlier version in the source folder would become part of the wheel.
base = pathlib.Path(__file__).resolve().parents[2] / "build" / "python-package"
base.mkdir(parents=True, exist_ok=True)
setuptools.setup(options={"build": {"build_base": str(base)}, "egg_info": {"egg_base": str(base)}}, ext_modules=[setuptools.Extension("strata._strata", [])], cmdclass={"build_ext": CMakeBuild})
