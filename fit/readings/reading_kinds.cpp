#include "fit/readings/reading_kinds.h"

#include <algorithm>
#include <array>

namespace culet {

namespace {

using Of = WrittenUnit::Of;

// In the order of ReadingKind.
constexpr std::array<KindOfReading, 18> k_kinds{{
    {ReadingKind::inclination, "inclination", Named::one_facet, Of::angle, true},
    {ReadingKind::azimuth, "azimuth", Named::one_facet, Of::angle, true},
    {ReadingKind::dihedral, "dihedral", Named::two_facets, Of::angle, true},
    {ReadingKind::distance, "distance", Named::two_places, Of::length, true},
    {ReadingKind::edge, "edge", Named::two_facets, Of::length, true},
    {ReadingKind::width, "width", Named::direction, Of::length, true},
    {ReadingKind::depth, "depth", Named::whole_stone, Of::length, true},
    {ReadingKind::table_width, "table_width", Named::direction, Of::length, true},
    {ReadingKind::volume, "volume", Named::whole_stone, Of::volume, true},
    {ReadingKind::weight, "weight", Named::whole_stone, Of::weight, true},
    {ReadingKind::meet, "meet", Named::many_facets, Of::length, false},
    {ReadingKind::parallel, "parallel", Named::many_facets, Of::angle, false},
    {ReadingKind::coplanar, "coplanar", Named::many_facets, Of::length, false},
    {ReadingKind::rotation, "rotation", Named::symmetry, Of::angle, false},
    {ReadingKind::mirror, "mirror", Named::symmetry, Of::angle, false},
    {ReadingKind::line, "line", Named::unwritten, Of::length, false},
    {ReadingKind::silhouette, "silhouette", Named::unwritten, Of::length, false},
    {ReadingKind::photograph, "photograph", Named::unwritten, Of::length, false},
}};

constexpr bool is_in_order() {
    for (std::size_t i = 0; i < k_kinds.size(); ++i) {
        if (static_cast<std::size_t>(k_kinds[i].kind) != i) return false;
    }
    return static_cast<std::size_t>(ReadingKind::photograph) + 1 == k_kinds.size();
}
static_assert(is_in_order(), "k_kinds has one row for each ReadingKind, in its order");

}  // namespace

const KindOfReading& row_of(ReadingKind kind) {
    return k_kinds[static_cast<std::size_t>(kind)];
}

std::vector<std::string> written_kinds() {
    std::vector<std::string> names;
    for (const KindOfReading& row : k_kinds) {
        if (row.of != Named::unwritten) names.emplace_back(row.name);
    }
    return names;
}

const char* name_of(ReadingKind kind) {
    return row_of(kind).name;
}

std::optional<ReadingKind> reading_kind(std::string_view name) {
    const auto row = std::find_if(k_kinds.begin(), k_kinds.end(),
                                  [&](const KindOfReading& k) { return name == k.name; });
    if (row == k_kinds.end()) return std::nullopt;
    return row->kind;
}

bool is_relation(ReadingKind kind) {
    return !row_of(kind).has_value;
}

bool is_angle(ReadingKind kind) {
    return row_of(kind).has_value && row_of(kind).measure == Of::angle;
}

}  // namespace culet
