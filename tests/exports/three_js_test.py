"""A stone as GLB, opened by three.js in Chromium: three_js_test.py CULET FOLDER-OF-THREE.JS.
Compares what three.js finds with the converted mesh: size, facets, volume; and the picture shows
the stone."""
import base64
import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests" / "viewer"))
from viewer_pages import Browser  # noqa: E402

CULET, THREE = sys.argv[1], pathlib.Path(sys.argv[2])

SCRIPT = """
const bytes = Uint8Array.from(atob(document.getElementById('stone').textContent.trim()), (c) => c.charCodeAt(0));
const gltf = await new Promise((good, bad) => new THREE.GLTFLoader().parse(bytes.buffer, '', good, bad));
const found = { meshes: 0, facets: [], volume: 0 };
gltf.scene.updateMatrixWorld(true);
gltf.scene.traverse((node) => {
  if (!node.isMesh) return;
  found.meshes += 1;
  const facets = node.userData.facets || node.geometry.userData.facets || [];
  found.facets.push(...facets.map((facet) => facet.name));
  const geometry = node.geometry.index ? node.geometry.toNonIndexed() : node.geometry;
  const p = geometry.attributes.position;
  const corner = (i) => new THREE.Vector3().fromBufferAttribute(p, i).applyMatrix4(node.matrixWorld);
  for (let i = 0; i < p.count; i += 3)
    found.volume += corner(i).dot(corner(i + 1).cross(corner(i + 2))) / 6;
});
const box = new THREE.Box3().setFromObject(gltf.scene);
found.size = box.getSize(new THREE.Vector3()).toArray();
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x000000);
scene.add(gltf.scene, new THREE.HemisphereLight(0xffffff, 0x888888, 3));
const far = Math.max(...found.size), middle = box.getCenter(new THREE.Vector3());
const camera = new THREE.PerspectiveCamera(30, 1, far / 10, far * 10);
camera.position.copy(middle).add(new THREE.Vector3(0, 2.5 * far, far));
camera.lookAt(middle);
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(200, 200);
renderer.render(scene, camera);
const gl = renderer.getContext(), pixels = new Uint8Array(4 * 200 * 200);
gl.readPixels(0, 0, 200, 200, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
found.lit = 0;
for (let i = 0; i < pixels.length; i += 4) found.lit += pixels[i] + pixels[i + 1] + pixels[i + 2] > 30 ? 1 : 0;
return found;
"""


def mesh_of(file):
    """Vertices, and facets by name, of an OBJ that culet wrote."""
    vertices, facets, name = [], [], ""
    for line in file.read_text().splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(x) for x in rest])
        elif word in ("g", "o"):
            name = " ".join(rest)
        elif word == "f":
            facets.append((name, [int(x.split("/")[0]) - 1 for x in rest]))
    return vertices, facets


def volume_of(vertices, facets):
    total = 0.0
    for _, corners in facets:
        a, *rest = (vertices[i] for i in corners)
        for b, c in zip(rest, rest[1:]):
            total += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                      + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


def check(cut, material, browser, folder):
    mesh, glb = folder / f"{cut}.obj", folder / f"{cut}.glb"
    subprocess.run([CULET, "cut", cut, "-o", mesh, "-q"], check=True)
    subprocess.run([CULET, "convert", mesh, glb, "--material", material, "-q"], check=True)
    page = folder / "page.html"
    scripts = "".join(f'<script src="{(THREE / name).as_uri()}"></script>'
                      for name in ("three.js", "examples/js/loaders/GLTFLoader.js"))
    stone = base64.b64encode(glb.read_bytes()).decode()
    page.write_text(f'<!doctype html>{scripts}<script id="stone" type="text/plain">{stone}</script>')
    browser.open(page)
    found = browser.wait(SCRIPT)
    vertices, facets = mesh_of(mesh)
    size = [max(v[k] for v in vertices) - min(v[k] for v in vertices) for k in range(3)]
    # Metres, +y up; coordinates in single precision: 6e-8 of the stone's size, twice.
    expected = [size[0] / 1000, size[2] / 1000, size[1] / 1000]
    for axis, (have, want) in enumerate(zip(found["size"], expected)):
        assert abs(have - want) < 2e-7 * max(expected), (cut, axis, have, want)
    volume = volume_of(vertices, facets) * 1e-9
    assert abs(found["volume"] / volume - 1) < 1e-5, (cut, found["volume"], volume)
    assert sorted(found["facets"]) == sorted(name for name, _ in facets), (cut, found["facets"])
    assert found["meshes"] == 1, found["meshes"]
    # The stone spans at least a third of the picture's side.
    assert found["lit"] > 200 * 200 / 12, (cut, found["lit"])
    print(f"{cut}: {len(facets)} facets, {found['volume'] * 1e9:.4f} mm3, {found['lit']} pixels")


with tempfile.TemporaryDirectory() as name, Browser(400, 400) as opened:
    for cut, material in (("round-brilliant", "diamond"), ("emerald", "sapphire_blue"), ("pear", "garnet_almandine")):
        check(cut, material, opened, pathlib.Path(name))
