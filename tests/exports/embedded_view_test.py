"""examples/web/index.html in Chromium: embedded_view_test.py CULET. The stone in its frame is drawn by the live view."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests" / "viewer"))
from viewer_pages import Browser  # noqa: E402

LIT = """
const canvas = document.querySelector('canvas');
if (!canvas || !canvas.width) return 0;
const copy = document.createElement('canvas');
copy.width = copy.height = 64;
const context = copy.getContext('2d');
context.drawImage(canvas, 0, 0, 64, 64);
return new Set(context.getImageData(0, 0, 64, 64).data).size;
"""

with tempfile.TemporaryDirectory() as work:
    folder = pathlib.Path(work)
    shutil.copy(SOURCE / "examples/web/index.html", folder)
    subprocess.run([sys.argv[1], "view", "round-brilliant", "--material", "diamond", "-o", folder / "stone.html"], check=True)
    with Browser(900, 900) as browser:
        driver = browser.driver
        driver.get((folder / "index.html").as_uri())
        driver.switch_to.frame(driver.find_element("tag name", "iframe"))
        end, levels = time.time() + 60, 0
        while levels < 30 and time.time() < end:
            time.sleep(0.5)
            levels = driver.execute_script(LIT)
        assert levels >= 30, f"the stone has {levels} levels of brightness"
        said = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert not said, said
print("the stone is drawn in the frame")
