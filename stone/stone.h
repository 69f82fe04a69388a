#pragma once
// The stone: one model for the fit, the renderer and the comparison.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/material/material.h"
#include "stone/numbers/units.h"
#include "stone/solid/angles.h"
#include "stone/solid/solid.h"
#include "stone/text/change.h"

namespace culet {

/// The principal rays' unit directions of vibration, in the stone's frame. Uniaxial: [0] is the
/// optic axis, the others are any two normal to it. Biaxial: alpha, beta, gamma. Isotropic: unused.
struct CrystalFrame {
    std::array<Vec3, 3> axes{Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
};

struct Stone {
    std::string name;
    Solid solid;                       ///< in `unit`
    LengthUnit unit = LengthUnit::mm;  ///< of the solid and of all lengths of the stone
    Material material;
    CrystalFrame crystal;
    std::string up_facet;  ///< the facet whose normal is up; empty: `up` is given as a vector
    Vec3 up{0, 0, 1};      ///< unit; inclinations are measured from it
    /// The mesh file's direction that was turned to +z (upright.h). A stone file's directions and
    /// places are in the mesh file's frame.
    Vec3 file_up{0, 0, 1};
    bool azimuth_from_mesh =
        false;  ///< true: azimuths count from the mesh's +x; false: their zero is free
    bool convex = true;
    /// True: facets NAME, NAME.1, ... form a tier (a cut design, or a mesh that culet wrote).
    /// False: they may be pieces of one hand-drawn facet.
    bool facets_are_whole = false;
    std::vector<Change> changed;  ///< what reading changed of its mesh
};

/// What a stone file takes from `load_solid` (solid_input.h).
struct SolidFile {
    Solid solid;
    std::vector<std::string> notes;
    std::vector<std::string> details;  ///< for cut files, as in ReadCut
    bool facets_are_whole = false;     ///< see Stone
    Vec3 file_up{0, 0, 1};             ///< see Stone
    std::vector<Change> changed;       ///< see Stone
};

/// Whether reading turns a mesh so that its table is up.
enum class Orientation { upright, as_given };
SolidFile read_solid(const std::filesystem::path& file,
                     Orientation standing = Orientation::upright);

/// What is odd about this mesh's size in mm, and what to do; empty: nothing.
std::string doubtful_size(const Solid& solid);

/// Throws InputError when write_solid has no format for this extension. Call it before long work.
void require_solid_name(const std::filesystem::path& file);

/// Writes by extension: .obj .off .ply .stl .asc .gem .gcs; returns notes on what is not kept.
std::vector<std::string> write_solid(const Solid& solid, const std::filesystem::path& file);

}  // namespace culet
