// Notes on names that differ slightly from the mesh's, or that may mean something else.

#include <fmt/format.h>

#include <algorithm>

#include "fit/readings/binder.h"
#include "stone/design/tiers.h"
#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

// Tiers of a pattern whose mean inclinations differ by less are not reported.
constexpr double k_other_tier_deg = 1;

std::string place_of(const WrittenReading& written) {
    return fmt::format("line {} of {}", written.line, written.file.filename().string());
}

}  // namespace

std::vector<std::string> Binder::notes() const {
    std::vector<std::string> all;
    if (!other_case_.empty()) {
        std::string names;
        std::size_t named = 0;
        for (const auto& [written, meant] : other_case_) {
            if (++named <= 3)
                names += fmt::format("{}{} for {}", named == 1 ? "" : ", ", written, meant);
        }
        if (named > 3) names += fmt::format(" and {} more", named - 3);
        all.push_back("names were taken for those of the mesh that differ in capitals only: " +
                      names);
    }
    for (const std::string& note : notes_) {
        if (std::find(all.begin(), all.end(), note) == all.end()) all.push_back(note);
    }
    return all;
}

void Binder::note(const std::string& what) const {
    notes_.push_back(place_of(*written_) + ": " + what);
}

int Binder::facet_in_other_case(const std::string& name) const {
    int found = -1;
    for (const auto& [known, f] : facet_of_name_) {
        if (lower_case(known) != lower_case(name)) continue;
        if (found >= 0) return -1;
        found = f;
    }
    if (found >= 0) other_case_.emplace(name, facet_name(found));
    return found;
}

std::vector<int> Binder::facets_in_other_case(const std::string& pattern) const {
    std::vector<int> found;
    for (std::size_t i = 0; i < stone_.solid.facets.size(); ++i) {
        if (name_matches(lower_case(pattern), lower_case(stone_.solid.facets[i].name))) {
            found.push_back(static_cast<int>(i));
        }
    }
    if (!found.empty()) other_case_.emplace(pattern, facet_name(found.front()) + ", ...");
    return found;
}

// `1*` also matches the tiers 11 and 12 of a design, which have other angles.
void Binder::note_tiers(const std::string& pattern, const std::vector<int>& facets) const {
    if (kind_word(written_->kind)->kind != ReadingKind::inclination) return;
    std::map<std::string, std::vector<double>> tiers;
    for (const int f : facets) {
        const Vec3& n = stone_.solid.facets[std::size_t(f)].plane.normal;
        tiers[tier_of_[std::size_t(f)]].push_back(degrees(inclination(n, up_)));
    }
    double least = 90, most = 0;
    std::string names;
    for (const auto& [name, angles] : tiers) {
        double mean = 0;
        for (const double angle : angles) mean += angle / double(angles.size());
        least = std::min(least, mean);
        most = std::max(most, mean);
        names += (names.empty() ? "" : ", ") + name;
    }
    if (tiers.size() < 2 || most - least < k_other_tier_deg) return;
    const std::string name = pattern.substr(0, pattern.find('*'));
    note(
        fmt::format("{} matches facets of several tiers ({}), which stand at {:.1f} to {:.1f} "
                    "degrees in the mesh{}",
                    pattern, names, least, most,
                    tiers.count(name) > 0 ? fmt::format("; {}.* is the tier {} alone", name, name)
                                          : std::string()));
}

// Notes that A is one facet of the tier A, A.1, A.2, ..., if no other facet of it was read.
void Binder::note_first_of_tier(const std::string& name) const {
    const auto own = facet_of_name_.find(name);
    if (own == facet_of_name_.end() || facet_of_name_.count(name + ".1") == 0) return;
    if (kind_word(written_->kind)->kind != ReadingKind::inclination) return;
    std::size_t facets = 0;
    for (const std::string& tier : tier_of_) facets += tier == name ? 1 : 0;
    if (facets == 0) return;  // a group made by an exporter
    for (const WrittenReading& w : all_) {
        if (w.skipped) continue;
        for (const std::string& other : w.of) {
            if (other.starts_with(name) && other != name) return;
        }
    }
    note(fmt::format("{} is one facet of the tier {}, which has {}: {}.* means all of them", name,
                     name, facets, name));
}

}  // namespace culet
