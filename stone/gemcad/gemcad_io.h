#pragma once
// Reads and writes cut designs: GemCad's .asc (text) and .gem (binary), Gem Cut Studio's .gcs
// (XML).

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "stone/design/design.h"

namespace culet {

struct ReadCut {
    Solid solid;  ///< with its design
    std::vector<std::string> notes;
    std::vector<std::string> details;  ///< what happens to nearly every file; shown on request
    /// Planes of the file that bound nothing, and planes that repeat an earlier one; each as `tier
    /// 3 (-42.5 degrees), index 24`.
    std::vector<std::string> unused_planes, repeated_planes;
    int contracted_edges = 0;  ///< short edges where planes nearly meet
};

struct CutReading {
    /// Meets that miss by less than this fraction of the stone's width become one corner (0: none
    /// do). Real files miss by 1e-5 to 3e-4.
    double meet_tolerance = 3e-4;
};

/// Reads a design: the convex solid of its planes, with near-miss meets contracted.
///
/// Names are those after `n`. A tier's only name is the name of all its facets, wherever it stands
/// (GemCad names a tier once, at its first facet); several names belong to single facets. Repeated
/// names get .1, .2, so a tier A is A, A.1, A.2, ...; facets that the file names come before those
/// named after their tier. Facets without a name are f0, f1, ... in file order.
///
/// A facet of angle 0 needs no index. Without a `g` line the gear is guessed, with a note. Of a
/// .gcs the facets' normals and the tiers' depths count, not corners; hidden tiers are not cut; the
/// symmetry is that of the stone. Throws InputError with the line of a record that is not
/// understood, and when the planes leave the stone open or empty.
ReadCut read_cut(const std::filesystem::path& file, const CutReading& how = {});

/// True for .asc, .gem and .gcs, by the extension.
bool is_cut(const std::filesystem::path& file);

/// The same from memory; `file` is for messages, and for `parse_cut` names the format.
ReadCut parse_cut(std::string_view bytes, const CutReading& how, const std::filesystem::path& file);
ReadCut parse_gemcad_asc(std::string_view bytes, const CutReading& how = {},
                         const std::filesystem::path& file = "design.asc");
ReadCut parse_gemcad_gem(std::string_view bytes, const CutReading& how = {},
                         const std::filesystem::path& file = "design.gem");
ReadCut parse_gcs(std::string_view bytes, const CutReading& how = {},
                  const std::filesystem::path& file = "design.gcs");

struct CutFile {
    std::string bytes;
    std::vector<std::string> notes;
};

/// The solid in the design's order, as a file of the format that the name of `file` says: tier by
/// tier, with labels, index settings, instructions and all else that it says, also about facets
/// that bound nothing. Planes read back to 1e-12. Facets of a tier that differ in angle or distance
/// get successive lines. Facets that the design lacks follow; those of one angle and distance share
/// a line, and a name if they are A, A.1, A.2,
/// ... Blanks in names become `_` in .asc. GemCad's default refractive index is 1.54.
///
/// GemCad measures distances from a point inside: if the origin is outside, the stone's centroid is
/// moved to it. Gem Cut Studio has no sizes: the stone is scaled to its square, and its middle
/// height is 0. It has one name a tier, and no index offset.
///
/// What is written is read back first: every plane to 1e-9 of the width (else InternalError), and
/// the design, of which the notes say what the format could not keep (design_difference.h). Throws
/// InputError for a solid that is not convex, which no format of cuts can hold.
CutFile cut_file(const Solid& solid, const Design& design, const std::filesystem::path& file);

/// Writes it completely or not at all, and returns its notes.
std::vector<std::string> write_cut(const Solid& solid, const Design& design,
                                   const std::filesystem::path& file);

}  // namespace culet
