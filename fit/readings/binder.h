#pragma once
// Finds the names of written readings on a solid. Private to the room, behind `bind_readings` of
// measurement.h.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/readings/measurement.h"
#include "fit/readings/reading_words.h"

namespace culet {

/// No instrument's scatter shows a facet beyond upright by more than this.
inline constexpr double k_over_upright_deg = 2;

/// The whole text as a finite number, or nothing.
std::optional<double> plain_number(std::string_view text);

/// Corners that two facets have in common, and whether there are two.
std::vector<int> common_corners(const Solid& solid, int a, int b);
bool share_edge(const Solid& solid, int a, int b);

/// For one stone. Throws InputError with the place of the reading that is being bound.
class Binder {
public:
    /// `all` are the readings of the file; they tell where an unknown facet may lie.
    Binder(const Stone& stone, const std::vector<WrittenReading>& all);

    /// One reading, or one for each facet of a pattern, or several for a trade's word.
    std::vector<Reading> bind(const WrittenReading& written, const std::string& id);

    /// One line for each name or row that was not taken literally.
    std::vector<std::string> notes() const;

private:
    struct NamedFacets {
        Aggregate aggregate = Aggregate::single;
        bool is_pattern = false;
        std::vector<int> facets;
    };

    [[noreturn]] void fail(const std::string& what) const;
    [[noreturn]] void refuse_kind() const;
    void set_value(Reading& reading) const;
    void set_side(Reading& reading) const;
    void refuse_value(const Reading& reading) const;
    [[noreturn]] void refuse_inclination(double v) const;
    void refuse_side_of_mesh(const Reading& reading, int facet) const;
    std::string meant_inclination(double value) const;
    Datum datum(ReadingKind kind) const;

    // binder_names.cpp
    int facet(const std::string& name) const;
    NamedFacets facets(const std::string& name) const;
    void add_facets(const std::string& name, NamedFacets& to) const;
    Place place(const std::string& name) const;
    void need_edge(int a, int b) const;
    void need_names(std::size_t count, const char* what) const;
    std::string facet_name(int facet) const { return stone_.solid.facets[facet].name; }

    // binder_kinds.cpp
    std::vector<Reading> of_one_facet(const Reading& base) const;
    std::vector<Reading> of_two_facets(const Reading& base) const;
    Reading of_two_places(const Reading& base) const;
    Reading along_direction(const Reading& base) const;
    Reading of_whole_stone(const Reading& base) const;
    Reading of_many_facets(const Reading& base) const;
    Reading of_symmetry(const Reading& base) const;
    Reading of_line(const Reading& base) const;

    // binder_trade.cpp
    double counted(double number, const WrittenUnit& unit, const char* column,
                   ReadingKind kind) const;
    void from_index(Reading& reading) const;
    std::vector<Reading> of_trade(const Reading& base, KindWord::Trade trade) const;
    std::vector<Reading> of_diameter(const Reading& base) const;
    std::vector<Reading> of_table(const Reading& base) const;
    std::vector<Reading> of_mains(const Reading& base, bool crown) const;
    int facet_in_other_case(const std::string& name) const;
    std::vector<int> facets_in_other_case(const std::string& pattern) const;
    void note(const std::string& what) const;
    void note_tiers(const std::string& pattern, const std::vector<int>& facets) const;
    void note_first_of_tier(const std::string& name) const;

    const Stone& stone_;
    const std::vector<WrittenReading>& all_;
    Vec3 up_;
    const WrittenReading* written_ = nullptr;
    std::map<std::string, int, std::less<>> facet_of_name_;
    std::vector<std::string> tier_of_;  // by facet
    mutable std::vector<std::string> notes_;
    // Names as written, and the facets they were taken for; several share one line.
    mutable std::map<std::string, std::string> other_case_;
};

}  // namespace culet
