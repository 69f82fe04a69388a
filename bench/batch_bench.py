"""How well culet batch uses the processors: batch_bench.py CULET MAKE_BATCH_STONES [COUNT [SINGLE]]

COUNT simulated stones are fitted and graded by one batch on all processors. SINGLE of them, evenly spread, are
each done by a batch of their own, one after the other: processor time of a single run. Efficiency is what
single runs would take, over what the processors were there for: their number times the clock."""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

program, maker = sys.argv[1], sys.argv[2]
count = int(sys.argv[3]) if len(sys.argv) > 3 else 1000
single = int(sys.argv[4]) if len(sys.argv) > 4 else 50


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def timed(*arguments):
    """Seconds by the clock and of the processors."""
    clock, cpu = time.perf_counter(), cpu_seconds()
    done = subprocess.run([program, "batch", *map(str, arguments), "-q"], stdout=subprocess.DEVNULL)
    assert done.returncode in (0, 1), done.returncode
    return time.perf_counter() - clock, cpu_seconds() - cpu


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    subprocess.run([maker, str(count), folder / "stones"], check=True)
    stones = sorted((folder / "stones").glob("*.toml"))
    alone = 0.0
    chosen = stones[:: max(1, count // single)][:single]
    for stone in chosen:
        table = folder / "one.csv"
        table.write_text(f"stone\n{stone}\n")
        alone += timed(table, "-o", folder / ("one-" + stone.stem), "--threads", 1)[1]
    clock, cpu = timed(folder / "stones", "-o", folder / "out")
    cores = len(os.sched_getaffinity(0))
    singles = alone / len(chosen) * count
    print(f"{count} stones on {cores} processors: {clock:.0f} s by the clock, {cpu:.0f} s of processor time")
    print(f"single runs: {alone / len(chosen):.3f} s of processor time each, of {len(chosen)} stones; "
          f"{singles:.0f} s for all")
    print(f"efficiency: {singles / (cores * clock):.1%}")
