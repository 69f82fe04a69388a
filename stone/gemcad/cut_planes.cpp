#include "stone/gemcad/cut_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "stone/mesh/face_soup.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

/// Planes this close are one plane given twice: files give angles to 1e-6 degrees (2e-8 rad) and
/// distances to 1e-8.
constexpr double k_same_plane = 1e-9;

/// More planes than any stone has facets; the exact intersection takes seconds for this many.
constexpr std::size_t k_most_planes = 5000;

}  // namespace

std::vector<std::string> tier_labels(const Design& design) {
    std::vector<std::string> labels;
    for (const DesignTier& tier : design.tiers) {
        std::set<std::string> own;
        for (const DesignFacet& facet : tier.facets) {
            if (!facet.label.empty()) own.insert(facet.label);
        }
        labels.push_back(own.size() == 1 ? *own.begin() : std::string());
    }
    return labels;
}

double without_noise(double setting) {
    constexpr double k_step = 1e-4, k_noise = 1e-6;
    const double near = k_step * std::round(setting / k_step);
    return std::abs(near - setting) < k_noise ? near : setting;
}

void build_solid(ReadCut& cut, Design design, const std::vector<CutPlane>& planes,
                 const CutReading& how, const std::filesystem::path& file) {
    if (planes.empty()) throw InputError(file, "holds no facets");
    if (planes.size() > k_most_planes) {
        throw InputError(file, fmt::format("holds {} facets; designs of more than {} are not read",
                                           planes.size(), k_most_planes));
    }
    double scale = 0;
    for (const CutPlane& p : planes) scale = std::max(scale, std::abs(p.plane.offset));

    std::vector<NamedPlane> distinct;
    std::vector<const CutPlane*> origin;
    for (const CutPlane& p : planes) {
        const bool repeated = std::any_of(distinct.begin(), distinct.end(), [&](const auto& d) {
            return std::abs(d.plane.offset - p.plane.offset) <= k_same_plane * scale &&
                   glm::length(d.plane.normal - p.plane.normal) <= k_same_plane;
        });
        if (repeated) {
            cut.repeated_planes.push_back(p.place);
            continue;
        }
        distinct.push_back({std::to_string(distinct.size()), p.plane});
        origin.push_back(&p);
    }
    HalfSpaceSolid whole = intersect_half_spaces(distinct);
    if (!whole.bounded) {
        throw InputError(file,
                         fmt::format("the {} planes do not close the stone: facets are missing",
                                     distinct.size()));
    }
    if (whole.empty) {
        throw InputError(file, "the planes enclose no point: an angle or a distance is wrong");
    }
    for (const int unused : whole.unused_planes) {
        cut.unused_planes.push_back(origin[unused]->place);
    }
    const double width =
        std::min(width_along(whole.solid, {1, 0, 0}), width_along(whole.solid, {0, 1, 0}));
    ContractedSolid contracted = how.meet_tolerance > 0
                                     ? contract_near_meets(whole.solid, how.meet_tolerance * width)
                                     : ContractedSolid{std::move(whole.solid), 0, {}};
    if (contracted.solid.facets.size() < 4) {
        throw InputError(file, fmt::format("nothing is left of the stone when meets within {:g} of "
                                           "its width are joined: give a smaller tolerance",
                                           how.meet_tolerance));
    }
    cut.solid = std::move(contracted.solid);
    cut.contracted_edges = contracted.contracted_edges;
    for (const std::string& vanished : contracted.vanished) {
        cut.unused_planes.push_back(origin[std::stoul(vanished)]->place);
    }

    // Facets still have their planes' numbers as names.
    const std::vector<std::string> tiers = tier_labels(design);
    std::vector<std::string> names, of_tier;
    std::vector<const CutPlane*> of_facet;
    for (const Facet& facet : cut.solid.facets) {
        of_facet.push_back(origin[std::stoul(facet.name)]);
        names.push_back(of_facet.back()->name);
        of_tier.push_back(tiers[std::size_t(of_facet.back()->tier)]);
    }
    names = unique_names(std::move(names), of_tier);
    for (std::size_t i = 0; i < names.size(); ++i) {
        DesignTier& tier = design.tiers[std::size_t(of_facet[i]->tier)];
        tier.facets[std::size_t(of_facet[i]->facet)].facet = names[i];
        cut.solid.facets[i].name = std::move(names[i]);
    }
    join_split_tiers(cut.solid, design);
    cut.solid.design = std::make_shared<const Design>(std::move(design));

    // Only meets that miss by more than rounding are reported.
    const double missed = planarity(cut.solid) / width;
    if (cut.contracted_edges > 0 && missed > k_same_plane) {
        cut.details.push_back(fmt::format(
            "joined meets that miss: {} edges shorter than {:g} of the width; corners lie up to "
            "{:.2g} of the width off their planes",
            cut.contracted_edges, how.meet_tolerance, missed));
    }
    for (const std::string& place : cut.repeated_planes) {
        cut.notes.push_back(fmt::format("repeated plane left out: {}", place));
    }
    for (const std::string& place : cut.unused_planes) {
        cut.notes.push_back(fmt::format("plane that bounds nothing left out: {}", place));
    }
}

bool is_cut(const std::filesystem::path& file) {
    const std::string format = extension_of(file);
    return format == "asc" || format == "gem" || format == "gcs";
}

ReadCut parse_cut(std::string_view bytes, const CutReading& how,
                  const std::filesystem::path& file) {
    const std::string format = extension_of(file);
    return format == "gem"   ? parse_gemcad_gem(bytes, how, file)
           : format == "gcs" ? parse_gcs(bytes, how, file)
                             : parse_gemcad_asc(bytes, how, file);
}

ReadCut read_cut(const std::filesystem::path& file, const CutReading& how) {
    return parse_cut(read_text(file, std::size_t{16} << 20), how, file);
}

}  // namespace culet
