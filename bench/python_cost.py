"""What Python's fit and render take beside the command for the same work.

python_cost.py CULET SAMPLES [RUNS]: the least seconds by the clock of several runs, taken in turns, so that
both meet the same load. Of the command from its start to its end, of Python from reading the file to
writing the same outputs."""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import culet

program, samples = sys.argv[1], Path(sys.argv[2])
runs = int(sys.argv[3]) if len(sys.argv) > 3 else 9
stone = samples / "dravite-step" / "stone.toml"
scene = samples / "effects" / "garnet-depth.toml"


def timed(work):
    def run(folder):
        start = time.perf_counter()
        work(folder)
        return time.perf_counter() - start

    return run


def command(*arguments):
    subprocess.run([program, *map(str, arguments)], check=True)


def command_fit(folder):
    command("fit", stone, "-q", "-o", folder / "f.obj", "--report", folder / "f.json")


def python_fit(folder):
    fit = culet.fit(culet.load(stone))
    fit.stone.save(folder / "f.obj")
    (folder / "f.json").write_text(json.dumps(fit.report, indent=1))


def command_render(folder):
    command("render", scene, "-q", "--size", 300, "--engine", "reference", "--tolerance", 0.02,
            "--check", "none", "-o", folder / "p.exr")


def python_render(folder):
    culet.render(culet.load(scene), size=300, engine="reference", tolerance=0.02,
                 check="none").save(folder / "p.exr")


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    for what, one, other in (("fit", command_fit, python_fit),
                             ("render", command_render, python_render)):
        times = [(timed(one)(folder), timed(other)(folder)) for _ in range(runs)]
        ours, theirs = (min(column) for column in zip(*times))
        print(f"{what:7s} command {ours:7.3f} s   Python {theirs:7.3f} s   {theirs / ours - 1:+.1%}")
