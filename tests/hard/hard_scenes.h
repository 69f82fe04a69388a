#pragma once
// Scenes of hard cases: the file's [stone] (hard_solids.h) in its [scene], which is a scene file
// (docs/rendering.md) without the stone; and the same scene turned or in other units.

#include "render/scene/scene.h"
#include "tests/hard/hard_kinds.h"
#include "tests/hard/hard_solids.h"

namespace culet::hard {

/// Read by render/scene/scene_io.h from a file in the results folder, which stays there for
/// inspection with `culet render`.
Scene hard_scene(const HardCase& hard_case, const HardPoint& point, const TomlTable& parameters);

/// Turns stone, crystal, camera and lights together. Throws for environment maps, which cannot be
/// turned.
Scene turned(Scene scene, const Turn& turn);
/// The same scene in other units of length: lengths are multiplied by `factor`.
Scene scaled(Scene scene, double factor);
Scene reordered(Scene scene, unsigned seed);
/// With every number of stone, crystal and camera one unit in the last place up or down.
Scene nudged(Scene scene, unsigned seed);

}  // namespace culet::hard
