"""The Python module against the program: same input, same answer. CTest runs it; by hand:
PYTHONPATH=build/python CULET=build/culet /usr/bin/python3 -m unittest discover tests/python"""

import ast
import inspect
import json
import os
import pickle
import signal
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import culet

ROOT = Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "samples"
PROGRAM = os.environ.get("CULET", str(ROOT / "build" / "culet"))
EVENING = SAMPLES / "cutters-evening" / "mended.toml"
GARNET = SAMPLES / "effects" / "garnet-depth.toml"


def program(*arguments):
    """Runs the program on the same input. Its exit code may be 1: not to be trusted."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    return done


def without_times(report):
    """A report without what differs from run to run."""
    if isinstance(report, dict):
        return {k: without_times(v) for k, v in report.items() if not k.startswith("seconds")}
    return [without_times(v) for v in report] if isinstance(report, list) else report


class Scratch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Stones(Scratch):
    def test_have_arrays_of_their_facets(self):
        stone = culet.load(EVENING)
        count = len(stone.facets)
        self.assertEqual(stone.normals.shape, (count, 3))
        np.testing.assert_allclose(np.linalg.norm(stone.normals, axis=1), 1, atol=1e-12)
        # The divergence theorem over triangles: an independent sum of the volume.
        corners, facet = stone.triangles
        a, b, c = (stone.vertices[corners[:, i]] for i in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        self.assertAlmostEqual(volume / stone.volume, 1, 9)
        area = np.bincount(facet, np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)
        np.testing.assert_allclose(area, stone.areas, rtol=1e-9)

    def test_are_made_of_planes(self):
        normals = np.vstack([np.eye(3), -np.eye(3)])
        cube = culet.Stone.of_planes(3 * normals, 3 * np.ones(6), names=list("ABCDEF"))
        self.assertEqual(cube.facets, list("ABCDEF"))
        self.assertAlmostEqual(cube.volume, 8, 12)
        self.assertIsNone(cube.material)
        self.assertEqual(cube.with_material("diamond").material, "diamond")
        with self.assertRaisesRegex(culet.InputError, "open"):
            culet.Stone.of_planes(normals[:3], np.ones(3))
        with self.assertRaisesRegex(culet.InputError, "finite"):
            culet.Stone.of_planes(normals, [1, 1, np.nan, 1, 1, 1])

    def test_are_written_and_read_back(self):
        stone = culet.load(EVENING)
        stone.save(self.folder / "stone.obj")
        again = culet.load(self.folder / "stone.obj")
        self.assertEqual(again.facets, stone.facets)
        np.testing.assert_allclose(again.vertices, stone.vertices, rtol=1e-9, atol=1e-9)

    def test_say_what_is_wrong_with_a_file(self):
        bad = self.folder / "bad.toml"
        bad.write_text('[stone]\nmesh = "none.obj"\n')
        for file in (bad, self.folder / "none.toml", self.folder / "none.obj"):
            with self.assertRaises(culet.InputError) as caught:
                culet.load(file)
            self.assertIn("none.", str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))
        self.assertTrue(issubclass(culet.InputError, ValueError))


class Fits(Scratch):
    def test_are_those_of_the_program(self):
        fit = culet.fit(culet.load(EVENING))
        program("fit", EVENING, "-o", self.folder / "f.obj", "--report", self.folder / "f.json")
        report = json.loads((self.folder / "f.json").read_text())
        self.assertEqual(without_times(fit.report), without_times(report))
        self.assertTrue(fit.usable)

    def test_give_sigmas_that_are_those_of_the_covariance(self):
        fit = culet.fit(EVENING)
        count = len(fit.facets)
        self.assertEqual(fit.covariance.shape, (3 * count, 3 * count))
        np.testing.assert_allclose(fit.covariance, fit.covariance.T, rtol=1e-9, atol=1e-12)
        # The report's rows are rounded; the sigmas are not.
        np.testing.assert_allclose(
            np.sqrt(np.diag(fit.covariance))[::3], fit.sigma_inclinations, rtol=1e-6)
        self.assertTrue(fit.stone.has_uncertainty)

    def test_take_readings_from_python(self):
        drawn = culet.load(EVENING)
        again = drawn.with_readings(drawn.readings)
        self.assertEqual(len(again.readings), len(drawn.readings))
        with self.assertRaisesRegex(culet.InputError, "readings:2: no key"):
            drawn.with_readings([{"kind": "weight", "value": 1.0}, {"kynd": "weight"}])
        with self.assertRaisesRegex(culet.InputError, "no readings"):
            culet.fit(drawn.with_readings([]))
        with self.assertRaisesRegex(culet.InputError, "exact, soft, released"):
            culet.fit(drawn, meets="loose")


class Pictures(Scratch):
    def test_are_those_of_the_program(self):
        picture = culet.render(GARNET, size=60, engine="beams")
        self.assertEqual(picture.shape, (60, 60, 3))
        self.assertEqual(picture.dtype, np.float32)
        program("render", GARNET, "--size", 60, "--engine", "beams", "-o", self.folder / "p.exr")
        written = culet.load(self.folder / "p.exr")
        np.testing.assert_array_equal(np.asarray(picture), np.asarray(written))
        self.assertIn("error_bound", picture.stats)

    def test_have_spectra_and_stokes_vectors(self):
        scene = culet.load(SAMPLES / "effects" / "brewster.toml")
        picture = culet.render(scene, size=24, spectral=True)
        bands = len(picture.wavelengths_nm)
        self.assertEqual(picture.spectral.shape, (bands, 24, 24))
        self.assertEqual(picture.stokes.shape, (4, bands, 24, 24))
        np.testing.assert_array_equal(picture.stokes[0], picture.spectral)
        # No light is polarised by more than 100 %, up to rounding of half floats and of sums of
        # paths.
        s0, rest = picture.stokes[0], picture.stokes[1:]
        self.assertTrue((np.sqrt((rest**2).sum(0)) <= s0 * (1 + 1e-5) + 1e-6).all())
        self.assertGreater(np.abs(rest).max(), 0)

    def test_show_themselves_and_are_kept(self):
        picture = culet.render(GARNET, size=30, engine="beams")
        self.assertEqual(picture._repr_png_()[:8], b"\x89PNG\r\n\x1a\n")
        picture.save(self.folder / "p.exr")
        again = culet.load(self.folder / "p.exr")
        np.testing.assert_array_equal(np.asarray(again), np.asarray(picture))
        np.testing.assert_allclose(again.coverage, picture.coverage, atol=1e-3)
        # Slices are plain arrays: attributes of the whole picture do not carry over.
        self.assertIsNone((2 * picture[:10]).coverage)
        copy = pickle.loads(pickle.dumps(picture))
        np.testing.assert_array_equal(copy.coverage, picture.coverage)
        self.assertEqual(copy.stats, picture.stats)

    def test_show_what_the_readings_leave_open(self):
        fit = culet.fit(EVENING)
        picture = culet.render(fit, size=40, engine="beams", light="jeweller", uncertainty=fit,
                               draws=4, tolerance=0.2)
        self.assertGreater(picture.planes["sigma.Y"].max(), 0)
        self.assertTrue((picture.planes["p16.Y"] <= picture.planes["p84.Y"]).all())

    def test_of_another_stone_in_a_scene(self):
        scene = culet.load(GARNET)
        stone = culet.load(SAMPLES / "effects" / "step.obj", material="ruby_gem")
        other = culet.render(scene, stone=stone, size=40, engine="beams")
        self.assertFalse(np.array_equal(other, culet.render(scene, size=40, engine="beams")))
        with self.assertRaisesRegex(culet.InputError, "material"):
            culet.render(culet.load(SAMPLES / "effects" / "step.obj"))
        with self.assertRaisesRegex(culet.InputError, "engine"):
            culet.render(scene, engine="magic")


class Grades(Scratch):
    def test_are_those_of_the_program(self):
        stone = culet.load(SAMPLES / "studies" / "brilliant.obj", material="diamond")
        grade = culet.grade(stone, tilts=[0, 10])
        program("grade", SAMPLES / "studies" / "brilliant.obj", "--material", "diamond", "--tilts",
                "0,10", "--json", self.folder / "g.json")
        report = json.loads((self.folder / "g.json").read_text())
        design = report["designs"][0] if "designs" in report else report
        for key in ("face_up", "aset", "tilts"):
            if key in design:
                self.assertEqual(grade[key], design[key], key)
        with self.assertRaisesRegex(culet.InputError, "index"):
            culet.grade(culet.load(SAMPLES / "studies" / "brilliant.obj"))

    def test_of_a_fit_have_sigmas(self):
        fit = culet.fit(EVENING)
        self.assertIn("sigma", json.dumps(culet.grade(fit, tilts=[0], draws=2).report))


class Comparisons(Scratch):
    PHOTO = SAMPLES / "dravite-step" / "simulated-photo.png"

    def test_of_a_picture_with_itself_match(self):
        # A picture against itself: correlation 1.
        compared = culet.compare(self.PHOTO, self.PHOTO)
        self.assertEqual(compared.verdict, "match")
        program("compare", self.PHOTO, self.PHOTO, "-o", self.folder, "--json",
                self.folder / "c.json")
        scores = json.loads((self.folder / "c.json").read_text())
        self.assertEqual(without_times(compared.scores), without_times(scores))
        self.assertIn("similarity", compared.maps)
        compared.save(self.folder / "page.html")
        self.assertIn("<html", (self.folder / "page.html").read_text())

    def test_take_arrays(self):
        picture = culet.render(GARNET, size=120, engine="beams")
        compared = culet.compare(np.asarray(picture), picture, mask=picture.coverage > 0.5)
        self.assertEqual(compared.verdict, "match")
        with self.assertRaisesRegex(culet.InputError, r"\(120, 120\)"):
            culet.compare(picture, picture, mask=np.ones((3, 3)))


class LongWork(Scratch):
    def test_tells_how_far_it_is_and_lets_others_run(self):
        told, ticks = [], []
        ended = threading.Event()

        def count():
            while not ended.is_set():
                ticks.append(time.perf_counter())
                time.sleep(0.01)

        other = threading.Thread(target=count)
        other.start()
        culet.render(GARNET, size=800, tolerance=0.002, progress=told.append)
        ended.set()
        other.join()
        self.assertTrue(told and all(0 <= f <= 1 for f in told))
        # Another thread ran meanwhile, which it could not if the lock were held.
        self.assertGreater(len(ticks), 5)

    def test_tells_of_short_work_too(self):
        told = []
        culet.render(GARNET, size=8, tolerance=0.2, progress=told.append)
        self.assertTrue(told)

    def test_ends_where_progress_says_so(self):
        with self.assertRaises(culet.Interrupted):
            culet.render(GARNET, size=800, tolerance=0.002, progress=lambda done: False)
        with self.assertRaisesRegex(KeyError, "mine"):
            def fails(done):
                raise KeyError("mine")
            culet.render(GARNET, size=800, tolerance=0.002, progress=fails)

    def test_ends_with_control_c(self):
        timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(100):
                culet.render(GARNET, size=600, tolerance=0.001)


class Words(unittest.TestCase):
    def test_everything_public_is_described(self):
        for name in culet.__all__:
            thing = getattr(culet, name)
            self.assertTrue((thing.__doc__ or "").strip(), name)
            if not inspect.isclass(thing):
                continue
            for member, value in vars(thing).items():
                if isinstance(value, property) and thing is not culet.Picture and member != "name":
                    self.assertTrue((value.__doc__ or "").strip(), f"{name}.{member}")

    def test_stubs_are_those_of_the_module(self):
        from culet import _culet
        tree = ast.parse((Path(_culet.__file__).parent / "_culet.pyi").read_text())
        stubs = {node.name: node for node in tree.body
                 if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        public = {name for name in vars(_culet) if not name.startswith("_")} - {"version"}
        self.assertEqual(set(stubs), public)
        for name, node in stubs.items():
            if not isinstance(node, ast.ClassDef):
                continue
            members = {m.name for m in node.body if isinstance(m, ast.FunctionDef)} | {
                m.target.id for m in node.body if isinstance(m, ast.AnnAssign)}
            own = {m for m in vars(getattr(_culet, name)) if not m.startswith("_")}
            self.assertEqual(members, own, name)


if __name__ == "__main__":
    unittest.main()
