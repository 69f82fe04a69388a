#include "fit/elimination_order.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace culet {

namespace {

// Weights beyond this would leave too few digits of what holds freedoms back that no reading holds:
// no less than 1e-6.
constexpr double k_sharp = 3e8;
constexpr std::size_t k_most_groups = 6;  // of an equation of few facets and points
constexpr int k_most_together = 3;        // unknowns of a facet or point

// Unknowns beside each other that appear in the same equations: most of those of one of them.
std::vector<int> groups_of(const SparseRows& rows, int unknowns) {
    std::vector<int> count(std::size_t(unknowns), 0), common(std::size_t(unknowns), 0),
        seen(std::size_t(unknowns), -1);
    for (int i = 0; i < rows.count(); ++i) {
        for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) seen[rows.column[k]] = i;
        for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
            const int c = rows.column[k];
            ++count[c];
            if (c > 0 && seen[c - 1] == i) ++common[c];
        }
    }
    std::vector<int> group(std::size_t(unknowns), 0);
    int size = 0;
    for (int c = 0; c < unknowns; ++c) {
        const bool goes_on =
            c > 0 && size < k_most_together && 2 * common[c] > std::min(count[c], count[c - 1]);
        size = goes_on ? size + 1 : 1;
        group[c] = c == 0 ? 0 : group[c - 1] + (goes_on ? 0 : 1);
    }
    return group;
}

// Whose unknowns share entries: each pair of groups once.
std::vector<std::pair<int, int>> group_pairs(const std::vector<SymmetricEntry>& entries,
                                             const std::vector<int>& group) {
    std::vector<std::pair<int, int>> pairs;
    for (const SymmetricEntry& e : entries) {
        const std::pair<int, int> pair(group[e.row], group[e.column]);
        if (pair.first != pair.second && (pairs.empty() || pairs.back() != pair)) {
            pairs.push_back(pair);
        }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

// Nodes in the order of elimination. `links`: both ways.
std::vector<int> minimum_degree(int nodes, const std::vector<std::pair<int, int>>& links) {
    // Each is linked to itself: a node without a diagonal would be taken for one linked to all.
    std::vector<int> begin(std::size_t(nodes) + 1, 0);
    for (const auto& [from, to] : links) ++begin[std::size_t(from) + 1];
    for (int n = 0; n < nodes; ++n) begin[n + 1] += begin[n] + 1;
    std::vector<int> next = begin, far_end(links.size() + std::size_t(nodes));
    for (int n = 0; n < nodes; ++n) far_end[next[n]++] = n;
    for (const auto& [from, to] : links) far_end[next[from]++] = to;
    // Handed over in the order of nodes, links come to their other ends in order.
    std::vector<int> sorted(far_end.size());
    next = begin;
    for (int from = 0; from < nodes; ++from) {
        for (int k = begin[from]; k < begin[from + 1]; ++k) sorted[next[far_end[k]]++] = from;
    }
    Eigen::SparseMatrix<double> graph(nodes, nodes);
    graph.resizeNonZeros(Eigen::Index(sorted.size()));
    std::fill_n(graph.valuePtr(), graph.nonZeros(), 1.0);
    int count = 0;
    for (int n = 0; n < nodes; ++n) {
        graph.outerIndexPtr()[n] = count;
        for (int k = begin[n], last = -1; k < begin[n + 1]; ++k) {
            if (sorted[k] != last) graph.innerIndexPtr()[count++] = last = sorted[k];
        }
    }
    graph.outerIndexPtr()[nodes] = count;
    graph.resizeNonZeros(count);
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::internal::minimum_degree_ordering(graph, order);
    return {order.indices().data(), order.indices().data() + nodes};
}

}  // namespace

bool is_sharp(const SparseRows& rows, int equation) {
    double largest = 0;
    for (int k = rows.begin[equation]; k < rows.begin[equation + 1]; ++k) {
        largest = std::max(largest, std::abs(rows.slope[k]));
    }
    return largest * largest > k_sharp * rows.variance[equation] || !(rows.variance[equation] > 0);
}

EliminationOrder elimination_order(const SparseRows& rows, int unknowns,
                                   const std::vector<SymmetricEntry>& entries, int folded) {
    EliminationOrder order;
    const std::vector<int> group = groups_of(rows, unknowns);
    const int groups = unknowns == 0 ? 0 : group.back() + 1;
    std::vector<int> first(std::size_t(groups) + 1, unknowns);
    for (int c = unknowns; c-- > 0;) first[group[c]] = c;

    // Nodes of the graph: the groups, then equations that are not folded.
    const int count = rows.count();
    order.is_folded.assign(std::size_t(count), 0);
    std::vector<std::pair<int, int>> links;
    const auto link = [&](int a, int b) {
        if (a == b) return;
        links.emplace_back(a, b);
        links.emplace_back(b, a);
    };
    std::vector<int> seen(std::size_t(groups), -1), touched, equations;
    for (int i = 0; i < count; ++i) {
        touched.clear();
        for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
            const int g = group[rows.column[k]];
            if (seen[g] == i) continue;
            seen[g] = i;
            touched.push_back(g);
        }
        order.is_folded[i] =
            folded < 0 ? touched.size() <= k_most_groups && !is_sharp(rows, i) : i < folded;
        if (order.is_folded[i]) {
            for (const int a : touched) {
                for (const int b : touched) {
                    if (a < b) link(a, b);
                }
            }
            for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
                order.cliques.index.push_back(rows.column[k]);
            }
            order.cliques.close();
            continue;
        }
        const int node = groups + static_cast<int>(equations.size());
        equations.push_back(i);
        // Unknowns of a group go together, and share what each of them shares.
        for (const int g : touched) {
            link(node, g);
            for (int c = first[g]; c < first[g + 1]; ++c) order.cliques.index.push_back(c);
            order.cliques.index.push_back(unknowns + i);
            order.cliques.close();
        }
    }
    for (const auto& [a, b] : group_pairs(entries, group)) {
        link(a, b);
        for (const int g : {a, b}) {
            for (int c = first[g]; c < first[g + 1]; ++c) order.cliques.index.push_back(c);
        }
        order.cliques.close();
    }
    order.eliminated = static_cast<int>(equations.size());
    for (const int node : minimum_degree(groups + order.eliminated, links)) {
        if (node >= groups) {
            order.blocks.index.push_back(unknowns + equations[node - groups]);
        } else {
            for (int c = first[node]; c < first[node + 1]; ++c) order.blocks.index.push_back(c);
        }
        order.blocks.close();
    }
    return order;
}

}  // namespace culet
