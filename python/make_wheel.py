"""make_wheel.py PACKAGE VERSION FOLDER BUNDLE: the built package as FOLDER/culet-VERSION-*.whl, for pip, with the
libraries that its module needs (BUNDLE copies them). By the format of wheels, PyPA's specification 1.0."""

import base64
import hashlib
import pathlib
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

METADATA = """Metadata-Version: 2.1
Name: culet
Version: {version}
Summary: Fits, renders, grades and compares models of real cut gemstones
License: MIT
Requires-Python: =={python}.*
Requires-Dist: numpy
"""


def main(package, version, folder, bundle):
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    tag = "cp{0}-cp{0}-{1}".format(python.replace(".", ""), sysconfig.get_platform().replace("-", "_"))
    info = f"culet-{version}.dist-info"
    with tempfile.TemporaryDirectory() as work:
        root = pathlib.Path(work)
        shutil.copytree(package, root / "culet", ignore=shutil.ignore_patterns("__pycache__"))
        (module,) = (root / "culet").glob("_culet.*.so")
        subprocess.run(["strip", "--strip-unneeded", module], check=True)
        subprocess.run(["sh", bundle, module, root / "culet/lib"], check=True)
        (root / info).mkdir()
        (root / info / "METADATA").write_text(METADATA.format(version=version, python=python))
        (root / info / "WHEEL").write_text(
            f"Wheel-Version: 1.0\nGenerator: culet\nRoot-Is-Purelib: false\nTag: {tag}\n")
        files = sorted(path for path in root.rglob("*") if path.is_file())
        record = f"{info}/RECORD"
        lines = []
        for path in files:
            digest = base64.urlsafe_b64encode(hashlib.sha256(path.read_bytes()).digest()).rstrip(b"=")
            lines.append(f"{path.relative_to(root)},sha256={digest.decode()},{path.stat().st_size}\n")
        (root / record).write_text("".join(lines) + f"{record},,\n")
        wheel = pathlib.Path(folder) / f"culet-{version}-{tag}.whl"
        with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
            for path in files + [root / record]:
                archive.write(path, path.relative_to(root))
    print(wheel)


if __name__ == "__main__":
    main(*sys.argv[1:])
