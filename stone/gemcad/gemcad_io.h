#pragma once
// GemCad cut designs: .asc (text) and .gem (binary).

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "stone/design/design.h"

namespace culet {

struct ReadCut {
    Solid solid;  ///< with its design
    std::vector<std::string> notes;
    std::vector<std::string> details;  ///< what nearly every file has done to it: said on request
    /// Planes of the file that bound nothing, and planes equal to an earlier one; each as
    /// `tier 3 (-42.5 degrees), index 24`.
    std::vector<std::string> unused_planes, repeated_planes;
    int contracted_edges = 0;  ///< short edges at meets that miss
};

struct CutReading {
    /// Meets that miss by less than this fraction of the stone's width become one corner (0: none).
    /// Real files miss by 1e-5 to 3e-4.
    double meet_tolerance = 3e-4;
};

/// Reads a design: the convex solid of its planes, near-miss meets contracted. Names are those
/// after `n`. The one name of a tier is the name of all its facets, wherever in the tier it stands
/// (GemCad names a tier once, at its first facet); where a tier's facets are given several names,
/// each is that facet's alone. A repeated name gets .1, .2 (so a tier A is A, A.1, A.2, ...; a
/// facet that the file names comes before those that have their name from the tier); facets without
/// a name are f0, f1, ... in file order.
/// A facet of angle 0 needs no index. Without a `g` line the gear is supposed, and a note says so.
/// Throws InputError with the line of a record that is not understood, and when the planes leave
/// the stone open or nothing inside.
ReadCut read_gemcad_asc(const std::filesystem::path& file, const CutReading& how = {});
ReadCut read_gemcad_gem(const std::filesystem::path& file, const CutReading& how = {});

/// The same from memory; `file` is for messages.
ReadCut parse_gemcad_asc(std::string_view bytes, const CutReading& how = {},
                         const std::filesystem::path& file = "design.asc");
ReadCut parse_gemcad_gem(std::string_view bytes, const CutReading& how = {},
                         const std::filesystem::path& file = "design.gem");

/// Writes the solid as the design orders it: tier by tier, with its labels, index settings and
/// instructions, and with what else it says, also of facets that bound nothing. Each plane reads
/// back to 1e-12. Facets of a tier that differ in angle or distance have lines of their own, one
/// after another. Facets that the design does not have follow; those of one angle and distance
/// share a line, with one name where they are A, A.1, A.2, ... Blanks in names become `_`. Without
/// a refractive index 1.54, GemCad's own, is written.
/// The format measures distances from a point inside the stone: if the origin is
/// not inside, the stone is moved to put its centroid there. Returns notes on what was changed.
/// Throws InputError when the solid is not convex, for the format cannot hold it.
std::vector<std::string> write_gemcad_asc(const Solid& solid, const Design& design,
                                          const std::filesystem::path& file);

}  // namespace culet
