"""Pictures of the studio for its tutorial: studio.py CULET FOLDER. The first stone from its beginning to the bench."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests" / "viewer"))
from viewer_pages import Browser  # noqa: E402

culet, pictures = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
WAIT = "const wait = async (ready) => { for (let i = 0; i < 3000 && !ready(); ++i) await new Promise((r) => setTimeout(r, 20)); if (!ready()) throw new Error('waited in vain: ' + ready); };"


def main(browser, folder):
    wait = lambda ready: browser.wait(f"{WAIT} await wait(() => {ready});")
    fitted = "studio.fit.fit && !studio.fit.runs && studio.fit.revision === studio.sheet.table.revision"
    def shot(name):
        time.sleep(0.5)
        browser.shot(str(pictures / f"{name}.png"))

    def show(screen, ready):
        browser.run(f"location.hash = '#/{screen}'; scrollTo(0, 0)")
        wait(ready)

    wait("document.querySelector('#cut-views svg')")
    browser.run("document.getElementById('words').value = '6,52 mm brilliant, table 58, crown angle 33,8, pavilion angle 41,1, diamond'; document.getElementById('words-form').requestSubmit()")
    wait("document.getElementById('cut-material').value === 'diamond'")
    browser.run("scrollTo(0, 0)")
    shot("begin")
    browser.run("[...document.querySelectorAll('#samples button')][0].click()")
    wait("studio.sheet && studio.sheet.table && studio.fit && studio.fit.fit && document.querySelector('#sheet .flagged')")
    browser.run("studio.sheet.go_to(4, 'value')")
    shot("slip")
    browser.run("document.querySelector('.why button').click()")
    wait(f"{fitted} && studio.fit.fit.status === 'converged'")
    browser.run("document.querySelector('[name=paint][value=sigma]').click(); studio.sheet.go_to(10, 'value'); scrollTo(0, 0)")
    shot("fitted")
    show("stone", "document.getElementById('stone-frame').src")
    time.sleep(12)  # the stone's last refinement
    shot("stone")
    # A photograph, simulated: as dealers photograph stones.
    stone = pathlib.Path(folder) / "cutters-evening"
    subprocess.run([culet, "render", stone / "stone.toml", "--light", "photograph", "--size", "900,700", "-q",
                    "-o", stone / "simulated-photo.png"], check=False)
    show("photograph", "document.querySelector('#photos button')")
    browser.run("document.querySelector('#photos button').click()")
    wait("document.querySelector('#photo-card .word') && document.querySelector('#photo-verdict .word')")
    browser.run("document.getElementById('photo-cancel').click(); document.getElementById('photo-stage').scrollIntoView()")
    shot("photograph")
    show("cut", "studio.cut.rows")
    browser.run("studio.cut.turn(0, 13.4, true)")
    wait("studio.cut.cut.at === 1")
    shot("cut")
    show("bench", "document.querySelector('#bench-views .facet.lit')")
    shot("bench")


with tempfile.TemporaryDirectory(prefix="my-stones-") as folder, Browser(1180, 760) as browser:
    studio = subprocess.Popen([culet, "studio", folder, "--no-open", "-q"], stdout=subprocess.PIPE, text=True,
                              env=dict(os.environ, XDG_STATE_HOME=folder + "/.state"))
    try:
        browser.driver.get(studio.stdout.readline().strip())
        main(browser, folder)
    finally:
        browser.driver.get("about:blank")
        studio.send_signal(signal.SIGINT)
        studio.wait(10)
