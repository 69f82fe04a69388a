"""The studio's page in Chromium: an evening's readings by the keyboard alone. Expectations: docs/studio.md."""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests" / "viewer"))
from viewer_pages import Browser  # noqa: E402

CULET = pathlib.Path(sys.argv.pop(1)).resolve()
WAIT = "const wait = async (ready) => { for (let i = 0; i < 1500 && !ready(); ++i) await new Promise((r) => setTimeout(r, 20)); if (!ready()) throw new Error('waited in vain: ' + ready); };"


class StudioPageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(1280, 800).__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="culet-studio-"))

    def tearDown(self):
        # A refused edit is answered with 400, which Chromium tells too.
        errors = [error for error in self.browser.errors() if "/api/cells" not in error["message"]]
        self.browser.driver.get("about:blank")
        self.studio.send_signal(signal.SIGINT)
        self.assertEqual(self.studio.wait(10), 0, "Ctrl-C ends it well")
        self.studio.stdout.close()
        shutil.rmtree(self.folder)
        self.assertEqual(errors, [], "the console")

    def open(self, what):
        self.studio = subprocess.Popen([CULET, "studio", what, "--no-open", "-q"], stdout=subprocess.PIPE, text=True,
                                       env=dict(os.environ, XDG_STATE_HOME=str(self.folder / "state")))
        self.address = self.studio.stdout.readline().strip()
        self.browser.driver.get(self.address)

    def open_sample(self):
        shutil.copytree(SOURCE / "samples" / "cutters-evening", self.folder / "evening")
        self.open(self.folder / "evening" / "stone.toml")
        self.wait("studio.fit && studio.fit.fit && studio.sheet.table")

    def keys(self, *keys, held=None):
        chain = ActionChains(self.browser.driver)
        if held: chain.key_down(held)
        chain.send_keys(*keys)
        if held: chain.key_up(held)
        chain.perform()

    def wait(self, ready):
        self.browser.wait(f"{WAIT} await wait(() => {ready});")

    def here(self):
        return self.browser.run("return document.activeElement.getAttribute('aria-label')")

    def csv(self):
        return (self.folder / "evening" / "readings.csv").read_text()

    def test_the_slip_is_mended_by_the_keyboard_alone(self):
        self.open_sample()
        self.assertNotIn("token", self.browser.driver.current_url)
        self.assertEqual(self.here(), "value, row 1, inclination C1")
        self.wait("studio.fit.fit.status === 'contradictory'")
        self.keys(Keys.F2)
        self.assertEqual(self.here(), "value, row 5, inclination C5")
        described = self.browser.run("const i = document.activeElement; return [i.getAttribute('aria-invalid'), document.getElementById(i.getAttribute('aria-describedby')).textContent]")
        self.assertEqual(described[0], "true")
        self.assertIn("seven sisters", described[1])
        self.assertTrue(described[1].endswith("Write 33.8"))
        self.assertEqual(self.browser.run("return [...document.querySelectorAll('.facet.lit title')].map((t) => t.textContent.split(':')[0])"), ["C5"])
        self.keys(Keys.ENTER, held=Keys.ALT)
        self.wait("studio.fit.fit.status === 'converged' && studio.fit.revision === studio.sheet.table.revision")
        self.assertIn("inclination,C5,33.8,", self.csv())
        self.assertEqual(self.browser.run("return document.querySelectorAll('.flagged').length"), 0)
        self.keys("z", held=Keys.CONTROL)
        self.wait("studio.sheet.text(4, 'value') === '38.3'")
        self.assertIn("inclination,C5,38.3,", self.csv())

    def test_a_typo_is_marked_before_the_next_row_is_typed(self):
        """The flag is asked within 0.2 s; here within a second, since other tests run beside it."""
        self.open_sample()
        self.keys("333,8", Keys.ENTER)
        self.assertEqual(self.here(), "value, row 2, inclination C2")
        began = time.time()
        self.wait("studio.sheet.line(0).classList.contains('flagged')")
        self.assertLess(time.time() - began, 1)
        self.assertIn('inclination,C1,"333,8",', self.csv())
        self.keys(Keys.UP, "33,8", Keys.DOWN)
        self.wait("!studio.sheet.line(0).classList.contains('flagged')")

    def test_a_row_is_added_as_fast_as_one_types(self):
        self.open_sample()
        self.browser.run("studio.sheet.go_to(28, 'kind')")
        self.keys("width", Keys.TAB, "60", Keys.TAB, "6,51", Keys.TAB, "0,015", Keys.ENTER)
        self.wait("studio.sheet.text(28, 'sigma') === '0,015'")
        self.assertTrue(self.csv().endswith('\nwidth,60,"6,51","0,015",\n'), self.csv()[-60:])
        self.wait("document.activeElement.getAttribute('aria-label') === 'sigma, row 30, new row'")
        self.keys(Keys.UP)
        self.keys(Keys.DELETE, held=Keys.CONTROL)
        self.wait("studio.sheet.table.rows.length === 28")

    def test_rows_are_pasted_from_a_spreadsheet(self):
        self.open_sample()
        self.browser.run("""const data = new DataTransfer(); data.setData('text/plain', '33,9\\t0,2\\r\\n34,0\\t0,2\\r\\n');
            document.activeElement.dispatchEvent(new ClipboardEvent('paste', {clipboardData: data, bubbles: true, cancelable: true}));""")
        self.wait("studio.sheet.text(1, 'sigma') === '0,2'")
        self.assertIn('inclination,C1,"33,9","0,2",expected 33.80\ninclination,C2,"34,0","0,2",', self.csv())

    def test_a_facet_leads_to_its_row_and_no_name_becomes_html(self):
        shutil.copytree(SOURCE / "samples" / "cutters-evening", self.folder / "evening")
        stone = self.folder / "evening" / "stone.toml"
        stone.write_text(stone.read_text().replace("Round brilliant", "<img src=x onerror=alert(1)>"))
        self.open(stone)
        self.wait("studio.fit && studio.fit.fit")
        self.browser.run("studio.view.facets.get('P3')[0].dispatchEvent(new MouseEvent('click', {bubbles: true}))")
        self.assertEqual(self.here(), "value, row 11, inclination P3")
        self.assertEqual(self.browser.run("return document.querySelectorAll('img').length"), 0)
        self.assertIn("<img src=x", self.browser.run("return document.getElementById('title').textContent"))

    def test_the_bench_and_an_export_by_the_keyboard(self):
        self.open_sample()
        for screen in ("stone", "photograph", "cut", "bench"):
            self.keys(Keys.F8)
            self.wait(f"studio.screen === '{screen}'")
        self.wait("studio.bench.bench && studio.bench.bench.fitted")
        self.keys(" ")
        self.keys(" ")
        self.keys(Keys.BACKSPACE)
        self.wait("document.getElementById('step-count').textContent === 'Step 2 of 7 · 1 done'")
        self.browser.wait("await studio.bench.last")
        self.assertEqual((self.folder / "evening" / "stone-bench.txt").read_text(), "01 L\n")
        self.assertEqual(self.browser.run("return document.querySelectorAll('#bench-views .facet.lit').length"), 8)
        for width in (390, 1280):
            self.browser.resize(width, 800)
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)
        self.keys(Keys.F8)
        self.wait("studio.exports.file")
        self.browser.run("document.querySelector('[data-kind=step]').focus()")
        self.keys(Keys.ENTER)
        self.wait("document.querySelector('#file-line a') && !studio.exports.asked")
        until = time.time() + 20
        while not (saved := list(pathlib.Path(self.browser.folder).glob("*.step"))) and time.time() < until: time.sleep(0.1)
        self.assertTrue(saved and saved[0].read_text().startswith("ISO-10303-21"))
        self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 1280)

    def test_the_photograph_by_the_keyboard(self):
        """The sample's photograph matches (docs/photograph-against-render.md)."""
        shutil.copytree(SOURCE / "samples" / "dravite-step", self.folder / "dravite")
        self.open(self.folder / "dravite" / "stone.toml")
        self.wait("studio.fit && studio.fit.fit && studio.fit.fit.status === 'converged'")
        self.browser.run("location.hash = '#/photograph'")
        self.wait("studio.photograph.state && document.querySelector('#photos button')")
        self.browser.run("document.querySelector('#photos button').focus()")
        self.keys(Keys.ENTER)
        self.wait("document.querySelector('#photo-card .word') && document.querySelector('#photo-verdict .word')")
        self.assertIn("Laid on", self.browser.run("return document.querySelector('#photo-card .word').textContent"))
        self.browser.run("document.getElementById('photo-cancel').click()")
        self.wait("!studio.photograph.state.phase")
        # The page's outline is the program's: it spans what the photograph shows of the stone, and never mirrored.
        self.assertGreater(self.browser.run("""const p = studio.photograph, t = p.view.turn, x = projected(p.state.wire, p.view).map((c) => c[0]);
            const det = t[0] * (t[4] * t[8] - t[5] * t[7]) - t[1] * (t[3] * t[8] - t[5] * t[6]) + t[2] * (t[3] * t[7] - t[4] * t[6]);
            return Math.min(det, (Math.max(...x) - Math.min(...x)) / p.state.about.width)"""), 0.3)
        self.assertGreater(self.browser.run("return document.getElementById('stage-outline').getAttribute('d').length"), 50)
        before = self.browser.run("document.getElementById('stage').focus(); return structuredClone(studio.photograph.view)")
        self.keys(Keys.RIGHT, Keys.RIGHT, "+", "]")
        self.keys(Keys.DOWN, held=Keys.CONTROL)
        after = self.browser.run("return studio.photograph.view")
        self.assertGreater(after["at"][0], before["at"][0])
        self.assertEqual(after["at"][1], before["at"][1])
        self.assertAlmostEqual(after["scale"] / before["scale"], 1.02, 2)
        # Clockwise as seen, and the near side moved down.
        self.assertGreater(after["turn"][3] * before["turn"][0] - after["turn"][0] * before["turn"][3], 0.02)
        self.assertTrue(self.browser.run("return studio.photograph.placed"))
        self.keys("b")
        self.assertEqual(self.browser.run("return document.querySelector('#photo-report .blink').getAttribute('aria-pressed')"), "true")
        self.keys("b", Keys.ENTER)
        self.wait("!studio.photograph.placed && studio.photograph.state.found && document.querySelector('#photo-card .word')")
        for width in (390, 1280):
            self.browser.resize(width, 800)
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)
        self.browser.run("document.getElementById('photo-cancel').click()")

    def test_another_programs_change_is_asked_about(self):
        self.open_sample()
        theirs = self.csv().replace("C1,33.8", "C1,33.4")
        (self.folder / "evening" / "readings.csv").write_text(theirs)
        self.wait("!document.getElementById('outside').hidden")
        self.keys("33.5", Keys.ENTER)
        self.wait("studio.sheet.cell(0, 'value').classList.contains('unsaved')")
        self.assertEqual(self.csv(), theirs)
        self.browser.run("document.getElementById('take-other').click()")
        self.wait("studio.sheet.text(0, 'value') === '33.4'")

    def violations(self):
        """Of WCAG and good practice, on the screen as it is: axe-core's own rules. The stone and the grade are pages of
        their own, in frames that have no origin."""
        return self.browser.run("""const found = await axe.run({iframes: false});
            return found.violations.map((v) => `${v.id}: ${v.nodes[0].html.slice(0, 120)}`)""")

    def test_no_screen_bars_people_in_the_dark_or_on_a_phone(self):
        self.open(self.folder)
        self.wait("document.querySelector('#cut-views svg') && document.querySelector('#samples button')")
        media = lambda scheme: self.browser.driver.execute_cdp_cmd(
            "Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
        self.browser.driver.execute_script((SOURCE / "tests" / "viewer" / "axe.min.js").read_text())
        screens = ["begin"]
        while screens:
            for screen in screens:
                if screen != "begin": self.browser.run(f"location.hash = '#/{screen}'")
                self.wait(f"!document.getElementById('{screen}').hidden")
                if screen == "cut": self.wait("studio.cut.rows")
                if screen == "bench": self.wait("document.querySelector('#bench-views svg')")
                for scheme in ("light", "dark"):
                    media(scheme)
                    for width in (1280, 390):
                        self.browser.resize(width, 800)
                        self.assertEqual(self.violations(), [], f"{screen}, {scheme}, {width} px")
                        self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width, screen)
            if screens != ["begin"]: break
            self.browser.run("document.querySelector('#samples button').click()")
            self.wait("studio.fit && studio.fit.fit && document.querySelector('#sheet .flagged')")
            screens = self.browser.run("return [...document.querySelectorAll('#screens a')].map((a) => a.hash.slice(2))")
        self.browser.run("document.getElementById('help').showModal()")
        self.assertEqual(self.violations(), [], "the keys")
        media("")
        self.browser.resize(1280, 800)

    def test_a_cut_is_tried_by_the_keyboard_and_the_stone_turns(self):
        self.open_sample()
        self.browser.run("location.hash = '#/cut'")
        self.wait("studio.cut.rows")
        self.browser.run("studio.cut.rows[0].slider.focus()")
        self.keys(Keys.LEFT)
        self.wait("studio.cut.cut.undo.startsWith('Height of the crown')")
        self.browser.run("document.getElementById('cut-undo').click()")
        self.wait("studio.cut.cut.at === 0")
        self.browser.run("location.hash = '#/stone'")
        self.wait("document.getElementById('stone-frame').src.includes('/view?shown=')")
        self.browser.driver.switch_to.frame("stone-frame")
        until = time.time() + 60
        drawn = lambda: self.browser.driver.execute_script("return document.readyState === 'complete' && document.title")
        while not drawn() and time.time() < until: time.sleep(0.1)
        self.assertIn("Round brilliant", drawn())
        self.assertEqual(self.browser.driver.execute_script("return self.origin"), "null")
        self.browser.wait("while (typeof culet_page === 'undefined' || !culet_page.ready()) await new Promise((r) => setTimeout(r, 50));")
        self.browser.rest()
        # The program is its engine; the frame has none running of its own.
        self.assertEqual(self.browser.run("return [culet_page.engine.worker instanceof Worker, document.getElementById('trouble').hidden]"), [False, True])
        self.browser.driver.switch_to.default_content()

    def test_words_choose_the_sliders(self):
        self.open(self.folder)
        self.wait("document.querySelector('#cut-views svg')")
        self.browser.run("document.getElementById('words').focus()")
        self.keys("9 x 7,5 oval, blue sapphire", Keys.ENTER)
        self.wait("document.getElementById('cut-material').value === 'sapphire_blue'")
        self.assertEqual(self.browser.run("return ['width', 'ratio'].map((n) => document.querySelector(`[data-name=${n}]`).value)"), ["7.5", "1.2"])
        self.wait("document.activeElement.id === 'cut-make'")
        self.keys(Keys.ENTER)
        self.wait("studio.sheet.table")
        self.assertIn('material = "sapphire_blue"', (self.folder / "oval" / "stone.toml").read_text())

    def test_begin_makes_a_folder_and_all_widths_fit(self):
        self.open(self.folder)
        self.wait("document.querySelector('#cut-views svg')")
        for width in (1280, 390):
            self.browser.resize(width, 800)
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)
        self.browser.run("document.querySelector('#cut-form button').click()")
        self.wait("studio.sheet.table && document.querySelector('#views svg')")
        self.assertTrue((self.folder / "round-brilliant" / "stone.toml").exists())
        self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 390)
        self.browser.resize(1280, 800)
        # Every control has a name.
        self.assertEqual(self.browser.run("""return [...document.querySelectorAll('main:not([hidden]) :is(input, select, button), header button')]
            .filter((c) => !c.hidden && !c.getAttribute('aria-label') && !(c.labels && c.labels.length) && !c.textContent.trim()).length"""), 0)


if __name__ == "__main__":
    unittest.main()
