#pragma once
// What was measured: readings as they were written, and bound to the facets of a solid.
// As written, angles are degrees; bound, they are radians. Lengths are in the stone's unit, volume
// in cubic millimetres and weight in carat throughout.

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
    silhouette,  ///< outlines: a table of its own, [[silhouette]]
    photograph,  ///< of the stone in known light: given to culet refine, in no file
};

struct SilhouetteSet;
struct OutlineKnowledge;
struct PlaneObservations;

const char* name_of(ReadingKind kind);
std::optional<ReadingKind> reading_kind(std::string_view name);

/// Says something about the shape (meet, parallel, coplanar, rotation, mirror, silhouette,
/// photograph) and has no value.
bool is_relation(ReadingKind kind);
/// Its value is an angle: degrees in files, radians when bound.
bool is_angle(ReadingKind kind);

/// One reading as it stands in a file. Numbers count in their own unit where one is written, else
/// in that of their kind.
struct WrittenReading {
    std::string id;  ///< empty: none given
    std::string kind;
    std::vector<std::string> of;
    std::optional<double> value, sigma, rounding;
    bool exact = false, released = false;
    std::string datum, note;
    std::string side;  ///< of an inclination: `crown`, `pavilion` or nothing
    std::filesystem::path file;
    long line = 0;
    WrittenUnit value_unit, sigma_unit, rounding_unit;
    bool skipped = false;  ///< a row of a form without its value: takes no part
    std::shared_ptr<const SilhouetteSet> outlines;  ///< of a [[silhouette]] table, else none
};

/// How many of them were skipped.
std::size_t skipped_readings(const std::vector<WrittenReading>& written);

/// The [[reading]] tables of a stone file, the rows of its `readings` file, then the [[silhouette]]
/// tables, of kind `silhouette`. Throws InputError
/// with file and line for what is not a reading at all.
std::vector<WrittenReading> read_readings(const std::filesystem::path& stone_file,
                                          const std::vector<std::string>& overrides = {});

/// The rows of a readings.csv: header `kind,of,value,sigma` and any of `exact`, `released`,
/// `datum`, `side`, `id`, `note`, `rounding`, in any order. Fields may be quoted; `#` starts a
/// comment line. What parts fields is told by the header line: `;`, a tab or `,`. Numbers may have
/// a decimal comma (between commas only in quotes) and a unit. A row whose kind needs a value and
/// has none is `skipped`.
std::vector<WrittenReading> read_readings_csv(const std::filesystem::path& file);

/// Several facets may share one reading through mean(), min() and max(); each() of them is a
/// reading for each, like a pattern.
enum class Aggregate { single, mean, min, max };

/// What an angle is measured from.
struct Datum {
    enum class Kind { up, axis, girdle, facet } kind = Kind::up;
    int facet = -1;
};

/// An end of a distance: a facet, a vertex, or the edge between two facets.
struct Place {
    enum class Kind { facet, vertex, edge } kind = Kind::facet;
    int facet = -1, other_facet = -1, vertex = -1;
};

/// A reading whose names have been found on a solid.
struct Reading {
    std::string id;
    ReadingKind kind = ReadingKind::inclination;
    std::vector<std::string> of;  ///< as written, patterns resolved
    Aggregate aggregate = Aggregate::single;
    /// The facets meant. Kinds of one facet: one, or several under an aggregate. Kinds of two: 2 a
    /// term, first, second, first, second, ... Relations: all of them.
    std::vector<int> facets;
    std::vector<Place> places;  ///< distance: 2 a term
    Vec3 direction{1, 0, 0};    ///< width along a vector, unit
    bool has_direction = false;
    double azimuth = 0;  ///< width, table_width, mirror plane's normal; radians
    int order = 0;       ///< rotation
    Datum datum;
    /// Inclination: 1 the facet looks up (crown), -1 down (pavilion); 0: the reading does not say.
    /// The value counts from that side, and may be a little over 90 degrees.
    int side = 0;
    double value = 0;  ///< radians, length, mm3 or carat; 0 for relations
    /// In the same unit; relations: length (meet, coplanar) or radians. 0 of a meet
    /// that is neither exact nor released: estimated from the data.
    double sigma = 0;
    double rounding = 0;  ///< step to which the instrument rounds, in the same unit; 0: none
    bool exact = false, released = false;
    std::string note;
    std::filesystem::path file;
    long line = 0;
    /// Silhouette: its outlines, the number of the set among those of the stone, and what all sets
    /// together tell of the stone's planes (silhouettes/silhouette_fit.h).
    std::shared_ptr<const SilhouetteSet> outlines;
    int outline_set = 0;
    std::shared_ptr<const OutlineKnowledge> told;
    /// Photograph: what it tells (planes/plane_observations.h).
    std::shared_ptr<const PlaneObservations> photograph;
};

/// Finds every name on the solid and gives every reading its id. A pattern over single facets makes
/// one reading a facet, with `.NAME` after the id. Throws InputError, with file and line, for names
/// that are not there (naming near ones), a wrong number of names, values and uncertainties that
/// cannot be, repeated ids, and lengths that look like another unit; and when all rows of a form
/// are empty. A trade's word may make several readings (docs/readings.md). `notes`, when given,
/// gets a line for everything that was taken for what it does not quite say.
std::vector<Reading> bind_readings(const std::vector<WrittenReading>& written, const Stone& stone,
                                   std::vector<std::string>* notes = nullptr);

}  // namespace culet
