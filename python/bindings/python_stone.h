#pragma once
// What Python's Stone and Scene hold.

#include <optional>
#include <string>
#include <vector>

#include "fit/model/options.h"
#include "fit/readings/measurement.h"
#include "render/scene/scene.h"
#include "render/scene/stone_scene.h"
#include "render/uncertainty/drawn_stones.h"
#include "stone/stone.h"

namespace culet {

/// A stone with all that its file says, and its facets' uncertainty if it was fitted.
struct PythonStone {
    std::string file;  ///< for messages
    Stone stone;
    bool has_material = false;
    std::optional<double> index;  ///< of a cut design
    std::vector<WrittenReading> readings;
    FitOptions options;
    std::optional<StoneUncertainty> uncertainty;
    std::vector<std::string> notes;
};

/// A scene and its sources: it is rebuilt when its settings change.
struct PythonScene {
    std::string file;                  ///< empty: a stone in a light
    std::optional<PythonStone> stone;  ///< replaces the file's stone, or stands alone
    std::vector<std::string> overrides;
    StoneScene choices;
    Scene scene;
};

/// For a fitted stone that the scene shows. Throws InputError.
StoneUncertainty uncertainty_for_scene(const PythonStone& stone, const Scene& scene);

}  // namespace culet
