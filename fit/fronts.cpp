#include "fit/fronts.h"

#include <algorithm>
#include <cmath>

#include "stone/errors.h"

namespace culet {

namespace {

// column -= sum of factor[q] * other[q], q < W.
template <int W>
void subtract(double* column, const double* const* other, const double* factor, int count) {
    if constexpr (W == 4) {
        const double *a = other[0], *b = other[1], *c = other[2], *d = other[3];
        const double fa = factor[0], fb = factor[1], fc = factor[2], fd = factor[3];
        for (int i = 0; i < count; ++i) {
            column[i] -= (fa * a[i] + fb * b[i]) + (fc * c[i] + fd * d[i]);
        }
    } else {
        for (int q = 0; q < W; ++q) {
            const double* a = other[q];
            const double f = factor[q];
            for (int i = 0; i < count; ++i) column[i] -= f * a[i];
        }
    }
}

// The same of two columns at once, which share what they read.
void subtract_from_two(double* one, double* two, const double* const* other, const double* of_one,
                       const double* of_two, int count) {
    const double *a = other[0], *b = other[1], *c = other[2], *d = other[3];
    const double pa = of_one[0], pb = of_one[1], pc = of_one[2], pd = of_one[3];
    const double qa = of_two[0], qb = of_two[1], qc = of_two[2], qd = of_two[3];
    for (int i = 0; i < count; ++i) {
        one[i] -= (pa * a[i] + pb * b[i]) + (pc * c[i] + pd * d[i]);
        two[i] -= (qa * a[i] + qb * b[i]) + (qc * c[i] + qd * d[i]);
    }
}

// What W pivots from the `from`-th on take from the columns after them and from what is handed up.
template <int W>
void update_right(double* panel, int height, int pivots, int from, double* update, int rows) {
    double pivot[W];
    for (int q = 0; q < W; ++q) pivot[q] = panel[std::size_t(from + q) * height + from + q];
    const auto factors_of = [&](int row, double* factor) {
        for (int q = 0; q < W; ++q) {
            factor[q] = panel[std::size_t(from + q) * height + row] * pivot[q];
        }
    };
    const auto take = [&](double* column, int row) {
        const double* other[W];
        double factor[W];
        for (int q = 0; q < W; ++q) other[q] = panel + std::size_t(from + q) * height + row;
        factors_of(row, factor);
        subtract<W>(column, other, factor, height - row);
    };
    for (int k = from + W; k < pivots; ++k) take(panel + std::size_t(k) * height + k, k);
    int k = 0;
    if constexpr (W == 4) {
        for (; k + 1 < rows; k += 2) {
            const int row = pivots + k;
            double* one = update + std::size_t(k) * rows + k;
            double* two = one + rows;  // of the same row as `one`; its own half begins below
            const double* other[W];
            double of_one[W], of_two[W];
            for (int q = 0; q < W; ++q) other[q] = panel + std::size_t(from + q) * height + row;
            factors_of(row, of_one);
            factors_of(row + 1, of_two);
            subtract_from_two(one, two, other, of_one, of_two, height - row);
        }
    }
    for (; k < rows; ++k) take(update + std::size_t(k) * rows + k, pivots + k);
}

// The pivots' columns become L, with D on the diagonal; what is left of the others is subtracted
// from `update` (rows x rows, lower half).
bool factor_dense(double* panel, int height, int pivots, double* update, int rows) {
    constexpr int k_width = 4;
    for (int from = 0; from < pivots; from += k_width) {
        const int width = std::min(k_width, pivots - from);
        for (int j = from; j < from + width; ++j) {
            double* column = panel + std::size_t(j) * height;
            for (int q = from; q < j; ++q) {
                const double* other = panel + std::size_t(q) * height;
                const double factor = other[j] * other[q];
                for (int i = j; i < height; ++i) column[i] -= factor * other[i];
            }
            const double pivot = column[j];
            if (!(std::abs(pivot) > 0) || !std::isfinite(pivot)) return false;
            const double inverse = 1 / pivot;
            for (int i = j + 1; i < height; ++i) column[i] *= inverse;
        }
        switch (width) {
            case 4:
                update_right<4>(panel, height, pivots, from, update, rows);
                break;
            case 3:
                update_right<3>(panel, height, pivots, from, update, rows);
                break;
            case 2:
                update_right<2>(panel, height, pivots, from, update, rows);
                break;
            default:
                update_right<1>(panel, height, pivots, from, update, rows);
        }
    }
    return true;
}

double dot(const double* a, const double* b, int count) {
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
    int i = 0;
    for (; i + 3 < count; i += 4) {
        s0 += a[i] * b[i];
        s1 += a[i + 1] * b[i + 1];
        s2 += a[i + 2] * b[i + 2];
        s3 += a[i + 3] * b[i + 3];
    }
    for (; i < count; ++i) s0 += a[i] * b[i];
    return (s0 + s1) + (s2 + s3);
}

}  // namespace

void Fronts::clear() {
    std::fill(panels_.begin(), panels_.end(), 0.0);
}

bool Fronts::factor() {
    negative_ = 0;
    std::size_t top = 0;
    std::vector<const Front*> waiting;
    for (const Front& front : fronts_) {
        double* panel = panels_.data() + front.panel;
        double* update = updates_.data() + top;
        const int tall = height(front), rows = front.rows;
        // Of lower halves, and of what stands beside them where two columns are taken together.
        for (int j = 0; j < rows; ++j) {
            const int from = std::max(0, j - 1);
            std::fill_n(update + std::size_t(j) * rows + from, rows - from, 0.0);
        }
        std::size_t base = top;
        for (int c = 0; c < front.children; ++c) {
            const Front& child = *waiting.back();
            waiting.pop_back();
            const int count = child.rows;
            base -= std::size_t(count) * count;
            const int* to = in_parent_.data() + child.boundary;
            for (int j = 0; j < count; ++j) {
                const double* from = updates_.data() + base + std::size_t(j) * count;
                double* column = to[j] < front.pivots
                                     ? panel + std::size_t(to[j]) * tall
                                     : update + std::size_t(to[j] - front.pivots) * rows;
                const int shift = to[j] < front.pivots ? 0 : front.pivots;
                for (int i = j; i < count; ++i) column[to[i] - shift] += from[i];
            }
        }
        if (!factor_dense(panel, tall, front.pivots, update, rows)) return false;
        for (int j = 0; j < front.pivots; ++j) {
            negative_ += panel[std::size_t(j) * tall + j] < 0;
        }
        for (int j = 0; j < rows && base != top; ++j) {
            const std::size_t from = std::size_t(j) * rows + j;
            std::copy_n(update + from, rows - j, updates_.data() + base + from);
        }
        top = base + std::size_t(rows) * rows;
        waiting.push_back(&front);
    }
    return true;
}

double Fronts::log_determinant() const {
    double sum = 0;
    for (const Front& front : fronts_) {
        for (int j = 0; j < front.pivots; ++j) {
            sum += std::log(
                std::abs(panels_[front.panel + std::size_t(j) * height(front) + std::size_t(j)]));
        }
    }
    return sum;
}

// W right-hand sides side by side.
template <int W>
void Fronts::solve_together(double* x) const {
    std::vector<double>& y = ordered_;
    std::vector<double>& below = below_;
    y.resize(std::size_t(size_) * W);
    below.resize(std::size_t(tallest_) * W);
    const auto copy = [](const double* from, double* to) {
        for (int k = 0; k < W; ++k) to[k] = from[k];
    };
    for (int i = 0; i < size_; ++i)
        copy(x + std::size_t(index_[i]) * W, y.data() + std::size_t(i) * W);
    for (const Front& front : fronts_) {
        const int tall = height(front), rows = front.rows;
        double* own = y.data() + std::size_t(front.first) * W;
        std::fill_n(below.begin(), std::size_t(rows) * W, 0.0);
        for (int j = 0; j < front.pivots; ++j) {
            const double* column = panels_.data() + front.panel + std::size_t(j) * tall;
            const double* value = own + std::size_t(j) * W;
            for (int i = j + 1; i < front.pivots; ++i) {
                for (int k = 0; k < W; ++k) own[i * W + k] -= column[i] * value[k];
            }
            const double* lower = column + front.pivots;
            for (int i = 0; i < rows; ++i) {
                for (int k = 0; k < W; ++k) below[std::size_t(i * W + k)] += lower[i] * value[k];
            }
        }
        const int* boundary = boundary_.data() + front.boundary;
        for (int i = 0; i < rows; ++i) {
            double* to = y.data() + std::size_t(boundary[i]) * W;
            for (int k = 0; k < W; ++k) to[k] -= below[std::size_t(i * W + k)];
        }
    }
    for (auto f = fronts_.rbegin(); f != fronts_.rend(); ++f) {
        const Front& front = *f;
        const int tall = height(front), rows = front.rows;
        double* own = y.data() + std::size_t(front.first) * W;
        // The front's rows one after another, as its columns have them.
        const int* boundary = boundary_.data() + front.boundary;
        for (int i = 0; i < rows; ++i) {
            copy(y.data() + std::size_t(boundary[i]) * W,
                 below.data() + std::size_t(front.pivots + i) * W);
        }
        for (int j = front.pivots - 1; j >= 0; --j) {
            const double* column = panels_.data() + front.panel + std::size_t(j) * tall;
            double* value = own + std::size_t(j) * W;
            double* kept = below.data() + std::size_t(j) * W;
            if constexpr (W == 1) {
                *kept =
                    *value / column[j] - dot(column + j + 1, below.data() + j + 1, tall - j - 1);
            } else {
                double sum[W];
                for (int k = 0; k < W; ++k) sum[k] = value[k] / column[j];
                for (int i = j + 1; i < tall; ++i) {
                    const double* from = below.data() + std::size_t(i) * W;
                    for (int k = 0; k < W; ++k) sum[k] -= column[i] * from[k];
                }
                copy(sum, kept);
            }
            copy(kept, value);
        }
    }
    for (int i = 0; i < size_; ++i)
        copy(y.data() + std::size_t(i) * W, x + std::size_t(index_[i]) * W);
}

void Fronts::solve(double* x, int count) const {
    if (count == 1) return solve_together<1>(x);
    if (count == k_together) return solve_together<k_together>(x);
    check(false, "as many right-hand sides as are solved together");
}

Fronts::Half Fronts::half(const std::vector<std::pair<int, double>>& entries) const {
    // Only fronts between the entries and the root have a part in it.
    std::vector<int> path;
    waiting_.resize(std::size_t(size_), 0.0);
    for (const auto& [index, value] : entries) {
        waiting_[place_[index]] += value;
        path.push_back(front_of_[place_[index]]);
    }
    std::sort(path.begin(), path.end());
    path.erase(std::unique(path.begin(), path.end()), path.end());
    std::vector<int> more;
    for (std::size_t p = 0; p < path.size(); ++p) {
        // Up to where the next one's way joins.
        const int stop = p + 1 < path.size() ? path[p + 1] : static_cast<int>(fronts_.size());
        for (int s = path[p]; s >= 0 && s < stop; s = fronts_[s].parent) more.push_back(s);
        // What is left of this way is the next one's or passes it.
        int s = path[p];
        while (s >= 0 && s < stop) s = fronts_[s].parent;
        if (s > stop) {
            const auto at = std::lower_bound(path.begin() + std::ptrdiff_t(p) + 1, path.end(), s);
            if (at == path.end() || *at != s) path.insert(at, s);
        }
    }
    Half half;
    for (const int s : more) {
        const Front& front = fronts_[s];
        const int tall = height(front);
        double* own = waiting_.data() + front.first;
        const int* boundary = boundary_.data() + front.boundary;
        for (int j = 0; j < front.pivots; ++j) {
            const double* column = panels_.data() + front.panel + std::size_t(j) * tall;
            const double value = own[j];
            for (int i = j + 1; i < front.pivots; ++i) own[i] -= column[i] * value;
            for (int i = 0; i < front.rows; ++i) {
                waiting_[boundary[i]] -= column[front.pivots + i] * value;
            }
            half.place.push_back(front.first + j);
            half.value.push_back(value / std::sqrt(std::abs(column[j])));
            own[j] = 0;
        }
    }
    return half;
}

double Fronts::product(const Half& one, const Half& other) {
    double sum = 0;
    std::size_t i = 0, k = 0;
    while (i < one.place.size() && k < other.place.size()) {
        if (one.place[i] == other.place[k]) {
            sum += one.value[i++] * other.value[k++];
        } else if (one.place[i] < other.place[k]) {
            ++i;
        } else {
            ++k;
        }
    }
    return sum;
}

}  // namespace culet
