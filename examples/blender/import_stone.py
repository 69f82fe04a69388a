"""Opens a stone that `culet convert` wrote as GLB in Blender 3.4 or later, gives it a material with the stone's index,
dispersion and absorption, and draws it:

    culet convert --width 6.5mm --material diamond design.asc stone.glb
    blender --background --python examples/blender/import_stone.py -- stone.glb stone.png

Cycles has one index a ray: dispersion is three glasses, for red, green and blue, whose sum is the stone. Double
refraction and the spectrum of absorption are not in glTF (docs/exports.md).
"""
import json
import math
import pathlib
import struct
import sys

import bpy
import numpy

# Debian 12's Blender asks its numpy for a name that it no longer has.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

SIZE, SAMPLES = 400, 256
MM = 0.001  # glTF has metres


def gltf_of(file):
    """The JSON part of a GLB."""
    data = pathlib.Path(file).read_bytes()
    length, kind = struct.unpack("<I4s", data[12:20])
    assert kind == b"JSON", f"{file} is no GLB"
    return json.loads(data[20:20 + length])


def indices_of(extensions):
    """Red, green and blue: the index at the D line, and Abbe's number as KHR_materials_dispersion has it (20 / V)."""
    index = extensions.get("KHR_materials_ior", {}).get("ior", 1.5)
    dispersion = extensions.get("KHR_materials_dispersion", {}).get("dispersion", 0)
    # n(486 nm) - n(656 nm), along Cauchy's formula; red, green and blue are 610, 550 and 465 nm.
    spread = (index - 1) * dispersion / 20
    slope = spread / (1 / 0.4861**2 - 1 / 0.6563**2)
    return [index + slope * (1 / nm**2 - 1 / 0.5876**2) for nm in (0.610, 0.550, 0.465)]


def material_of(gltf):
    extensions = gltf["materials"][0].get("extensions", {})
    made = bpy.data.materials.new(gltf["materials"][0].get("name", "stone"))
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    out = nodes.new("ShaderNodeOutputMaterial")
    indices, total = indices_of(extensions), None
    for index, colour in zip(indices, ((1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1))):
        glass = nodes.new("ShaderNodeBsdfGlass")
        glass.inputs["Color"].default_value = colour
        glass.inputs["Roughness"].default_value = 0
        glass.inputs["IOR"].default_value = index
        if total is None:
            total = glass.outputs[0]
            continue
        add = nodes.new("ShaderNodeAddShader")
        links.new(total, add.inputs[0])
        links.new(glass.outputs[0], add.inputs[1])
        total = add.outputs[0]
    links.new(total, out.inputs["Surface"])
    volume = extensions.get("KHR_materials_volume", {})
    if "attenuationDistance" in volume:  # Beer's law: that colour after that many metres
        absorb = nodes.new("ShaderNodeVolumeAbsorption")
        colour = volume.get("attenuationColor", [1, 1, 1])
        loss = [-math.log(max(c, 1e-4)) / volume["attenuationDistance"] for c in colour]
        most = max(max(loss), 1e-9)
        # Blender's absorption is density * (1 - colour).
        absorb.inputs["Color"].default_value = (*[1 - one / most for one in loss], 1)
        absorb.inputs["Density"].default_value = most
        links.new(absorb.outputs[0], out.inputs["Volume"])
    return made, indices


# culet's light "photograph": a bright ring round a dark camera, dim walls. By the cosine of the angle from straight up.
RING = ((0, 0.35), (0.5, 0.25), (0.707, 1.3), (0.906, 0.1), (0.94, 0.02))


def set_up_scene(stone):
    """Seen face up, a little tilted."""
    scene, width = bpy.context.scene, max(stone.dimensions)
    world = bpy.data.worlds.new("photograph")
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    place, parts, ramp = (nodes.new(f"ShaderNode{kind}") for kind in ("TexCoord", "SeparateXYZ", "ValToRGB"))
    ramp.color_ramp.interpolation = "CONSTANT"
    while len(ramp.color_ramp.elements) < len(RING):
        ramp.color_ramp.elements.new(1)
    for element, (cosine, radiance) in zip(ramp.color_ramp.elements, RING):
        element.position, element.color = cosine, (radiance, radiance, radiance, 1)
    links.new(place.outputs["Generated"], parts.inputs[0])
    links.new(parts.outputs["Z"], ramp.inputs[0])
    links.new(ramp.outputs[0], nodes["Background"].inputs["Color"])
    scene.world = world
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (0, -0.6 * width, 6 * width)
    camera.rotation_euler = camera.location.to_track_quat("Z", "Y").to_euler()
    camera.data.angle = math.radians(14)
    camera.data.clip_start = width / 100
    scene.collection.objects.link(camera)
    scene.camera = camera


def main(file, picture):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=file)
    (stone,) = [one for one in bpy.data.objects if one.type == "MESH"]
    made, indices = material_of(gltf_of(file))
    stone.data.materials.clear()
    stone.data.materials.append(made)
    for polygon in stone.data.polygons:
        polygon.use_smooth = False
    set_up_scene(stone)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = SAMPLES, False
    scene.cycles.max_bounces = scene.cycles.transmission_bounces = scene.cycles.glossy_bounces = 24
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.filepath = str(pathlib.Path(picture).resolve())
    bpy.ops.render.render(write_still=True)
    print(f"{stone.name}: {len(stone.data.polygons)} triangles, {stone.dimensions.x / MM:.3f} mm wide, index "
          + " ".join(f"{index:.4f}" for index in indices))


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1:])
