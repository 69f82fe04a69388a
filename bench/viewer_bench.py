#!/usr/bin/python3
"""The viewer's speed in headless Chromium, the program's own engine beside it in the same run.

usage: viewer_bench.py BUILD_FOLDER [-o figures.json]
Needs culet and bench_viewer in the build folder, and Debian's chromium, chromium-driver, python3-selenium.
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

# Another worker beside the page's own, from the page's own parts.
CALLS = """
const [cases, done] = [arguments[0], arguments[arguments.length - 1]];
(async () => {
  const text = id => document.getElementById(id).textContent;
  const url = URL.createObjectURL(new Blob([text("culet-worker")], { type: "text/javascript" }));
  const worker = new Worker(url);
  let id = 0;
  const call = (name, args) => new Promise((resolve, reject) => {
    const mine = ++id;
    worker.addEventListener("message", function hear({ data }) {
      if (data.id !== mine) return;
      worker.removeEventListener("message", hear);
      if (data.ok) resolve(data); else reject(new Error(data.error));
    });
    worker.postMessage({ id: mine, call: name, ...args });
  });
  const begin = performance.now();
  await call("start", { engine: text("culet-engine").trim() });
  const results = [{ start_ms: performance.now() - begin }];
  for (const one of cases) {
    await call("open", { document: one.document, item: 0 });
    await call("set", one.set);
    const engine = [], whole = [];
    for (const draw of one.draws) {
      const sent = performance.now();
      const answer = await call("draw", draw);
      whole.push(performance.now() - sent);
      engine.push(answer.milliseconds);
    }
    results.push({ name: one.name, engine: engine.slice(1), whole: whole.slice(1) });
  }
  worker.terminate();
  done(results);
})().catch(error => done({ error: String(error) }));
"""


def browser(folder):
    options = Options()
    options.binary_location = "/usr/bin/chromium"
    for word in ["--headless=new", "--no-sandbox", "--use-angle=swiftshader",
                 "--enable-unsafe-swiftshader", "--disable-background-networking",
                 "--disable-component-update", "--disable-sync", "--no-first-run",
                 f"--user-data-dir={folder}"]:
        options.add_argument(word)
    return webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("-o", "--output")
    parser.add_argument("--repeats", type=int, default=15)
    arguments = parser.parse_args()
    native = json.loads(subprocess.run([os.path.join(arguments.build, "bench_viewer"),
                                        str(arguments.repeats)], check=True,
                                       capture_output=True).stdout)
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "brilliant.html")
        subprocess.run([os.path.join(arguments.build, "culet"), "view", "round-brilliant", "-q",
                        "-o", page], check=True)
        size = os.path.getsize(page)
        chromium = browser(os.path.join(folder, "profile"))
        try:
            chromium.set_script_timeout(300)
            chromium.get("file://" + page)
            first = None
            until = time.time() + 20
            while first is None and time.time() < until:
                first = chromium.execute_script(
                    "return document.getElementById('stage')?.dataset.firstPictureMs ?? null")
                time.sleep(0.05)
            drawn = chromium.execute_async_script(CALLS, native)
        finally:
            chromium.quit()
    if isinstance(drawn, dict):
        raise SystemExit(drawn["error"])
    figures = {"page_bytes": size, "first_picture_ms": first, "start_ms": drawn[0]["start_ms"],
               "pictures": []}
    print(f"page {size / 1e6:.2f} MB, first live picture after {first} ms, engine started in "
          f"{drawn[0]['start_ms']:.0f} ms")
    print(f"{'800 x 800, depth 8':<44}{'program':>10}{'browser':>10}{'with the way':>14}   ms")
    for one, other in zip(native, drawn[1:]):
        figures["pictures"].append({"name": one["name"], "program_ms": one["median_ms"],
                                    "browser_ms": statistics.median(other["engine"]),
                                    "browser_with_messages_ms": statistics.median(other["whole"]),
                                    "program_least_ms": one["least_ms"],
                                    "browser_least_ms": min(other["engine"])})
        print(f"{one['name']:<44}{one['median_ms']:>10.1f}{statistics.median(other['engine']):>10.1f}"
              f"{statistics.median(other['whole']):>14.1f}")
    if arguments.output:
        with open(arguments.output, "w", encoding="utf-8") as file:
            json.dump(figures, file, indent=2)
            file.write("\n")


main()
