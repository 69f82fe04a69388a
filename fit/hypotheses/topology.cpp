#include "fit/hypotheses/topology.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "fit/hypotheses/constants.h"
#include "fit/hypotheses/topology_stage.h"
#include "stone/solid/checks.h"
#include "stone/solid/half_edges.h"

namespace culet {

namespace {

std::set<std::pair<std::string, std::string>> edges_of(const Solid& solid) {
    std::set<std::pair<std::string, std::string>> names;
    if (!is_closed(solid)) return names;
    for (const Edge& e : half_edges(solid).edges) {
        const std::string &a = solid.facets[std::size_t(e.left)].name,
                          &b = solid.facets[std::size_t(e.right)].name;
        names.insert(a < b ? std::pair(a, b) : std::pair(b, a));
    }
    return names;
}

void list_edges(const Solid& before, const Solid& after, std::vector<std::string>& changes) {
    const auto old_edges = edges_of(before), new_edges = edges_of(after);
    std::vector<std::string> gone, came;
    for (const auto& e : old_edges) {
        if (new_edges.count(e) == 0) gone.push_back(e.first + "|" + e.second);
    }
    for (const auto& e : new_edges) {
        if (old_edges.count(e) == 0) came.push_back(e.first + "|" + e.second);
    }
    if (!gone.empty()) changes.push_back(fmt::format("edges gone: {}", fmt::join(gone, ", ")));
    if (!came.empty()) changes.push_back(fmt::format("edges new: {}", fmt::join(came, ", ")));
}

// Makes one round of the changes that `result` asks for. False if none can be made.
bool change(TopologyStage& stage, const FitResult& result, int& released,
            std::vector<std::string>& changes) {
    if (!result.checks.missing_facets.empty() && result.checks.closed) {
        return change_solid(stage, result.solid, changes);
    }
    const Solid& solid = stage.stone.solid;
    std::vector<std::pair<int, int>> collapsing;
    std::vector<const ShapeFinding*> flips;
    std::set<int> touched;
    std::vector<std::string> said;
    const HalfEdges edges = half_edges(solid);
    for (const ShapeFinding& finding : result.findings.shapes) {
        if (finding.kind == ShapeFinding::Kind::facet_vanishes) {
            const std::vector<int>& loop =
                solid.facets[std::size_t(find_facet(solid, finding.facets[0]))].corners;
            if (std::any_of(loop.begin(), loop.end(), [&](int c) { return touched.count(c) > 0; }))
                continue;
            // Collapses the facet to an edge or a point: edges above a hundredth of its longest
            // stay.
            double longest = 0;
            const auto length = [&](std::size_t i) {
                const Vec3 d = result.solid.vertices[std::size_t(loop[i])] -
                               result.solid.vertices[std::size_t(loop[(i + 1) % loop.size()])];
                return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
            };
            if (result.solid.vertices.size() != solid.vertices.size()) continue;
            for (std::size_t i = 0; i < loop.size(); ++i) longest = std::max(longest, length(i));
            bool point = longest < 1e-5 * diameter(solid);
            for (std::size_t i = 0; i < loop.size(); ++i) {
                touched.insert(loop[i]);
                if (point || length(i) < 0.01 * longest) {
                    collapsing.emplace_back(loop[i], loop[(i + 1) % loop.size()]);
                }
            }
        } else if (finding.kind == ShapeFinding::Kind::edge_vanishes) {
            for (const Edge& e : edges.edges) {
                const std::string &a = solid.facets[std::size_t(e.left)].name,
                                  &b = solid.facets[std::size_t(e.right)].name;
                if (a != finding.facets[0] || b != finding.facets[1]) continue;
                if (touched.count(e.from) > 0 || touched.count(e.to) > 0) continue;
                touched.insert({e.from, e.to});
                collapsing.emplace_back(e.from, e.to);
                const bool flip = finding.p < result.log.options.significance;
                if (flip) flips.push_back(&finding);
                said.push_back(fmt::format("edge {}|{} {}: {}", a, b,
                                           flip ? "let go" : "drawn together", finding.what));
            }
        }
    }
    if (!collapsing.empty()) {
        if (!change_solid(stage, with_collapsed_edges(solid, collapsing), changes)) return false;
        changes.insert(changes.end(), said.begin(), said.end());
        for (const ShapeFinding* flip : flips) {
            const std::vector<std::string> there = corner_of(stage.stone.solid, flip->facets);
            if (there.size() < 4) continue;
            stage.readings.push_back(released_meet(stage, there, ++released));
            stage.origin.push_back(-1);
        }
        return true;
    }
    // One meet at a time, the worst first, because lengths read to it also accuse its neighbours.
    // Many at once if there are more than rounds.
    std::vector<const MeetFinding*> bad;
    for (const MeetFinding& meet : result.findings.meets) {
        if (meet.contradicted && meet.how != "released") bad.push_back(&meet);
    }
    std::stable_sort(bad.begin(), bad.end(), [](const MeetFinding* a, const MeetFinding* b) {
        return a->chi2 / a->conditions > b->chi2 / b->conditions;
    });
    if (bad.size() > 1 && bad.size() <= std::size_t(k_most_rounds))
        bad.erase(bad.begin() + 1, bad.end());
    for (const MeetFinding* meet : bad) {
        stage.readings.push_back(released_meet(stage, meet->facets, ++released));
        stage.origin.push_back(-1);
        changes.push_back("came apart: " + meet->advice);
    }
    return !bad.empty();
}

// The shortest edges, which may be flipped in the real stone. A contradiction need not drive an
// edge to zero if lengths were read that end at its corners.
std::vector<std::pair<int, int>> doubtful_edges(const TopologyStage& stage,
                                                const FitResult& result) {
    const Solid &mesh = stage.stone.solid, &fitted = result.solid;
    std::vector<std::pair<double, std::pair<int, int>>> edges;
    if (mesh.vertices.size() != fitted.vertices.size()) return {};
    for (const Edge& e : half_edges(mesh).edges) {
        const Vec3 d = fitted.vertices[std::size_t(e.from)] - fitted.vertices[std::size_t(e.to)];
        const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
        if (length < k_topology.doubtful * diameter(fitted))
            edges.push_back({length, {e.from, e.to}});
    }
    std::sort(edges.begin(), edges.end());
    std::vector<std::pair<int, int>> shortest;
    for (const auto& [length, edge] : edges) {
        if (shortest.size() < k_topology.most_doubtful) shortest.push_back(edge);
    }
    return shortest;
}

bool release_edge(TopologyStage& stage, const std::pair<int, int>& edge, int number,
                  std::vector<std::string>& changes) {
    std::vector<std::string> names, sides;
    const HalfEdges edges = half_edges(stage.stone.solid);
    for (const int end : {edge.first, edge.second}) {
        for (int f : edges.facets_of_vertex[std::size_t(end)]) {
            const std::string& name = stage.stone.solid.facets[std::size_t(f)].name;
            if (std::find(names.begin(), names.end(), name) != names.end()) {
                sides.push_back(name);
            } else {
                names.push_back(name);
            }
        }
    }
    std::vector<std::string> said;
    if (!change_solid(stage, with_collapsed_edges(stage.stone.solid, {edge}), said)) return false;
    const std::vector<std::string> there = corner_of(stage.stone.solid, names);
    if (there.size() < 4) return false;
    stage.readings.push_back(released_meet(stage, there, number));
    stage.origin.push_back(-1);
    changes.push_back("edge " + sides.front() + "|" + sides.back() +
                      " dropped: with it the readings conflict");
    changes.insert(changes.end(), said.begin(), said.end());
    return true;
}

void restore_readings(const std::vector<Reading>& first, const TopologyStage& stage,
                      FitResult& result) {
    std::vector<FittedReading> all(first.size());
    std::vector<bool> there(first.size(), false);
    for (std::size_t i = 0; i < stage.origin.size() && i < result.readings.size(); ++i) {
        if (stage.origin[i] < 0) continue;
        all[std::size_t(stage.origin[i])] = result.readings[i];
        there[std::size_t(stage.origin[i])] = true;
    }
    constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (there[i]) continue;
        FittedReading& r = all[i];
        r.id = first[i].id;
        r.kind = first[i].kind;
        r.of = first[i].of;
        r.value = first[i].value;
        r.sigma = first[i].sigma;
        r.exact = first[i].exact;
        r.fitted = r.residual = r.normalized = r.redundancy = k_none;
    }
    result.readings = std::move(all);
    std::erase_if(result.findings.suspects, [&](const std::string& id) {
        return std::none_of(first.begin(), first.end(),
                            [&](const Reading& r) { return r.id == id; });
    });
}

// Prefers closed stones with all facets, then agreement with the readings, then convergence.
bool is_better(const FitResult& a, const FitResult& b) {
    const auto rank = [](const FitResult& r) {
        return std::tuple(!r.checks.closed || !r.checks.missing_facets.empty(),
                          !(r.statistics.chi2_p > r.log.options.significance),
                          r.status == FitStatus::not_converged, -r.statistics.chi2_p);
    };
    return rank(a) < rank(b);
}

}  // namespace

FitResult fit_with_changes(const Stone& stone, const std::vector<Reading>& readings,
                           const FitOptions& options, FitResult first, const FitAgain& fit) {
    TopologyStage stage{stone, readings, {}};
    for (std::size_t i = 0; i < readings.size(); ++i) stage.origin.push_back(int(i));
    FitResult best = first, last = std::move(first);
    TopologyStage best_stage = stage;
    std::vector<std::string> changes, best_changes;
    int released = 0;
    for (int round = 0; round < k_most_rounds; ++round) {
        if (change(stage, last, released, changes)) {
            last = fit(stage.stone, stage.readings);
        } else if (last.status == FitStatus::contradictory && round == 0) {
            TopologyStage chosen;
            FitResult chosen_result;
            std::vector<std::string> chosen_changes;
            for (const auto& edge : doubtful_edges(stage, last)) {
                TopologyStage other = stage;
                std::vector<std::string> said = changes;
                if (!release_edge(other, edge, released + 1, said)) continue;
                FitResult tried = fit(other.stone, other.readings);
                if (!(tried.statistics.chi2_p > options.significance) ||
                    tried.status == FitStatus::not_converged ||
                    (!chosen_changes.empty() && !is_better(tried, chosen_result))) {
                    continue;
                }
                chosen = std::move(other);
                chosen_result = std::move(tried);
                chosen_changes = std::move(said);
            }
            // A change that no reading asked for must end the contradiction.
            if (chosen_changes.empty()) break;
            ++released;
            stage = std::move(chosen);
            last = std::move(chosen_result);
            changes = std::move(chosen_changes);
        } else {
            break;
        }
        if (!is_better(last, best)) continue;
        best = last;
        best_stage = stage;
        best_changes = changes;
    }
    best.log.changes = std::move(best_changes);
    best.log.options = options;
    if (best.log.changes.empty()) return best;
    list_edges(stone.solid, best.solid, best.log.changes);
    restore_readings(readings, best_stage, best);
    best.message += fmt::format("; the topology was changed ({} change{})", best.log.changes.size(),
                                best.log.changes.size() == 1 ? "" : "s");
    return best;
}

}  // namespace culet
