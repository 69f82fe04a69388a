#include "compare/calibration/level_curve.h"

#include <algorithm>

namespace culet {

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
    if (at <= x.front()) return y.front();
    if (at >= x.back()) return y.back();
    const auto above = std::upper_bound(x.begin(), x.end(), at);
    const auto i = static_cast<std::size_t>(above - x.begin());
    const double part = (at - x[i - 1]) / (x[i] - x[i - 1]);
    return y[i - 1] + part * (y[i] - y[i - 1]);
}

double inverse_of_falling(const std::vector<double>& x, const std::vector<double>& y,
                          double value) {
    std::size_t first = 0;  // index of the first y <= value
    while (first < y.size() && y[first] > value) ++first;
    if (first == y.size()) return x.back();
    std::size_t last = first;
    while (last + 1 < y.size() && y[last + 1] == y[first] && y[first] == value) ++last;
    if (y[first] == value) return (x[first] + x[last]) / 2;
    if (first == 0) return x.front();
    const double part = (y[first - 1] - value) / (y[first - 1] - y[first]);
    return x[first - 1] + part * (x[first] - x[first - 1]);
}

std::vector<double> monotone(const std::vector<double>& values) {
    struct Block {
        double sum = 0;
        std::size_t count = 0;
        double mean() const { return sum / static_cast<double>(count); }
    };
    std::vector<Block> blocks;
    for (const double value : values) {
        blocks.push_back({value, 1});
        while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
            const Block last = blocks.back();
            blocks.pop_back();
            blocks.back().sum += last.sum;
            blocks.back().count += last.count;
        }
    }
    std::vector<double> result;
    for (const Block& block : blocks) result.insert(result.end(), block.count, block.mean());
    return result;
}

std::vector<double> falling(std::vector<double> values) {
    for (double& v : values) v = -v;
    values = monotone(values);
    for (double& v : values) v = -v;
    return values;
}

std::vector<double> smoothed(const std::vector<double>& values) {
    std::vector<double> result;
    for (std::size_t i = 0; i < values.size(); ++i) {
        double sum = 2 * values[i], weight = 2;
        if (i > 0) {
            sum += values[i - 1];
            ++weight;
        }
        if (i + 1 < values.size()) {
            sum += values[i + 1];
            ++weight;
        }
        result.push_back(sum / weight);
    }
    return result;
}

}  // namespace culet
