#pragma once
// LDL' factors of a sparse symmetric matrix, without pivoting, by dense fronts (Duff & Reid 1983;
// Liu 1992): indices that are eliminated together share one panel, and what their elimination
// leaves is handed up a tree as one dense block. For matrices that have such factors in any order:
// definite and quasi-definite ones (Vanderbei 1995).

#include <cstddef>
#include <vector>

namespace culet {

/// Lists of indices, one after another.
struct IndexLists {
    std::vector<int> begin{0}, index;

    int count() const { return static_cast<int>(begin.size()) - 1; }
    void close() { begin.push_back(static_cast<int>(index.size())); }
};

class Fronts {
public:
    /// `blocks`: the indices eliminated together, in the order of elimination; each once or, of the
    /// `indices` that there may be, not at all. `cliques`: of which any two may share an entry.
    void lay_out(int indices, const IndexLists& blocks, const IndexLists& cliques);

    /// Where the entry of two indices is summed up; they share a clique or a block.
    std::size_t slot(int one, int other) const;
    /// True when two indices have a place.
    bool has_slot(int one, int other) const;
    /// All entries back to zero.
    void clear();
    void add(std::size_t at_slot, double value) { panels_[at_slot] += value; }

    /// Of what was added. False when a pivot is zero or no number.
    bool factor();
    int negative_pivots() const { return negative_; }
    /// Sum of log |pivot|.
    double log_determinant() const;
    /// Solves in place, `count` right-hand sides side by side: x[index * count + k]. Indices of no
    /// block are left as they are.
    void solve(double* x, int count) const;

    /// Multiplications that factoring takes, about.
    double work() const { return work_; }

private:
    struct Front {
        int first = 0, pivots = 0, parent = -1;
        int boundary = 0, rows = 0;  ///< begin in `boundary_`; how many
        int children = 0;
        double zeros = 0;  ///< entries of its pivots' columns that are there for its shape only
        std::size_t panel = 0;
    };
    int height(const Front& f) const { return f.pivots + f.rows; }
    void gather(const IndexLists& cliques, const std::vector<int>& pivots);
    void merge();
    std::size_t find(int low, int high) const;

    int size_ = 0, negative_ = 0;
    double work_ = 0;
    std::vector<int> place_, index_;  // of index in the order; of place
    std::vector<int> front_of_;       // of place
    std::vector<Front> fronts_;       // children before parents, each subtree in one piece
    std::vector<int> boundary_;       // places below each front's pivots
    std::vector<int> in_parent_;      // of each boundary entry: its row in the parent's front
    std::vector<double> panels_, updates_;
};

}  // namespace culet
