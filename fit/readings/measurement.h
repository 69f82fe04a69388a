#pragma once
// Readings as written (angles in degrees), and as bound to the facets of a solid (radians). Lengths
// are in the stone's unit, volume in cubic millimetres, weight in carats.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stone/stone.h"
#include "stone/text/written_number.h"

namespace culet {

enum class ReadingKind {
    inclination,
    azimuth,
    dihedral,
    distance,
    edge,
    width,
    depth,
    table_width,
    volume,
    weight,
    meet,
    parallel,
    coplanar,
    rotation,
    mirror,
    line,        ///< an edge in a photograph, from a [[line]] table
    silhouette,  ///< outlines, from a [[silhouette]] table
    photograph,  ///< of the stone in known light: from culet refine, in no file
};

struct SeenLine;
struct SilhouetteSet;
struct OutlineObservations;
struct PlaneObservations;

const char* name_of(ReadingKind kind);
std::optional<ReadingKind> reading_kind(std::string_view name);

/// Kinds that have no value (meet, parallel, coplanar, rotation, mirror, line, silhouette,
/// photograph).
bool is_relation(ReadingKind kind);
/// Kinds whose value is an angle.
bool is_angle(ReadingKind kind);

/// One reading as it stands in a file. Numbers are in their written unit, else in their kind's.
struct WrittenReading {
    std::string id;  ///< empty if none is given
    std::string kind;
    std::vector<std::string> of;
    std::optional<double> value, sigma, rounding;
    bool exact = false, released = false;
    std::string datum, note;
    std::string side;  ///< of an inclination: `crown`, `pavilion` or empty
    std::filesystem::path file;
    long line = 0;
    WrittenUnit value_unit, sigma_unit, rounding_unit;
    bool skipped = false;  ///< a row of a form without a value: it takes no part
    std::shared_ptr<const SilhouetteSet> outlines;  ///< of a [[silhouette]] table, else null
    std::shared_ptr<const SeenLine> seen_line;      ///< of a [[line]] table, else null
};

std::size_t skipped_readings(const std::vector<WrittenReading>& written);

/// Reads the [[reading]] tables of a stone file, the rows of its `readings` file, then the
/// [[silhouette]] and [[line]] tables. Throws InputError with file and line.
std::vector<WrittenReading> read_readings(const std::filesystem::path& stone_file,
                                          const std::vector<std::string>& overrides = {});

/// Reads a readings.csv: header `kind,of,value,sigma` and any of `exact`, `released`, `datum`,
/// `side`, `id`, `note`, `rounding`, in any order. The header tells the separator (`;`, a tab or
/// `,`). Fields may be quoted; `#` starts a comment line; numbers may have a decimal comma (between
/// commas only in quotes) and a unit. A row without a value that its kind needs is `skipped`.
std::vector<WrittenReading> read_readings_csv(const std::filesystem::path& file);

/// mean(), min() and max() make one reading of several facets, each() one for each.
enum class Aggregate { single, mean, min, max };

/// The direction from which an angle is measured.
struct Datum {
    enum class Kind { up, axis, girdle, facet } kind = Kind::up;
    int facet = -1;
};

/// An end of a distance: a facet, a vertex, or the edge between two facets.
struct Place {
    enum class Kind { facet, vertex, edge } kind = Kind::facet;
    int facet = -1, other_facet = -1, vertex = -1;
};

/// A reading whose names were found on a solid.
struct Reading {
    std::string id;
    ReadingKind kind = ReadingKind::inclination;
    std::vector<std::string> of;  ///< as written, patterns resolved
    Aggregate aggregate = Aggregate::single;
    /// Kinds of one facet: one, or several with an aggregate. Kinds of two: two for each term
    /// (first, second, first, second, ...). Relations: all of them.
    std::vector<int> facets;
    std::vector<Place> places;  ///< distance: two for each term
    Vec3 direction{1, 0, 0};    ///< width along a vector; unit length
    bool has_direction = false;
    double azimuth = 0;  ///< width, table_width, mirror plane's normal; radians
    int order = 0;       ///< rotation
    Datum datum;
    /// Inclination: 1 if the facet looks up (crown), -1 if down (pavilion), 0 if unstated. The
    /// value counts from that side, and may be slightly over 90 degrees.
    int side = 0;
    double value = 0;  ///< radians, length, mm3 or carat; 0 for relations
    /// In the same unit; of relations: length (meet, coplanar), radians, or pixels (of a line: of
    /// the one through its points, at their middle). 0 for a meet that is neither exact nor
    /// released: estimated.
    double sigma = 0;
    double rounding = 0;  ///< step to which the instrument rounds, in the same unit; 0 if none
    bool exact = false, released = false;
    std::string note;
    std::filesystem::path file;
    long line = 0;
    /// Line (seen_lines.h), and how many pixels a length of one has there.
    std::shared_ptr<const SeenLine> seen_line;
    double pixels = 1;
    /// Silhouette: its outlines, the set's number, and the plane observations of all sets together
    /// (silhouettes/silhouette_fit.h).
    std::shared_ptr<const SilhouetteSet> outlines;
    int outline_set = 0;
    std::shared_ptr<const OutlineObservations> outline_observations;
    /// Photograph: its plane observations (planes/plane_observations.h).
    std::shared_ptr<const PlaneObservations> photograph;

    /// It has a value with an uncertainty.
    bool is_measured() const { return !exact && !is_relation(kind); }
};

/// Finds every name on the solid and gives every reading an id. A pattern makes one reading a
/// facet, with `.NAME` after the id; a word of the trade may make several (docs/readings.md).
/// `notes`, if given, receives a line for everything not taken literally.
/// Throws InputError with file and line for unknown names (with similar ones), a wrong number of
/// names, impossible values and sigmas, repeated ids, lengths in another unit, and a form without
/// any value.
std::vector<Reading> bind_readings(const std::vector<WrittenReading>& written, const Stone& stone,
                                   std::vector<std::string>* notes = nullptr);

}  // namespace culet
