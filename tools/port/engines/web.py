"""Draws scenes with engines of the web in headless Chromium: a server on this machine alone gives it the page, the engine's files and a
job, and takes back what the page has drawn.
"""
import dataclasses
import http.server
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import threading
import urllib.parse

HERE = pathlib.Path(__file__).resolve().parent
TYPES = {".html": "text/html", ".js": "text/javascript", ".json": "application/json"}
# SwiftShader, the same on every machine; nothing is fetched but from the server here.
FLAGS = ["--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
         "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]


class WebError(Exception):
    """The engine, the page or the browser failed: a sentence."""


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
    """What the page needs, as JSON; floats as the shortest decimals that read back to the same number."""
    meshes = [{"name": m.name, "opaque": m.opaque, "model": numbers(m.model), "positions": numbers(m.positions), "colors": numbers(m.colors),
               "triangles": list(m.triangles), "flat": m.flat()} for m in (scene.runs() if engine == "molstar" else scene.meshes)]
    return {"engine": engine, "way": way, "peels": peels, "targets": wants_targets, "width": scene.width, "height": scene.height,
            "background": scene.background, "view": scene.view, "projection": scene.projection, "meshes": meshes}


class Session:
    """What server and caller share: the job, the files, the targets that came back, and how it ended."""
    def __init__(self, job, packages):
        self.job, self.packages, self.drawn, self.camera, self.failure, self.ended = json.dumps(job).encode(), pathlib.Path(packages), [], None, None, threading.Event()

    def file(self, path):
        """The file of a request's path; None if there is none. Imports of packages may leave the ending out."""
        kind, _, rest = path.lstrip("/").partition("/")
        root = {"page": HERE / "page", "packages": self.packages}.get(kind)
        if root is None:
            return None
        found = (root / rest).resolve()
        if root.resolve() not in found.parents:
            return None
        return next((f for f in (found, found.with_name(found.name + ".js")) if f.is_file()), None)


def handler_of(session):
    class Handler(http.server.BaseHTTPRequestHandler):
        def log_message(self, *_):
            pass

        def answer(self, status, body=b"", kind="text/plain"):
            self.send_response(status)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def do_GET(self):
            path = urllib.parse.urlsplit(self.path).path
            if path == "/job.json":
                return self.answer(200, session.job, TYPES[".json"])
            found = session.file(path)
            if not found:
                return self.answer(404)
            return self.answer(200, found.read_bytes(), TYPES.get(found.suffix, "application/octet-stream"))

        def do_POST(self):
            body = self.rfile.read(int(self.headers["Content-Length"]))
            split = urllib.parse.urlsplit(self.path)
            query = dict(urllib.parse.parse_qsl(split.query))
            self.answer(200)
            if split.path == "/target":
                session.drawn.append(target_of(query, body))
            elif split.path == "/camera":
                session.camera = json.loads(body)
            else:
                session.failure = body.decode("utf-8", "replace") if split.path == "/failed" else None
                session.ended.set()
    return Handler


def target_of(query, body):
    """WebGL reads the bottom row first."""
    width, height, channels = (int(query[k]) for k in ("width", "height", "channels"))
    row = len(body) // height
    return Drawn(query["name"], width, height, channels, query["element"], b"".join(body[y * row:(y + 1) * row] for y in reversed(range(height))))


def draw(scene, engine, way, packages, peels=None, wants_targets=False):
    """The targets that the page sent, the one with the name `picture` among them; WebError otherwise."""
    return run(job_of(scene, engine, way, peels, wants_targets), packages).drawn


def matrices(engine, look, width, height, packages):
    """The matrices of the engine's own camera, as a camera file of Strata: {"view": ..., "projection": ...}."""
    return run({"engine": engine, "camera": look, "width": width, "height": height}, packages).camera


def run(job, packages, seconds=300):
    """The session of a job that has ended well."""
    program = shutil.which("chromium")
    if not program:
        raise WebError("chromium: not found; tools/port/engines/install.sh installs it")
    session = Session(job, packages)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler_of(session))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        url = f"http://127.0.0.1:{server.server_port}/page/page.html"
        browser = subprocess.Popen([program, *FLAGS, f"--user-data-dir={profile}", f"--window-size={job['width'] + 100},{job['height'] + 100}", url],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            ended = session.ended.wait(seconds)
        finally:
            os.killpg(browser.pid, signal.SIGKILL)
            browser.wait()
            server.shutdown()
            server.server_close()
    if not ended:
        raise WebError(f"{job['engine']}: the page has not ended within {seconds} seconds")
    if session.failure:
        raise WebError(f"{job['engine']}: {session.failure}")
    return session
