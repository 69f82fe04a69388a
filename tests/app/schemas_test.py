"""Every JSON that culet writes is as its schema in docs/schemas says, whole: keys that a schema does not know are
faults. Expectation: the schemas, which say of themselves by which command each is written."""
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import jsonschema

CULET, APP_TESTS, SPIN_TESTS = sys.argv[1:4]
del sys.argv[1:]
SOURCE = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = SOURCE / "samples"
SCHEMAS = {file.stem: json.loads(file.read_text()) for file in sorted((SOURCE / "docs/schemas").glob("*.json"))}
STORE = {schema["$id"]: schema for schema in SCHEMAS.values()}

# Scenes and stones that between them have most keys.
COMMANDS = """
cut round-brilliant --diameter 6.5 --material diamond -o start.obj --json cut.json
cut emerald -o emerald.asc --json cut-2.json
cut oval -o oval.asc
setting start.obj -o metal.obj --json setting.json
info start.obj --json info-1.json
info emerald.asc --cutting-list --json info-2.json
info SAMPLES/dravite-step/stone.toml --json info-3.json
info SAMPLES/instruments/dichroscope.toml --json info-4.json
info SAMPLES/dravite-step/job.toml --json info-5.json
info SAMPLES/dravite-step/simulated-photo.png --json info-6.json
info emerald.asc --diff oval.asc --json info-7.json
info --materials --json materials.json
fit SAMPLES/cutters-evening/stone.toml -o slip.obj --report fit-1.json
fit SAMPLES/cutters-evening/mended.toml -o mended.obj --report fit-2.json
fit SAMPLES/real-brilliant/stone.toml -o real.obj --report fit-3.json --find-symmetry
fit SAMPLES/cutters-evening/stone.toml -o loss.obj --report fit-4.json --set fit.loss=huber
render start.obj --material diamond --size 48 --verify -o p.png --stats stats-1.json
render SAMPLES/effects/tourmaline-along.toml --set camera.size=[40,40] --engine reference --depth 4 -o r.exr --stats stats-2.json
render start.obj --material diamond --size 48 --explain --stats plan.json
probe SAMPLES/effects/tourmaline-along.toml --ray 0.1,0.05,40,0,0,-1 --json probe-1.json
probe SAMPLES/effects/garnet-depth.toml --pixel 0,0 --json probe-2.json
grade mended.obj --material quartz --report fit-2.json --draws 3 --tilts 0 --json grade.json
grade oval.asc emerald.asc --material diamond --tilts 0 --json grades.json
optimize emerald.asc --material quartz --evaluations 40 -o better.asc --json optimize.json
batch list.csv -o batch --tilts 0 --draws 2
batch --merge batch
study SAMPLES/cutters-evening/mended.toml --budget 2 --draws 2 -o study-1
study SAMPLES/effects/garnet-depth.toml --budget 2 -o study-2
compare SAMPLES/dravite-step/simulated-photo.png SAMPLES/dravite-step/simulated-photo.png -o report --json scores.json
render SAMPLES/cutters-evening/scene.toml -o parallel.exr --size 120
register parallel.exr SAMPLES/cutters-evening/scene.toml -o posed.toml --json pose-parallel.json
outline FRAMES --step 30 --pixel 0.02 -o contours.json
"""
FRAMES = " ".join(f"turn-{frame:02}.png" for frame in range(12))
# Of tests that make what these commands read: balls, shots, views, frames on a turntable.
TESTS = [(APP_TESTS, "LightAndPhoto.TwoBalls*:LightAndPhoto.Exposures*:Register.Writes*:RefineCommand.Finds*"),
         (SPIN_TESTS, "SpinCommand.Writes*")]


def write_png(file, rows):
    """Grey, eight bits."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    size = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows))
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def write_inputs(folder):
    (folder / "list.csv").write_text(f"stone\n{SAMPLES}/cutters-evening/stone.toml\noval.asc\nmissing.asc\n")
    for frame, half in enumerate((60, 72, 65, 40, 65, 72) * 2):  # a box on a turntable, before a bright wall
        box = b"\xf0" * (100 - half) + b"\x08" * (2 * half) + b"\xf0" * (100 - half)
        write_png(folder / f"turn-{frame:02}.png", [b"\xf0" * 200] * 40 + [box] * 120 + [b"\xf0" * 200] * 40)


def faults(schema, thing):
    resolver = jsonschema.RefResolver(schema["$id"], schema, STORE)
    return [f"/{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}"
            for e in jsonschema.Draft202012Validator(schema, resolver=resolver).iter_errors(thing)]


class SchemasTest(unittest.TestCase):
    def test_schemas_are_schemas_and_closed(self):
        def check(part, where):
            if isinstance(part, dict):
                if "properties" in part and part.get("type") != "string":
                    self.assertIn("additionalProperties", part, where)
                for key, value in part.items():
                    check(value, f"{where}/{key}")
        for name, schema in SCHEMAS.items():
            jsonschema.Draft202012Validator.check_schema(schema)
            self.assertEqual(schema["$id"], f"urn:culet:{name}:{schema['properties']['schema']['const']}")
            check(schema, name)

    def test_help_names_every_schema_and_prints_it(self):
        listed = subprocess.run([CULET, "help", "json"], check=True, capture_output=True, text=True).stdout
        for name, schema in SCHEMAS.items():
            self.assertRegex(listed, rf"(?m)^  {name} +{re.escape(schema['title'])}$")
            self.assertIn(schema["$comment"], listed)
            command = schema["$comment"].split()[1]
            subprocess.run([CULET, command, "--help"], check=True, capture_output=True)
            printed = subprocess.run([CULET, "help", "json", name], check=True, capture_output=True).stdout
            self.assertEqual(json.loads(printed), schema)
        # The help of a command, either way, and of the program.
        for words, same in ((["help", "fit"], ["fit", "--help"]), (["help"], ["--help"])):
            self.assertEqual(subprocess.run([CULET, *words], check=True, capture_output=True).stdout,
                             subprocess.run([CULET, *same], check=True, capture_output=True).stdout)
        # Every command with such an option is named.
        commands = re.findall(r"(?m)^  ([a-z]+) ", subprocess.run(
            [CULET, "--help"], check=True, capture_output=True, text=True).stdout.partition("Subcommands:")[2].partition("Examples:")[0])
        self.assertGreater(len(commands), 20)
        for command in commands:
            text = subprocess.run([CULET, command, "--help"], check=True, capture_output=True, text=True).stdout
            if re.search(r"--json|--stats|--merge", text) and command not in ("refine", "help"):
                self.assertIn(f"culet {command} ", listed)

    def test_what_is_written_is_as_its_schema_says(self):
        with tempfile.TemporaryDirectory() as work:
            folder = pathlib.Path(work)
            write_inputs(folder)
            for line in COMMANDS.strip().splitlines():
                words = line.replace("SAMPLES", str(SAMPLES)).replace("FRAMES", FRAMES).split()
                run = subprocess.run([CULET, *words], cwd=folder, capture_output=True, text=True)
                self.assertIn(run.returncode, (0, 1), f"{line}\n{run.stderr}")
            for number, (program, tests) in enumerate(TESTS):
                kept = folder / f"kept-{number}"
                kept.mkdir()
                subprocess.run([program, f"--gtest_filter={tests}"], check=True, capture_output=True,
                               env={**os.environ, "CULET_KEPT_JSON": str(kept)})
            met = set()
            for file in sorted(folder.rglob("*.json")):
                thing = json.loads(file.read_text())
                found = {name: faults(schema, thing) for name, schema in SCHEMAS.items()}
                name = min(found, key=lambda name: len(found[name]))
                self.assertEqual(found[name], [], f"{file.relative_to(folder)} is nearest to {name}")
                met.add(name)
                # A key more is a fault: that a schema has forgotten one would be seen.
                self.assertNotEqual(faults(SCHEMAS[name], {**thing, "not a key": 1}), [])
        # Several photographs are compared by a calibration of minutes.
        self.assertEqual(set(SCHEMAS) - met, {"scores-of-several"})


if __name__ == "__main__":
    unittest.main()
