#include "fit/findings/rank_defect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "fit/model/facet_functions.h"
#include "stone/design/tiers.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

// A direction that moves a freedom by less than this (radians, half diameters) is none: a tenth of
// what the mesh is trusted for.
constexpr double k_moves = 0.02;

// `C` of C12; nothing where the name is a number.
std::string letters_of(const std::string& name) {
    return name.substr(0, name.find_last_not_of("0123456789") + 1);
}

// Names in a row as a run: C1 to C8.
std::string listed(const std::vector<std::string>& names) {
    const auto number = [&](const std::string& name) -> long {
        const std::string digits = name.substr(letters_of(name).size());
        return digits.empty() || digits.size() > 9 ? -1 : std::stol(digits);
    };
    std::string text;
    std::size_t written = 0;
    for (std::size_t i = 0; i < names.size();) {
        std::size_t end = i + 1;
        while (end < names.size() && number(names[i]) >= 0 &&
               number(names[end]) == number(names[i]) + long(end - i) &&
               letters_of(names[end]) == letters_of(names[i])) {
            ++end;
        }
        if (written == 6) return text + fmt::format(" and {} more", names.size() - i);
        if (end - i < 3) end = i + 1;
        text += written == 0 ? "" : end == names.size() ? " and " : ", ";
        text += end - i >= 3 ? fmt::format("{} to {}", names[i], names[end - 1]) : names[i];
        i = end;
        ++written;
    }
    return text;
}

}  // namespace

std::vector<std::string> describe_open_freedoms(const FitModel& model, const Shape& shape,
                                                const Covariance& covariance,
                                                const std::vector<Undetermined>& undetermined) {
    std::vector<std::string> sentences;
    if (undetermined.empty()) return sentences;
    const Solid& mesh = model.stone().solid;
    std::map<std::string, int> facet_of;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
        facet_of.emplace(mesh.facets[f].name, int(f));
    }
    // By the form: numbers of facets say nothing of tiers.
    const std::vector<FacetTier> tiers = tiers_of(mesh, model.stone().up);
    const std::vector<int> tier_of = tier_of_each(tiers, mesh.facets.size());
    const auto role = [&](int f, bool several) -> std::string {
        const Vec3& n = shape.normals[std::size_t(f)];
        const std::string s = several ? "s" : "";
        if (f == model.frame().up_facet()) return "table";
        if (model.frame().is_girdle(f)) return "girdle facet" + s;
        return (n.z > 0 ? "crown facet" : "pavilion facet") + s;
    };
    const Vec3 middle = middle_of(shape);
    const Layout layout = layout_of(shape);
    // In the order in which tiers first appear.
    std::vector<std::pair<int, std::string>> order;
    std::map<std::pair<int, std::string>, std::vector<std::string>> groups;
    for (const Undetermined& u : undetermined) {
        const auto key = std::make_pair(tier_of[std::size_t(facet_of.at(u.facet))], u.freedom);
        if (groups[key].empty()) order.push_back(key);
        groups[key].push_back(u.facet);
    }
    for (const auto& key : order) {
        const std::vector<std::string>& names = groups[key];
        const std::string& freedom = key.second;
        const int first = facet_of[names[0]];
        if (names.size() == 1) {
            sentences.push_back(fmt::format("nothing measured fixes the {} of {} {}", freedom,
                                            role(first, false), names[0]));
            continue;
        }
        const bool whole = names.size() == tiers[std::size_t(key.first)].facets.size();
        std::string sentence = fmt::format("nothing measured fixes the {}s of {}{} {}", freedom,
                                           whole ? "the " : "", role(first, true), listed(names));
        if (covariance.open().cols() > 0) {
            const std::size_t which = freedom == "inclination" ? 0 : freedom == "azimuth" ? 1 : 2;
            Eigen::MatrixXd moves(Eigen::Index(names.size()), covariance.open().cols());
            for (std::size_t i = 0; i < names.size(); ++i) {
                const auto rows = facet_functions(shape, facet_of[names[i]], layout, middle);
                moves.row(Eigen::Index(i)) = rows[which].transpose() * covariance.open();
            }
            const SingularValues parts = singular_values(moves);
            const Eigen::Index count = (parts.values.array() > k_moves).count();
            if (count == 1) {
                const Eigen::VectorXd u = parts.u.col(0);
                const bool together = (u.array() > 0).all() || (u.array() < 0).all();
                sentence += together ? " but for their differences: they move together"
                                     : ": they move against each other, in one way";
            } else if (count > 1 && count + 1 == Eigen::Index(names.size())) {
                sentence += " but for one sum of them";
            }
        }
        sentences.push_back(std::move(sentence));
    }
    return sentences;
}

}  // namespace culet
