#pragma once
// The kinds of reading, one row each. Private to the room, behind the functions of measurement.h.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// What `of` names. `unwritten`: no [[reading]] has this kind, and tables of
/// their own have its data.
enum class Named {
    one_facet,
    two_facets,
    two_places,
    direction,
    whole_stone,
    many_facets,
    symmetry,
    unwritten
};

struct KindOfReading {
    ReadingKind kind;
    const char* name;
    Named of;
    WrittenUnit::Of measure;  ///< of value and sigma
    bool has_value;           ///< false: a relation
};
const KindOfReading& row_of(ReadingKind kind);

/// The kinds that a [[reading]] may have.
std::vector<std::string> written_kinds();

}  // namespace culet
