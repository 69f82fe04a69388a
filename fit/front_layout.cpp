// How fronts hang together: which rows each has, and where its entries stand.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "fit/fronts.h"

namespace culet {

namespace {

// A front becomes one with its parent where no more of the two is filled with zeros than this part;
// of few pivots, the handling of one more front costs more.
constexpr double k_zeros = 0.1, k_zeros_of_few = 0.3;
constexpr int k_few = 8;

// Children before parents, each subtree in one piece.
std::vector<int> postorder(const std::vector<int>& parent) {
    const int count = static_cast<int>(parent.size());
    std::vector<int> first(parent.size(), -1), next(parent.size(), -1), order, stack;
    for (int s = count - 1; s >= 0; --s) {
        if (parent[s] < 0) continue;
        next[s] = first[parent[s]];
        first[parent[s]] = s;
    }
    order.reserve(parent.size());
    for (int root = 0; root < count; ++root) {
        if (parent[root] >= 0) continue;
        stack.push_back(root);
        while (!stack.empty()) {
            const int s = stack.back();
            if (first[s] >= 0) {
                stack.push_back(first[s]);
                first[s] = next[first[s]];
            } else {
                order.push_back(s);
                stack.pop_back();
            }
        }
    }
    return order;
}

// The elimination tree of blocks (Liu 1990): which of those that one is linked to, or will be,
// comes first after it. `block`: of each index; negative: of none. Of a clique, links from each
// member to the next say as much as all.
std::vector<int> elimination_tree(int count, const std::vector<int>& block,
                                  const IndexLists& cliques) {
    std::vector<std::pair<int, int>> links;  // later block, earlier one
    std::vector<int> members, begin(std::size_t(count) + 1, 0);
    for (int c = 0; c < cliques.count(); ++c) {
        members.clear();
        for (int k = cliques.begin[c]; k < cliques.begin[c + 1]; ++k) {
            const int b = block[cliques.index[k]];
            if (b >= 0 && (members.empty() || members.back() != b)) members.push_back(b);
        }
        std::sort(members.begin(), members.end());
        for (std::size_t k = 1; k < members.size(); ++k) {
            if (members[k] == members[k - 1]) continue;
            links.emplace_back(members[k], members[k - 1]);
            ++begin[std::size_t(members[k]) + 1];
        }
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<int> earlier(links.size()), next(begin.begin(), begin.end() - 1);
    for (const auto& [late, early] : links) earlier[next[late]++] = early;
    std::vector<int> parent(std::size_t(count), -1), root(std::size_t(count), -1);
    for (int b = 0; b < count; ++b) {
        for (int k = begin[b]; k < begin[b + 1]; ++k) {
            for (int at = earlier[k]; at != b;) {
                const int above = std::exchange(root[at], b);
                if (above < 0) parent[at] = b;
                at = above < 0 ? b : above;
            }
        }
    }
    return parent;
}

}  // namespace

// Fronts with these numbers of pivots, in the present order of places.
void Fronts::gather(const IndexLists& cliques, const std::vector<int>& pivots) {
    const int count = static_cast<int>(pivots.size());
    fronts_.assign(std::size_t(count), {});
    front_of_.resize(std::size_t(size_));
    for (int s = 0, place = 0; s < count; ++s) {
        fronts_[s].first = place;
        fronts_[s].pivots = pivots[s];
        for (int i = 0; i < pivots[s]; ++i) front_of_[place++] = s;
    }
    // Each clique belongs to the front that eliminates its first member.
    std::vector<int> head(std::size_t(count), -1), next(std::size_t(cliques.count()), -1);
    for (int c = cliques.count() - 1; c >= 0; --c) {
        int least = size_;
        for (int k = cliques.begin[c]; k < cliques.begin[c + 1]; ++k) {
            least = std::min(least, place_[cliques.index[k]]);
        }
        if (least == size_) continue;
        next[c] = head[front_of_[least]];
        head[front_of_[least]] = c;
    }
    boundary_.clear();
    std::vector<int> mark(std::size_t(size_), -1), child(std::size_t(count), -1),
        sibling(std::size_t(count), -1);
    for (int s = 0; s < count; ++s) {
        Front& front = fronts_[s];
        front.boundary = static_cast<int>(boundary_.size());
        const int end = front.first + front.pivots;
        const auto take = [&](int place) {
            if (place < end || mark[place] == s) return;
            mark[place] = s;
            boundary_.push_back(place);
        };
        for (int c = head[s]; c >= 0; c = next[c]) {
            for (int k = cliques.begin[c]; k < cliques.begin[c + 1]; ++k) {
                take(place_[cliques.index[k]]);
            }
        }
        for (int c = child[s]; c >= 0; c = sibling[c]) {
            const Front& below = fronts_[c];
            for (int k = 0; k < below.rows; ++k) take(boundary_[below.boundary + k]);
        }
        front.rows = static_cast<int>(boundary_.size()) - front.boundary;
        std::sort(boundary_.begin() + front.boundary, boundary_.end());
        if (front.rows > 0) {
            front.parent = front_of_[boundary_[front.boundary]];
            sibling[s] = child[front.parent];
            child[front.parent] = s;
        }
    }
}

// Fronts that nearly continue in their parents become one with them.
void Fronts::merge() {
    std::vector<Front> merged;
    std::vector<int> now(fronts_.size(), -1);  // of each front as it was
    for (std::size_t s = 0; s < fronts_.size(); ++s) {
        Front front = fronts_[s];
        while (!merged.empty() && merged.back().parent == static_cast<int>(s)) {
            const Front& last = merged.back();
            const int pivots = front.pivots + last.pivots;
            const double zeros = last.zeros + front.zeros +
                                 double(front.pivots + front.rows - last.rows) * last.pivots;
            const double full = (pivots + front.rows - 0.5 * pivots) * pivots;
            if (zeros > (pivots <= k_few ? k_zeros_of_few : k_zeros) * full) break;
            front.first = last.first;
            front.pivots = pivots;
            front.zeros = zeros;
            merged.pop_back();
        }
        merged.push_back(front);
    }
    for (std::size_t s = 0; s < merged.size(); ++s) {
        for (int i = 0; i < merged[s].pivots; ++i) {
            front_of_[merged[s].first + i] = static_cast<int>(s);
        }
    }
    for (Front& front : merged) {
        front.parent = front.rows > 0 ? front_of_[boundary_[front.boundary]] : -1;
    }
    fronts_ = std::move(merged);
}

void Fronts::lay_out(int indices, const IndexLists& blocks, const IndexLists& cliques) {
    place_.assign(std::size_t(indices), -1);
    index_ = blocks.index;
    size_ = static_cast<int>(index_.size());
    std::vector<int> block(std::size_t(indices), -1);
    for (int b = 0; b < blocks.count(); ++b) {
        for (int k = blocks.begin[b]; k < blocks.begin[b + 1]; ++k) block[blocks.index[k]] = b;
    }
    std::vector<int> sorted, pivots;
    sorted.reserve(index_.size());
    for (const int b : postorder(elimination_tree(blocks.count(), block, cliques))) {
        const int from = blocks.begin[b], to = blocks.begin[b + 1];
        if (from == to) continue;
        sorted.insert(sorted.end(), index_.begin() + from, index_.begin() + to);
        pivots.push_back(to - from);
    }
    index_ = std::move(sorted);
    for (int i = 0; i < size_; ++i) place_[index_[i]] = i;
    gather(cliques, pivots);
    merge();

    in_parent_.assign(boundary_.size(), 0);
    std::size_t panels = 0, stack = 0, most = 0;
    work_ = 0;
    tallest_ = 0;
    for (Front& front : fronts_) {
        front.panel = panels;
        panels += std::size_t(height(front)) * front.pivots;
        tallest_ = std::max(tallest_, height(front));
        for (int j = 0; j < front.pivots; ++j) work_ += 0.5 * std::pow(height(front) - j, 2);
        if (front.parent < 0) continue;
        Front& above = fronts_[front.parent];
        ++above.children;
        int row = 0;
        for (int k = front.boundary; k < front.boundary + front.rows; ++k) {
            const int place = boundary_[k];
            if (place < above.first + above.pivots) {
                in_parent_[k] = place - above.first;
                continue;
            }
            while (boundary_[above.boundary + row] < place) ++row;
            in_parent_[k] = above.pivots + row;
        }
    }
    // What is handed up waits on a stack.
    std::vector<std::size_t> sizes;
    for (const Front& front : fronts_) {
        const std::size_t own = std::size_t(front.rows) * front.rows;
        most = std::max(most, stack + own);
        for (int c = 0; c < front.children; ++c) {
            stack -= sizes.back();
            sizes.pop_back();
        }
        sizes.push_back(own);
        stack += own;
    }
    panels_.assign(panels, 0.0);
    updates_.assign(most, 0.0);
}

std::vector<std::size_t> Fronts::slots(const std::vector<std::pair<int, int>>& entries) const {
    // Front by front, so that each lists its rows but once.
    std::vector<int> next(entries.size(), -1), head(fronts_.size(), -1);
    for (std::size_t e = 0; e < entries.size(); ++e) {
        const int low = std::min(place_[entries[e].first], place_[entries[e].second]);
        next[e] = head[front_of_[low]];
        head[front_of_[low]] = static_cast<int>(e);
    }
    std::vector<std::size_t> found(entries.size(), k_none);
    std::vector<int> row(std::size_t(size_), -1);
    for (std::size_t s = 0; s < fronts_.size(); ++s) {
        if (head[s] < 0) continue;
        const Front& front = fronts_[s];
        for (int i = 0; i < front.pivots; ++i) row[front.first + i] = i;
        for (int i = 0; i < front.rows; ++i) row[boundary_[front.boundary + i]] = front.pivots + i;
        for (int e = head[s]; e >= 0; e = next[e]) {
            const auto [low, high] =
                std::minmax(place_[entries[e].first], place_[entries[e].second]);
            if (row[high] < 0) continue;
            found[e] = front.panel + std::size_t(low - front.first) * height(front) + row[high];
        }
        for (int i = 0; i < front.pivots; ++i) row[front.first + i] = -1;
        for (int i = 0; i < front.rows; ++i) row[boundary_[front.boundary + i]] = -1;
    }
    return found;
}

}  // namespace culet
