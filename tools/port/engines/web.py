"""Renders scenes with engines of the web in headless Chromium: a server that only this computer can reach sends the page, the engine's files and a
job, and receives the results of the page.
"""
import contextlib
import dataclasses
import http.server
import json
import os
import pathlib
import queue
import shutil
import signal
import subprocess
import tempfile
import threading
import urllib.parse

HERE = pathlib.Path(__file__).resolve().parent
TYPES = {".html": "text/html", ".js": "text/javascript", ".json": "application/json"}
# SwiftShader, the same on every computer; Chromium only loads from the server here.
FLAGS = ["--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
         "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]


class WebError(Exception):
    """The engine, the page or the browser failed; the text is a sentence."""


@dataclasses.dataclass
class Drawn:
    """A target as the page sent it: rows of numbers, the top row first."""
    name: str
    width: int
    height: int
    channels: int
    element: str  # u1 or f4
    data: bytes


def numbers(values):
    return [float(v) for v in values]


def job_of(scene, engine, way, peels, wants_targets):
    """The input of the page, as JSON; floats as the shortest decimals that read back to the same number."""
    meshes = [{"name": m.name, "opaque": m.opaque, "model": numbers(m.model), "positions": numbers(m.positions), "colors": numbers(m.colors),
               "triangles": list(m.triangles), "flat": m.flat()} for m in (scene.runs() if engine == "molstar" else scene.meshes)]
    return {"engine": engine, "way": way, "peels": peels, "targets": wants_targets, "width": scene.width, "height": scene.height,
            "background": scene.background, "view": scene.view, "projection": scene.projection, "meshes": meshes}


class Job:
    """The task of the page, and its results: targets, a camera, or the reason of a failure."""
    def __init__(self, described):
        self.engine, self.text = described["engine"], json.dumps(described).encode()
        self.drawn, self.camera, self.failure, self.ended = [], None, None, threading.Event()


class Handler(http.server.BaseHTTPRequestHandler):
    """Answers the page's requests. The server has `packages`, `waiting`, a queue of jobs, and `job`, the current one."""
    def log_message(self, *_):
        pass

    def answer(self, status, body=b"", kind="text/plain", caching="no-store"):
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Cache-Control", caching)
        self.end_headers()
        with contextlib.suppress(BrokenPipeError):  # the browser has ended before it read the answer
            self.wfile.write(body)

    def do_GET(self):
        path = urllib.parse.urlsplit(self.path).path
        if path == "/job.json":
            self.server.job = self.server.waiting.get()  # the page waits for its next job here
            return self.answer(200, self.server.job.text, TYPES[".json"])
        found = file_of(path, self.server.packages)
        if not found:
            return self.answer(404)
        return self.answer(200, found.read_bytes(), TYPES.get(found.suffix, "application/octet-stream"), "max-age=3600")

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        split = urllib.parse.urlsplit(self.path)
        job = self.server.job
        if split.path == "/target":
            job.drawn.append(target_of(dict(urllib.parse.parse_qsl(split.query)), body))
        elif split.path == "/camera":
            job.camera = json.loads(body)
        elif not job.ended.is_set():
            job.failure = body.decode("utf-8", "replace") if split.path == "/failed" else None
            job.ended.set()
        self.answer(200)


def file_of(path, packages):
    """The file of a request's path; None if there is none. Imports within packages may omit the ending."""
    kind, _, rest = path.lstrip("/").partition("/")
    root = {"page": HERE / "page", "packages": packages}.get(kind)
    found = (root / rest).resolve() if root else None
    if not found or root.resolve() not in found.parents:
        return None
    return next((f for f in (found, found.with_name(found.name + ".js")) if f.is_file()), None)


def target_of(query, body):
    """WebGL reads the bottom row first."""
    width, height, channels = (int(query[k]) for k in ("width", "height", "channels"))
    row = len(body) // height
    return Drawn(query["name"], width, height, channels, query["element"], b"".join(body[y * row:(y + 1) * row] for y in reversed(range(height))))


class Browser:
    """Chromium with the page, and its server; both end with the `with`. The page is loaded again for each job."""
    def __init__(self, packages):
        self.program = shutil.which("chromium")
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.server.packages, self.server.waiting, self.server.job = pathlib.Path(packages), queue.Queue(), None
        self.server.daemon_threads = True

    def __enter__(self):
        if not self.program:
            raise WebError("chromium: not found; tools/port/engines/install.sh installs it")
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        url = f"http://127.0.0.1:{self.server.server_port}/page/page.html"
        self.process = subprocess.Popen([self.program, *FLAGS, f"--user-data-dir={self.profile.name}", "--window-size=2048,2048", url],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        return self

    def __exit__(self, *_):
        with contextlib.suppress(ProcessLookupError):  # it may already have ended
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.server.shutdown()
        self.server.server_close()
        self.profile.cleanup()

    def run(self, described, seconds=300):
        """Executes the job and returns it; WebError on failure."""
        job = Job(described)
        self.server.waiting.put(job)
        for _ in range(seconds):
            if job.ended.wait(1):
                break
            if self.process.poll() is not None:
                raise WebError(f"chromium: ended with status {self.process.returncode} before the page did")
        else:
            raise WebError(f"{job.engine}: the page has not ended within {seconds} seconds")
        if job.failure is not None:
            raise WebError(f"{job.engine}: {job.failure}")
        return job

    def draw(self, scene, engine, way, peels=None, wants_targets=False):
        """The targets of the page, of which one has the name `picture`."""
        return self.run(job_of(scene, engine, way, peels, wants_targets)).drawn

    def matrices(self, engine, look, width, height):
        """The matrices of the engine's own camera, as a camera file of Strata: {"view": ..., "projection": ...}."""
        return self.run({"engine": engine, "camera": look, "width": width, "height": height}).camera
