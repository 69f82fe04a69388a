"""Pages of the viewer for the tests, with a stand-in for the engine or as culet wrote them; and a
browser to open them in."""
import base64
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGE = SOURCE / "viewer" / "page"


def made_up_stone(role="stone", pavilion_deg=41.0, fitted=False, table=1.7):
    """A table, eight crown, eight girdle and eight pavilion facets: closed, convex, 25 facets."""
    r, crown, girdle = 3.0, 1.0, 0.15
    depth = r * math.tan(math.radians(pavilion_deg))
    ring = lambda radius, z: [[radius * math.cos(math.radians(45 * i + 22.5)),
                               radius * math.sin(math.radians(45 * i + 22.5)), z] for i in range(8)]
    vertices = ring(table, crown + girdle) + ring(r, girdle) + ring(r, -girdle) + [[0, 0, -girdle - depth]]
    facets = [("T", list(range(8)))]
    for i in range(8):
        j = (i + 1) % 8
        facets += [(f"C{j + 1}", [8 + i, 8 + j, j, i]), (f"G{j + 1}", [16 + i, 16 + j, 8 + j, 8 + i]),
                   (f"P{j + 1}", [24, 16 + j, 16 + i])]

    def plane(corners):
        a, b, c = (vertices[k] for k in corners[:3])
        u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        length = math.sqrt(sum(x * x for x in n))
        n = [x / length for x in n]
        return n, sum(n[i] * a[i] for i in range(3))

    stone = {"role": role, "name": "made-up eight", "unit": "mm", "vertices": vertices, "convex": True, "up": [0, 0, 1],
             "facets": [dict(zip(("normal", "offset"), plane(c)), name=name, corners=c) for name, c in facets],
             "crystal": [[0, 0, 1], [1, 0, 0], [0, 1, 0]], "material": {"name": "diamond", "optic": "isotropic"},
             "cut": {"kind": "eight", "values": {"crown-angle": 34}}}
    if fitted:
        stone["fit"] = [{"inclination_deg": 34.5 + 0.01 * i, "azimuth_deg": 45.0 * i % 360, "inclination_sigma_deg": 0.02,
                         "azimuth_sigma_deg": 0.15, "direction_sigma_deg": 0.03 + 0.02 * i, "residual": 0.2 * i,
                         "reading": f"r{i}", "readings": 3, "suspect": i == 20, "determined": i != 5} for i in range(25)]
    return stone


def small_png(rgb):
    """A PNG of 8 x 8 pixels of one colour."""
    rows = b"".join(b"\0" + bytes(rgb) * 8 for _ in range(8))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 8, 8, 2, 0, 0, 0)) \
        + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def made_up_document(items=1, two=False):
    stones = [made_up_stone("catalogue", 40.0, table=1.5), made_up_stone("fitted", 41.5, True)] if two else [made_up_stone()]
    picture = lambda i: "data:image/png;base64," + base64.b64encode(small_png((40 + 40 * i, 90, 120))).decode()
    return {"schema": "culet-view-1", "title": "Made-up stones", "version": "0", "first": 0,
            "items": [{"name": f"Made-up eight {i + 1}", "stones": stones, "scene": "", "files": {}, "picture": picture(i),
                       "command": "culet render eight.obj"} for i in range(items)]}


def page_text(document, worker=None, engine="stand-in"):
    """The template, filled as viewer_page.cpp fills it."""
    scripts = [(PAGE / name).read_text() for name in (PAGE / "scripts.txt").read_text().split()]
    document = json.loads(json.dumps(document))
    picture, document["items"][0]["picture"] = document["items"][0]["picture"], ""
    worker = (pathlib.Path(__file__).parent / "stand_in_worker.js").read_text() if worker is None else worker
    values = {"title": document["title"], "picture": picture, "engine": engine, "worker_js": worker,
              "viewer_css": (PAGE / "viewer.css").read_text(), "viewer_js": "".join(scripts),
              "document_json": json.dumps(document).replace("</", "<\\/")}
    template = (PAGE / "templates" / "viewer.html.mustache").read_text()
    return re.sub(r"\{\{\{?(\w+)\}?\}\}", lambda m: values[m.group(1)], template)


class Browser:
    """Headless Chromium through chromedriver; `errors` are its console's errors."""

    def __init__(self, width=1280, height=800, options=()):
        self.folder = tempfile.mkdtemp(prefix="culet-viewer-")
        chrome = Options()
        chrome.binary_location = "/usr/bin/chromium"
        for argument in ("--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
                         "--hide-scrollbars", "--force-prefers-reduced-motion", "--force-device-scale-factor=1", f"--user-data-dir={self.folder}/profile", *options):
            chrome.add_argument(argument)
        chrome.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=chrome)
        self.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": self.folder})
        self.driver.set_script_timeout(60)
        self.resize(width, height)

    def resize(self, width, height):
        # Headless Chromium's window is wider than 500; this sets the page's own size.
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()
        shutil.rmtree(self.folder, ignore_errors=True)

    def open(self, path, fragment=""):
        self.driver.get("about:blank")
        self.driver.get(pathlib.Path(path).resolve().as_uri() + ("#" + fragment if fragment else ""))

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, script):
        """The result of an async script's promise."""
        answer = self.driver.execute_async_script(
            "const done = arguments[arguments.length - 1];"
            f"(async () => {{ {script} }})().then((v) => done([v ?? null]), (e) => done({{error: String(e && e.stack || e)}}));")
        if isinstance(answer, dict):
            raise AssertionError(answer["error"])
        return answer[0]

    def rest(self):
        """Waits until the full picture is drawn."""
        self.wait("while (!culet_page.ready() && document.getElementById('trouble').hidden) await new Promise((r) => setTimeout(r, 20));"
                  "await new Promise((r) => setTimeout(r, 30)); await culet_page.loop.idle();")

    def picture(self):
        """The canvas as a list [width, height, hash]; the hash changes when a pixel does."""
        return self.wait("""const c = document.getElementById(culet_page.gpu.shown ? 'gpu-picture' : 'picture');
            const copy = document.createElement('canvas'); copy.width = c.width; copy.height = c.height;
            const t = copy.getContext('2d'); t.drawImage(c, 0, 0);
            const d = t.getImageData(0, 0, c.width, c.height).data;
            let h = 2166136261; for (const v of d) h = Math.imul(h ^ v, 16777619);
            return [c.width, c.height, h >>> 0];""")

    def errors(self):
        return [entry for entry in self.driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]

    def shot(self, path):
        pathlib.Path(path).parent.mkdir(parents=True, exist_ok=True)
        pathlib.Path(path).write_bytes(base64.b64decode(
            self.driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"]))
