#pragma once
// LDL' factors of a sparse symmetric matrix, without pivoting, by dense fronts (Duff & Reid 1983;
// Liu 1992): indices that are eliminated together share one panel, and what their elimination
// leaves is handed up a tree as one dense block. For matrices that have such factors in any order:
// definite and quasi-definite ones (Vanderbei 1995).

#include <cstddef>
#include <utility>
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

    /// Where entries of two indices are summed up; `k_none`: they share no clique, block or fill.
    static constexpr std::size_t k_none = ~std::size_t(0);
    std::vector<std::size_t> slots(const std::vector<std::pair<int, int>>& entries) const;
    /// All entries back to zero.
    void clear();
    void add(std::size_t at_slot, double value) { panels_[at_slot] += value; }

    /// Of what was added. False when a pivot is zero or no number.
    bool factor();
    int negative_pivots() const { return negative_; }
    /// Sum of log |pivot|.
    double log_determinant() const;
    /// Right-hand sides that are solved at once: one, or so many.
    static constexpr int k_together = 8;
    /// Solves in place, `count` right-hand sides side by side: x[index * count + k]. Indices of no
    /// block are left as they are.
    void solve(double* x, int count) const;

    /// D^-1/2 L^-1 f of a definite matrix, where it is not zero: f'A^-1 g is the product of two.
    /// Places stand in the order of elimination.
    struct Half {
        std::vector<int> place;
        std::vector<double> value;
    };
    Half half(const std::vector<std::pair<int, double>>& entries) const;
    static double product(const Half& one, const Half& other);

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
    template <int W>
    void solve_together(double* x) const;

    int size_ = 0, negative_ = 0, tallest_ = 0;
    double work_ = 0;
    std::vector<int> place_, index_;  // of index in the order; of place
    std::vector<int> front_of_;       // of place
    std::vector<Front> fronts_;       // children before parents, each subtree in one piece
    std::vector<int> boundary_;       // places below each front's pivots
    std::vector<int> in_parent_;      // of each boundary entry: its row in the parent's front
    std::vector<double> panels_, updates_;
    mutable std::vector<double> ordered_, below_, waiting_;  // room for `solve` and `half`
};

}  // namespace culet
