"""Every kind of page that the other tests make, with hostile names, on a telephone's screen and on
paper."""
import base64
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "viewer"))
from viewer_pages import Browser  # noqa: E402

# PROGRAM or PROGRAM=FILTER: tests that make pages.
PROGRAMS = [argument.partition("=")[::2] for argument in sys.argv[1:]]
del sys.argv[1:]


class PagesInBrowserTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="culet-kept-pages-"))
        for program, tests in PROGRAMS:
            subprocess.run([program, f"--gtest_filter={tests or '*'}"], check=True, capture_output=True, env={**os.environ, "CULET_KEPT_PAGES": str(cls.folder)})
        cls.pages = sorted(cls.folder.glob("*.html"))
        cls.browser = Browser(390, 844).__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def test_no_page_is_wider_than_a_telephone(self):
        self.assertGreaterEqual(len(self.pages), 9, self.pages)
        for page in self.pages:
            with self.subTest(page=page.name):
                self.browser.open(page)
                self.browser.run("for (const part of document.querySelectorAll('details')) part.open = true")
                self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 390)
                # What overflows a scrollable box of its own can be reached.
                cut = self.browser.run("""return [...document.querySelectorAll('main *')].filter((e) =>
                    e.getBoundingClientRect().right > 391 && !e.closest('.scroll, svg, pre')).map((e) => e.outerHTML.slice(0, 80))""")
                self.assertEqual(cut, [])
                self.assertNotEqual(self.browser.run("return document.title"), "x", "foreign text was run as a script")

    def test_paper_says_when_it_was_printed(self):
        for page in self.pages:
            # A certificate bears its own date.
            if page.name.startswith("certificate"):
                continue
            with self.subTest(page=page.name):
                self.browser.open(page)
                self.browser.run("dispatchEvent(new Event('beforeprint'))")
                said = self.browser.run("return document.querySelector('.printed').textContent")
                self.assertIn(str(self.browser.run("return new Date().getFullYear()")), said)

    def test_cutting_sheets_and_certificates_are_one_sheet_of_paper(self):
        # Every page of a PDF is an object of type Page. Points: 595 x 842 is A4, 612 x 792 letter.
        for name, width in [("cutting-sheet-on-paper", 595), ("certificate", 595), ("certificate-letter", 612)]:
            with self.subTest(page=name):
                self.browser.open(self.folder / (name + ".html"))
                pdf = base64.b64decode(self.browser.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"])
                self.assertEqual(len(re.findall(rb"/Type\s*/Page\b", pdf)), 1)
                box = re.search(rb"/MediaBox\s*\[0 0 ([\d.]+)", pdf)
                self.assertAlmostEqual(float(box[1]), width, delta=1)

    def test_nothing_of_a_certificate_is_cut_off(self):
        self.browser.open(self.folder / "certificate.html")
        self.browser.resize(720, 1000)
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        whole, shown = self.browser.run("const s = document.querySelector('.sheet'); return [s.scrollHeight, s.clientHeight]")
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        self.browser.resize(390, 844)
        self.assertEqual(whole, shown)


if __name__ == "__main__":
    unittest.main()
