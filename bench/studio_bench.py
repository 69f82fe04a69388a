#!/usr/bin/env python3
"""How many slips the studio marks at once: python3 bench/studio_bench.py build/culet

200 simulated cutters fill in the forms of eight standard cuts in their order, each with one slip of the pen (two digits
swapped, one digit wrong, or the decimal point moved; more than 5 % off) and errors as large as the form's sigmas. Counted
is what the answer to the very number marks, before the next row is typed, and what it offers to write instead."""
import http.client
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import time

CUTS = ["round-brilliant", "oval", "step", "princess", "cushion", "pear", "marquise", "trillion"]
CUTTERS = 200


class Studio:
    def __init__(self, program, folder):
        self.process = subprocess.Popen([program, "studio", folder, "--no-open", "-q"], stdout=subprocess.PIPE, text=True,
                                        env=dict(os.environ, XDG_STATE_HOME=folder))
        address = self.process.stdout.readline().strip()
        self.host, self.cookie = address.split("/")[2], ""
        self.cookie = self.ask("GET", address.split(self.host)[1])[0].getheader("Set-Cookie").split(";")[0]

    def ask(self, method, path, body=None):
        connection = http.client.HTTPConnection(self.host)
        connection.request(method, path, json.dumps(body) if body is not None else None, {"Cookie": self.cookie})
        answer = connection.getresponse()
        return answer, answer.read()

    def call(self, path, body=None):
        answer, content = self.ask("GET" if body is None else "POST", path, body)
        if answer.status != 200: raise RuntimeError(content)
        return json.loads(content)

    def end(self):
        self.process.terminate()
        self.process.wait()


def slip_of(number, dice):
    while True:
        digits, slip = [i for i, c in enumerate(number) if c.isdigit()], list(number)
        kind = dice.choice(["swapped", "wrong", "point"])
        if kind == "swapped":
            i = dice.randrange(len(digits) - 1)
            slip[digits[i]], slip[digits[i + 1]] = slip[digits[i + 1]], slip[digits[i]]
        elif kind == "wrong":
            slip[dice.choice(digits[:2])] = str(dice.randrange(10))
        else:
            slip = f"{float(number) * dice.choice([10, 0.1]):.2f}"
        if abs(float("".join(slip)) - float(number)) > 0.05 * float(number): return "".join(slip)


def main():
    dice, counts = random.Random(1), {"rows": 0, "marked": 0, "mended": 0, "others marked": 0}
    slowest = 0
    with tempfile.TemporaryDirectory() as folder:
        studio = Studio(sys.argv[1], folder)
        for cutter in range(CUTTERS):
            studio.call("/api/begin/cut", {"kind": CUTS[cutter % len(CUTS)], "values": {}, "material": "quartz"})
            table = studio.call("/api/table")
            note, sigma = table["columns"].index("note"), table["columns"].index("sigma")
            rows = [(i, re.search(r"expected ([\d.]+)", row["cells"][note]), float(row["cells"][sigma])) for i, row in enumerate(table["rows"])]
            rows = [(i, float(found[1]), sigma) for i, found, sigma in rows if found]
            wrong = dice.randrange(len(rows))
            for at, (i, value, sigma) in enumerate(rows):
                good = typed = f"{dice.gauss(value, sigma):.{1 if sigma >= 0.1 else 2}f}"
                if at == wrong: typed = slip_of(good, dice)
                began = time.time()
                now = studio.call("/api/cells", {"opened": table["opened"], "shape": table["shape"],
                                                 "cells": [{"row": i, "column": "value", "text": typed}]})["rows"]
                slowest = max(slowest, time.time() - began)
                flag = now[i].get("flag")
                if at == wrong and flag:
                    counts["marked"] += 1
                    counts["mended"] += "suggested" in flag and float(flag["suggested"]) == float(good)
            counts["rows"] += len(rows)
            counts["others marked"] += sum("flag" in row for j, row in enumerate(now) if j != rows[wrong][0])
        studio.end()
    print(f"{CUTTERS} slips in {counts['rows']} rows: {counts['marked']} marked at once, {counts['mended']} with the right value to write; "
          f"{counts['others marked']} other rows marked in the end; slowest answer {slowest:.2f} s")


if __name__ == "__main__":
    main()
