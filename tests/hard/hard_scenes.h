#pragma once
// Scenes of hard cases: the file's [stone] (hard_solids.h) in its [scene], which is a scene file
// (docs/rendering.md) without the stone; and the same scene turned or in other units.

#include "render/scene/scene.h"
#include "tests/hard/hard_kinds.h"
#include "tests/hard/hard_solids.h"

namespace culet::hard {

/// Read by render/scene/scene_io.h from a file in the results folder, which stays for whoever wants
/// to look at it with `culet render`.
Scene hard_scene(const HardCase& hard_case, const HardPoint& point, const TomlTable& parameters);

/// Stone, crystal, camera and lights together. Throws for environment maps, which cannot turn.
Scene turned(Scene scene, const Turn& turn);
/// The same in other units of length: `factor` as many to the same thing.
Scene scaled(Scene scene, double factor);
/// Facets in another order.
Scene reordered(Scene scene, unsigned seed);
/// Every number of stone, crystal and camera one unit in the last place up or down.
Scene nudged(Scene scene, unsigned seed);

}  // namespace culet::hard
