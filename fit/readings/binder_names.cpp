// Names of facets, corners and edges.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "fit/readings/binder.h"
#include "fit/readings/spreadsheet_losses.h"
#include "fit/readings/unknown_facet.h"
#include "stone/design/index_names.h"
#include "stone/design/tiers.h"
#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

std::string near_names(const Solid& solid, const std::string& name) {
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const Facet& facet : solid.facets) {
        near.emplace_back(edit_distance(name.substr(0, 64), facet.name.substr(0, 64)), facet.name);
    }
    std::stable_sort(near.begin(), near.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(3, near.size()); ++i) {
        text += (i == 0 ? "" : ", ") + near[i].second;
    }
    return text;
}

}  // namespace

int Binder::facet(const std::string& name) const {
    const auto found = facet_of_name_.find(name);
    if (found == facet_of_name_.end()) {
        if (const int other = facet_in_other_case(name); other >= 0) return other;
        const std::vector<int> at_index = facets_at_index(stone_.solid, name);
        if (at_index.size() == 1) return at_index.front();
        if (at_index.size() > 1) {
            fail(fmt::format("'{}' is {} and {} of the mesh: name one of them", name,
                             facet_name(at_index[0]), facet_name(at_index[1])));
        }
        if (const std::string date = date_words(name); !date.empty()) fail(date);
        fail(fmt::format("the mesh has no facet '{}' (near: {}){}", name,
                         near_names(stone_.solid, name), where_it_may_lie(name, all_, stone_)));
    }
    return found->second;
}

// A name, a pattern, each() (one reading for each), or mean(), min(), max().
Binder::NamedFacets Binder::facets(const std::string& name) const {
    NamedFacets result;
    std::string inside = name;
    static constexpr std::array<std::pair<const char*, Aggregate>, 4> words{
        {{"mean(", Aggregate::mean},
         {"min(", Aggregate::min},
         {"max(", Aggregate::max},
         {"each(", Aggregate::single}}};
    for (const auto& [word, aggregate] : words) {
        const std::string_view start(word);
        if (name.size() > start.size() && name.starts_with(start) && name.back() == ')') {
            result.aggregate = aggregate;
            result.is_pattern = aggregate == Aggregate::single;
            inside = name.substr(start.size(), name.size() - start.size() - 1);
        }
    }
    std::size_t begin = 0;
    while (begin <= inside.size()) {
        const std::size_t end = std::min(inside.find_first_of("/,", begin), inside.size());
        std::string one = inside.substr(begin, end - begin);
        const auto first = one.find_first_not_of(' ');
        one = first == std::string::npos ? std::string()
                                         : one.substr(first, one.find_last_not_of(' ') - first + 1);
        add_facets(one, result);
        begin = end + 1;
    }
    return result;
}

void Binder::add_facets(const std::string& name, NamedFacets& to) const {
    if (name.empty()) fail("an empty facet name");
    if (facet_of_name_.count(name) > 0 || name.find('*') == std::string::npos) {
        if (to.aggregate == Aggregate::single && !to.is_pattern) note_first_of_tier(name);
        to.facets.push_back(facet(name));
        return;
    }
    to.is_pattern = true;
    std::vector<int> found;
    for (std::size_t i = 0; i < stone_.solid.facets.size(); ++i) {
        if (name_matches(name, stone_.solid.facets[i].name)) found.push_back(static_cast<int>(i));
    }
    if (found.empty()) found = facets_in_other_case(name);
    if (found.empty()) {
        fail(fmt::format("no facet matches '{}' (near: {})", name, near_names(stone_.solid, name)));
    }
    if (to.aggregate == Aggregate::single) note_tiers(name, found);
    to.facets.insert(to.facets.end(), found.begin(), found.end());
}

Place Binder::place(const std::string& name) const {
    Place result;
    if (facet_of_name_.count(name) > 0) {
        result.facet = facet(name);
        return result;
    }
    const std::size_t bar = name.find('|');
    if (bar != std::string::npos) {
        result.kind = Place::Kind::edge;
        result.facet = facet(name.substr(0, bar));
        result.other_facet = facet(name.substr(bar + 1));
        need_edge(result.facet, result.other_facet);
        return result;
    }
    if (name.size() > 1 && name[0] == 'v' &&
        name.find_first_not_of("0123456789", 1) == std::string::npos) {
        const auto number = plain_number(name.substr(1));
        if (!number || *number >= static_cast<double>(stone_.solid.vertices.size())) {
            fail(fmt::format("the mesh has no vertex '{}'; its vertices are v0 to v{}", name,
                             stone_.solid.vertices.size() - 1));
        }
        result.kind = Place::Kind::vertex;
        result.vertex = static_cast<int>(*number);
        return result;
    }
    result.facet = facet(name);
    return result;
}

std::vector<int> common_corners(const Solid& solid, int a, int b) {
    const std::vector<int>& other = solid.facets[std::size_t(b)].corners;
    std::vector<int> corners = solid.facets[std::size_t(a)].corners;
    std::erase_if(corners, [&](int corner) {
        return std::find(other.begin(), other.end(), corner) == other.end();
    });
    return corners;
}

bool share_edge(const Solid& solid, int a, int b) {
    return common_corners(solid, a, b).size() >= 2;
}

void Binder::need_edge(int a, int b) const {
    if (a == b) fail(fmt::format("names facet '{}' twice", facet_name(a)));
    if (!share_edge(stone_.solid, a, b)) {
        fail(fmt::format("facets '{}' and '{}' share no edge in the mesh", facet_name(a),
                         facet_name(b)));
    }
}

void Binder::need_names(std::size_t count, const char* what) const {
    if (written_->of.size() != count) {
        fail(fmt::format("names {} in `of`; expected {}", written_->of.size(), what));
    }
}

}  // namespace culet
