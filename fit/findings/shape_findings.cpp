#include "fit/findings/shape_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "fit/findings/words.h"
#include "fit/uncertainty/condition_tests.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

const char* name_of(ShapeFinding::Kind kind) {
    constexpr const char* k_names[]{"edge_vanishes", "facet_vanishes", "edge_open", "facet_open"};
    return k_names[static_cast<std::size_t>(kind)];
}

namespace {

using Shapes = ShapeFinding::Kind;

// Half diameters. Longer edges are not reported; a length or area with a larger sigma is unknown.
constexpr double k_short_edge = 0.05, k_unknown_length = 0.5, k_unknown_area = 0.1;
// Half diameters: a held facet narrower than this has vanished (holding leaves 1e-7).
constexpr double k_shut = 1e-5;

// An edge's two sides, then the facets beyond its ends.
std::vector<std::string> names_of(const FitModel& model, const Edge& edge) {
    const auto name = [&](int f) { return model.stone().solid.facets[std::size_t(f)].name; };
    std::vector<std::string> names{name(edge.left), name(edge.right)};
    for (const int end : {edge.from, edge.to}) {
        for (const int f : model.edges().facets_of_vertex[std::size_t(end)]) {
            if (f != edge.left && f != edge.right) names.push_back(name(f));
        }
    }
    return names;
}

// True if holding this corner below its facet keeps the edge between them from reversing.
bool keeps_open(const FitModel& model, const Edge& edge, const ActiveCorner& corner) {
    const auto& [facet, point] = corner;
    if (edge.from != point && edge.to != point) return false;
    if (edge.left == facet || edge.right == facet) return false;
    const int far_end = edge.from == point ? edge.to : edge.from;
    const std::vector<int>& there = model.edges().facets_of_vertex[std::size_t(far_end)];
    return std::find(there.begin(), there.end(), facet) != there.end();
}

class OpenShape {
public:
    OpenShape(const FitModel& model, const Finished& finished, FitResult& result)
        : model_(model), shape_(finished.shape), outline_(*finished.outline), result_(result) {}

    void add_vanishing_edges(const std::vector<ActiveCorner>& held, const Covariance& released);
    void add_facets(const std::vector<ActiveCorner>& held, const Diagnosis& diagnosis);
    void add_open_edges(const Covariance& holding);
    std::vector<std::string> vanishing_edges() const;
    std::vector<ShapeFinding> take() { return std::move(found_); }

private:
    // `unit` converts value and sigma to the result's unit.
    void add(Shapes kind, std::vector<std::string> facets, double unit, double value, double sigma,
             double p = 1);
    std::string words(const ShapeFinding& finding) const;
    std::vector<Corner> corners_of(std::size_t facet) const;
    bool is_held(std::size_t facet, const std::vector<ActiveCorner>& held) const;

    const FitModel& model_;
    const Shape& shape_;
    const Outline& outline_;
    const FitResult& result_;
    std::vector<ShapeFinding> found_;
};

std::string OpenShape::words(const ShapeFinding& finding) const {
    const std::string& first = finding.facets[0];
    if (finding.kind == Shapes::facet_vanishes) {
        return fmt::format("the readings leave no room for facet {}", first);
    }
    if (finding.kind == Shapes::facet_open) {
        return fmt::format("facet {} has an area of {:.2g} ± {:.2g} {}²: it may not be there",
                           first, finding.value, finding.sigma, name_of(result_.unit));
    }
    std::string edge = first + "|" + finding.facets[1];
    if (finding.facets.size() > 2) {
        edge += fmt::format(" (between {})",
                            name_list({finding.facets.begin() + 2, finding.facets.end()}));
    }
    const bool vanishes = finding.kind == Shapes::edge_vanishes;
    return fmt::format("{}edge {} {} {} long: {}", vanishes ? "the readings want " : "", edge,
                       vanishes ? "to be" : "is",
                       length_words(finding.value, finding.sigma, result_.unit),
                       vanishes ? "it is held at zero" : "it may have no length");
}

void OpenShape::add(Shapes kind, std::vector<std::string> facets, double unit, double value,
                    double sigma, double p) {
    ShapeFinding finding{kind, std::move(facets), unit * value, unit * sigma, p, {}};
    finding.what = words(finding);
    found_.push_back(std::move(finding));
}

// Corners held below the facet at an edge's other end keep the edge from reversing. Released, it
// would get the length that the readings ask for.
void OpenShape::add_vanishing_edges(const std::vector<ActiveCorner>& held,
                                    const Covariance& released) {
    // An edge held at both ends has one condition twice: both are released together. A corner of an
    // edge of length l is l times the slope below the far facet.
    std::vector<std::pair<const Edge*, Eigen::VectorXd>> edges;
    for (const Edge& edge : model_.edges().edges) {
        const Vec3 across = glm::cross(shape_.normals[std::size_t(edge.left)],
                                       shape_.normals[std::size_t(edge.right)]);
        // Facets of one plane have no edge that could vanish.
        if (!(glm::dot(across, across) > 0)) continue;
        Eigen::VectorXd slopes = Eigen::VectorXd::Zero(Eigen::Index(held.size()));
        for (std::size_t k = 0; k < held.size(); ++k) {
            if (!keeps_open(model_, edge, held[k])) continue;
            slopes(Eigen::Index(k)) = std::abs(
                glm::dot(glm::normalize(across), shape_.normals[std::size_t(held[k].facet)]));
        }
        if (slopes.sum() > 1e-9) edges.emplace_back(&edge, std::move(slopes));
    }
    if (edges.empty()) return;
    std::vector<Quantity> heights;
    for (const auto& [facet, point] : held) heights.push_back(height(facet, Corner{point})(shape_));
    // They hold, so their residuals are zero.
    const Multipliers multipliers =
        multipliers_of(released, released.linear().writer.functions(heights),
                       Eigen::VectorXd::Zero(Eigen::Index(held.size())));
    for (const auto& [edge, slopes] : edges) {
        const double pull = slopes.dot(multipliers.values);
        const double information = slopes.dot(multipliers.covariance * slopes);
        // Skip edges that are pulled open, or so weakly that rounding errors decide.
        if (!std::isfinite(pull) || !std::isfinite(information)) continue;
        if (!(pull > 0) || !(information > 4)) continue;
        // One-sided: only a negative length counts.
        add(Shapes::edge_vanishes, names_of(model_, *edge), model_.frame().scale(),
            -pull / information, 1 / std::sqrt(information),
            0.5 * std::erfc(pull / std::sqrt(2 * information)));
    }
}

std::vector<std::string> OpenShape::vanishing_edges() const {
    std::vector<std::string> edges;
    for (const ShapeFinding& finding : found_) {
        if (finding.kind != Shapes::edge_vanishes) continue;
        edges.push_back(finding.facets[0] + "/" + finding.facets[1]);
    }
    return edges;
}

std::vector<Corner> OpenShape::corners_of(std::size_t facet) const {
    std::vector<Corner> corners;
    for (const int c : outline_.loops[facet]) corners.push_back(outline_.corners[std::size_t(c)]);
    return corners;
}

bool OpenShape::is_held(std::size_t facet, const std::vector<ActiveCorner>& held) const {
    const std::vector<Corner> corners = corners_of(facet);
    return std::any_of(held.begin(), held.end(), [&](const ActiveCorner& h) {
        return h.facet == int(facet) ||
               std::any_of(corners.begin(), corners.end(),
                           [&](const Corner& c) { return c.point == h.point; });
    });
}

// A facet closed by held corners has vanished, unless that costs nothing: then it may exist.
// Without held corners it is as small as the readings say.
void OpenShape::add_facets(const std::vector<ActiveCorner>& held, const Diagnosis& diagnosis) {
    const double unit = model_.frame().scale() * model_.frame().scale();
    const bool at_a_loss = result_.findings.vanishing_edges.empty() || are_edges_denied(result_);
    for (std::size_t f = 0; f < outline_.loops.size(); ++f) {
        const std::vector<Corner> corners = corners_of(f);
        double width = k_shut;
        for (const Corner& a : corners) {
            for (const Corner& b : corners) {
                width = std::max(width, glm::length(place_of(shape_, a) - place_of(shape_, b)));
            }
        }
        const double value = corners.size() < 3 ? 0 : enclosed_area(corners)(shape_).value;
        const double sigma = diagnosis.facets[f].area;
        const std::string& name = model_.stone().solid.facets[f].name;
        if (corners.size() < 3 || !(value > (is_held(f, held) ? k_shut * width : 0))) {
            add(at_a_loss ? Shapes::facet_vanishes : Shapes::facet_open, {name}, unit, 0,
                at_a_loss ? 0 : sigma);
        } else if (value < 2 * sigma && sigma < k_unknown_area) {
            add(Shapes::facet_open, {name}, unit, value, sigma);
        }
    }
}

void OpenShape::add_open_edges(const Covariance& holding) {
    if (model_.meets().splits) return;
    for (const Edge& edge : model_.edges().edges) {
        const Quantity length = corner_distance(Corner{edge.from}, Corner{edge.to})(shape_);
        if (!(length.value < k_short_edge) || !(length.value > 1e-9)) continue;
        const double sigma =
            std::sqrt(holding.total_variance(holding.linear().writer.function(length)));
        if (!(length.value < 2 * sigma) || !(sigma < k_unknown_length)) continue;
        const std::vector<std::string> names = names_of(model_, edge);
        const bool known = std::any_of(found_.begin(), found_.end(), [&](const auto& other) {
            return other.facets.size() > 1 && other.facets[0] == names[0] &&
                   other.facets[1] == names[1];
        });
        if (!known) add(Shapes::edge_open, names, model_.frame().scale(), length.value, sigma);
    }
}

}  // namespace

bool are_edges_denied(const FitResult& result) {
    const FitFindings& findings = result.findings;
    return !findings.vanishing_edges.empty() &&
           chi2_tail(findings.vanishing_chi2, double(findings.vanishing_edges.size())) <
               result.log.options.significance;
}

std::vector<ShapeFinding> find_open_shape(const FitModel& model, const Finished& finished,
                                          const std::vector<ActiveCorner>& held,
                                          const Diagnosis& diagnosis, const Covariance& holding,
                                          FitResult& result) {
    OpenShape shape(model, finished, result);
    if (!held.empty()) shape.add_vanishing_edges(held, *diagnosis.covariance);
    result.findings.vanishing_edges = shape.vanishing_edges();
    shape.add_facets(held, diagnosis);
    shape.add_open_edges(holding);
    return shape.take();
}

}  // namespace culet
