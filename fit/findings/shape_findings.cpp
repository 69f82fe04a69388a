#include "fit/findings/shape_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "fit/uncertainty/condition_tests.h"

namespace culet {

namespace {

// An edge of the mesh by its two sides and the facets beyond its ends.
struct MeshEdge {
    Edge edge;
    std::vector<int> beyond_from, beyond_to;
};

std::vector<int> others(const std::vector<int>& facets, const Edge& edge) {
    std::vector<int> rest;
    for (int f : facets) {
        if (f != edge.left && f != edge.right) rest.push_back(f);
    }
    return rest;
}

std::string name(const System& system, int facet) {
    return system.stone().solid.facets[std::size_t(facet)].name;
}

std::vector<std::string> names_of(const System& system, const Edge& edge) {
    std::vector<std::string> names{name(system, edge.left), name(system, edge.right)};
    for (const int end : {edge.from, edge.to}) {
        for (int f : others(system.edges().facets_of_vertex[std::size_t(end)], edge)) {
            names.push_back(name(system, f));
        }
    }
    return names;
}

// Whether holding a corner below a facet keeps this edge, which ends at both, from turning over.
bool keeps_open(const System& system, const Edge& edge, int point, int facet) {
    if (edge.from != point && edge.to != point) return false;
    if (edge.left == facet || edge.right == facet) return false;
    const int far_end = edge.from == point ? edge.to : edge.from;
    const std::vector<int>& there = system.edges().facets_of_vertex[std::size_t(far_end)];
    return std::find(there.begin(), there.end(), facet) != there.end();
}

// Corners held below the facet at the other end of an edge keep the edge from turning round. Let
// go, it would be as long as the readings want it.
void add_vanishing(const System& system, const Finished& finished,
                   const std::vector<ActiveCorner>& held, const Covariance& let_go,
                   std::vector<ShapeFinding>& findings) {
    if (held.empty()) return;
    // Of an edge both ends may be held, which is one condition said twice: they are let go
    // together. A corner of an edge of length l lies l times the slope below the far facet.
    std::vector<const Edge*> edges;
    std::vector<Eigen::VectorXd> columns;
    for (const Edge& edge : system.edges().edges) {
        const Vec3 across = glm::cross(finished.shape.normals[std::size_t(edge.left)],
                                       finished.shape.normals[std::size_t(edge.right)]);
        // Facets of one plane have no edge that could vanish.
        if (!(glm::dot(across, across) > 0)) continue;
        const Vec3 along = glm::normalize(across);
        Eigen::VectorXd column = Eigen::VectorXd::Zero(Eigen::Index(held.size()));
        for (std::size_t k = 0; k < held.size(); ++k) {
            const auto& [facet, point] = held[k];
            if (!keeps_open(system, edge, point, facet)) continue;
            column(Eigen::Index(k)) =
                std::abs(glm::dot(along, finished.shape.normals[std::size_t(facet)]));
        }
        if (column.maxCoeff() < 1e-9) continue;
        edges.push_back(&edge);
        columns.push_back(std::move(column));
    }
    if (edges.empty()) return;
    std::vector<Quantity> heights;
    for (const auto& [facet, point] : held) {
        heights.push_back(height(facet, Corner{point})(finished.shape));
    }
    // As they lie they hold.
    const Multipliers multipliers =
        multipliers_of(let_go, let_go.linear().writer.functions(heights),
                       Eigen::VectorXd::Zero(Eigen::Index(held.size())));
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const double pull = columns[k].dot(multipliers.values);
        const double information = columns[k].dot(multipliers.covariance * columns[k]);
        // Readings so vague that what they say is no number say nothing.
        if (!std::isfinite(pull) || !std::isfinite(information)) continue;
        // Drawn apart, or pulled so loosely that rounding decides: not what shapes the stone.
        if (!(pull > 0) || !(information > 4)) continue;
        ShapeFinding finding;
        finding.kind = ShapeFinding::Kind::edge_vanishes;
        finding.facets = names_of(system, *edges[k]);
        finding.value = -pull / information;
        finding.sigma = 1 / std::sqrt(information);
        // One-sided: only a wish for less than nothing counts.
        finding.p = 0.5 * std::erfc(pull / std::sqrt(2 * information));
        findings.push_back(std::move(finding));
    }
}

double area_of(const Finished& finished, std::size_t facet) {
    std::vector<Corner> corners;
    for (int c : finished.outline->loops[facet]) {
        corners.push_back(finished.outline->corners[std::size_t(c)]);
    }
    return enclosed_area(corners)(finished.shape).value;
}

// A facet whose outline is shut by the held corners. One that is as small without being held is as
// small as the readings say.
void add_shut_facets(const System& system, const Finished& finished,
                     const std::vector<ActiveCorner>& held, std::vector<ShapeFinding>& findings) {
    const Outline& outline = *finished.outline;
    std::set<int> held_points, held_facets;
    for (const auto& [facet, point] : held) {
        held_points.insert(point);
        held_facets.insert(facet);
    }
    for (std::size_t f = 0; f < outline.loops.size(); ++f) {
        double width = 0;
        const std::vector<int>& loop = outline.loops[f];
        const bool is_held = held_facets.contains(static_cast<int>(f)) ||
                             std::any_of(loop.begin(), loop.end(), [&](int c) {
                                 return held_points.contains(outline.corners[std::size_t(c)].point);
                             });
        for (std::size_t i = 0; i < loop.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                width = std::max(
                    width,
                    glm::length(place_of(finished.shape, outline.corners[std::size_t(loop[i])]) -
                                place_of(finished.shape, outline.corners[std::size_t(loop[j])])));
            }
        }
        // Holding leaves 1e-7 of the half diameter; an area of that width is no facet.
        if (loop.size() >= 3 && area_of(finished, f) > (is_held ? 1e-5 * std::max(width, 1e-5) : 0))
            continue;
        ShapeFinding finding;
        finding.kind = ShapeFinding::Kind::facet_vanishes;
        finding.facets = {name(system, static_cast<int>(f))};
        findings.push_back(std::move(finding));
    }
}

double sigma_of(const Covariance& covariance, const Quantity& quantity) {
    return std::sqrt(covariance.total_variance(covariance.linear().writer.function(quantity)));
}

void add_open_edges(const System& system, const Finished& finished, const Covariance& holding,
                    std::vector<ShapeFinding>& findings) {
    if (system.splits()) return;
    for (const Edge& edge : system.edges().edges) {
        const Corner a{edge.from, {-1, -1, -1}}, b{edge.to, {-1, -1, -1}};
        const double length =
            glm::length(place_of(finished.shape, a) - place_of(finished.shape, b));
        if (!(length < k_short_edge) || !(length > 1e-9)) continue;
        const double sigma = sigma_of(holding, corner_distance(a, b)(finished.shape));
        if (!(length < 2 * sigma) || !(sigma < 0.5)) continue;
        ShapeFinding finding;
        finding.kind = ShapeFinding::Kind::edge_open;
        finding.facets = names_of(system, edge);
        const bool known = std::any_of(findings.begin(), findings.end(), [&](const auto& other) {
            return other.facets[0] == finding.facets[0] && other.facets.size() > 1 &&
                   other.facets[1] == finding.facets[1];
        });
        if (known) continue;
        finding.value = length;
        finding.sigma = sigma;
        findings.push_back(std::move(finding));
    }
}

void add_open_facets(const System& system, const Finished& finished, const Diagnosis& diagnosis,
                     std::vector<ShapeFinding>& findings) {
    const Outline& outline = *finished.outline;
    for (std::size_t f = 0; f < outline.loops.size(); ++f) {
        if (outline.loops[f].size() < 3) continue;
        const double value = area_of(finished, f);
        const double sigma = diagnosis.facets[f].area;
        // Beyond a tenth of the half diameter squared the area is simply not known.
        if (!(value < 2 * sigma) || !(sigma < 0.1)) continue;
        ShapeFinding finding;
        finding.kind = ShapeFinding::Kind::facet_open;
        finding.facets = {name(system, static_cast<int>(f))};
        const bool known = std::any_of(findings.begin(), findings.end(), [&](const auto& other) {
            return other.kind == ShapeFinding::Kind::facet_vanishes &&
                   other.facets == finding.facets;
        });
        if (known) continue;
        finding.value = value;
        finding.sigma = sigma;
        findings.push_back(std::move(finding));
    }
}

}  // namespace

std::vector<std::string> edges_kept_open(const System& system,
                                         const std::vector<ActiveCorner>& held) {
    std::vector<std::string> edges;
    for (const ActiveCorner& h : held) {
        for (const Edge& edge : system.edges().edges) {
            if (!keeps_open(system, edge, h.point, h.facet)) continue;
            std::string both = name(system, edge.left) + "/" + name(system, edge.right);
            if (std::find(edges.begin(), edges.end(), both) == edges.end()) {
                edges.push_back(std::move(both));
            }
        }
    }
    return edges;
}

std::vector<ShapeFinding> find_open_shape(const System& system, const Finished& finished,
                                          const std::vector<ActiveCorner>& held,
                                          const Diagnosis& diagnosis, const Covariance& holding) {
    std::vector<ShapeFinding> findings;
    if (!finished.outline) return findings;
    add_vanishing(system, finished, held, *diagnosis.covariance, findings);
    add_shut_facets(system, finished, held, findings);
    add_open_edges(system, finished, holding, findings);
    add_open_facets(system, finished, diagnosis, findings);
    return findings;
}

}  // namespace culet
