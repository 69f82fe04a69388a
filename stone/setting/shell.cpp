#include "stone/setting/shell.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

namespace culet {

namespace {

constexpr double k_half_turn = std::numbers::pi;

// Rings of `sides` vertices each, each joined to the next. Vertices are counter-clockwise about
// `along`.
class Rings {
public:
    explicit Rings(int sides) : sides_(sides) {}

    // A ring about `middle`, in the plane of `out` and `aside`; out x aside points backwards.
    void add(const Vec3& middle, const Vec3& out, const Vec3& aside) {
        for (int i = 0; i < sides_; ++i) {
            const double angle = 2 * k_half_turn * i / sides_;
            shell_.vertices.push_back(middle + std::cos(angle) * out - std::sin(angle) * aside);
        }
        ++count_;
    }

    void join(int a, int b) {
        for (int i = 0; i < sides_; ++i) {
            const int j = (i + 1) % sides_;
            triangle(a * sides_ + i, a * sides_ + j, b * sides_ + j);
            triangle(a * sides_ + i, b * sides_ + j, b * sides_ + i);
        }
    }

    void close_end(int round, const Vec3& tip, bool last) {
        const int pole = static_cast<int>(shell_.vertices.size());
        shell_.vertices.push_back(tip);
        for (int i = 0; i < sides_; ++i) {
            const int a = round * sides_ + i, b = round * sides_ + (i + 1) % sides_;
            if (last) {
                triangle(a, b, pole);
            } else {
                triangle(b, a, pole);
            }
        }
    }

    int count() const { return count_; }
    Shell take() { return std::move(shell_); }

private:
    void triangle(int a, int b, int c) { shell_.triangles.push_back({a, b, c}); }

    int sides_, count_ = 0;
    Shell shell_;
};

std::vector<Vec3> without_repeats(const std::vector<Vec3>& path, double near, bool closed) {
    std::vector<Vec3> kept;
    for (const Vec3& point : path) {
        if (kept.empty() || glm::length(point - kept.back()) > near) kept.push_back(point);
    }
    while (closed && kept.size() > 3 && glm::length(kept.back() - kept.front()) <= near)
        kept.pop_back();
    return kept;
}

}  // namespace

Shell round_wire(const std::vector<Vec3>& whole_path, double radius, const Vec3& aside, int sides) {
    const std::vector<Vec3> path = without_repeats(whole_path, 1e-3 * radius, false);
    Rings rings(sides);
    const int rows = sides / 4;
    const std::size_t last = path.size() - 1;
    const Vec3 begins = glm::normalize(path[1] - path[0]),
               ends = glm::normalize(path[last] - path[last - 1]);
    // A half ball without its pole.
    for (int k = 1; k < rows; ++k) {
        const double angle = 0.5 * k_half_turn * k / rows;
        rings.add(path[0] - radius * std::cos(angle) * begins,
                  radius * std::sin(angle) * glm::cross(begins, aside),
                  radius * std::sin(angle) * aside);
    }
    for (std::size_t i = 0; i <= last; ++i) {
        const Vec3 before = i == 0 ? begins : glm::normalize(path[i] - path[i - 1]);
        const Vec3 after = i == last ? ends : glm::normalize(path[i + 1] - path[i]);
        const Vec3 along = glm::normalize(before + after);
        rings.add(path[i], radius * glm::cross(along, aside), radius * aside);
    }
    for (int k = rows - 1; k >= 1; --k) {
        const double angle = 0.5 * k_half_turn * k / rows;
        rings.add(path[last] + radius * std::cos(angle) * ends,
                  radius * std::sin(angle) * glm::cross(ends, aside),
                  radius * std::sin(angle) * aside);
    }
    const int count = rings.count();
    for (int i = 0; i + 1 < count; ++i) rings.join(i, i + 1);
    rings.close_end(0, path[0] - radius * begins, false);
    rings.close_end(count - 1, path[last] + radius * ends, true);
    return rings.take();
}

Shell closed_wire(const std::vector<Vec3>& whole_path, double radius, const Vec3& aside,
                  int sides) {
    const std::vector<Vec3> path = without_repeats(whole_path, 1e-3 * radius, true);
    const std::size_t count = path.size();
    Rings rings(sides);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 before = glm::normalize(path[i] - path[(i + count - 1) % count]),
                   after = glm::normalize(path[(i + 1) % count] - path[i]);
        const Vec3 along = glm::normalize(before + after);
        rings.add(path[i], radius / glm::dot(along, after) * glm::cross(along, aside),
                  radius * aside);
    }
    for (int i = 0; i < rings.count(); ++i) rings.join(i, (i + 1) % rings.count());
    return rings.take();
}

Shell swept_collar(const PlanOutline& outline, const std::vector<PlanPoint>& section) {
    const std::size_t count = outline.size();
    Shell shell;
    // One row per point of the section; corners that coincide share a vertex.
    std::vector<std::vector<int>> rows;
    for (const PlanPoint& point : section) {
        const PlanOutline moved = moved_outline(outline, point.x);
        const auto new_vertex = [&](std::size_t k) {
            shell.vertices.emplace_back(moved[k].x, moved[k].y, point.y);
            return static_cast<int>(shell.vertices.size()) - 1;
        };
        std::vector<int> row{new_vertex(0)};
        for (std::size_t k = 1; k < count; ++k)
            row.push_back(moved[k] == moved[k - 1] ? row.back()
                          : moved[k] == moved[0]   ? row.front()
                                                   : new_vertex(k));
        rows.push_back(std::move(row));
    }
    const auto add = [&shell](int a, int b, int c) {
        if (a != b && b != c && c != a) shell.triangles.push_back({a, b, c});
    };
    for (std::size_t j = 0; j < section.size(); ++j) {
        const auto &here = rows[j], &next = rows[(j + 1) % section.size()];
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t l = (k + 1) % count;
            add(here[k], here[l], next[l]);
            add(here[k], next[l], next[k]);
        }
    }
    return shell;
}

bool is_closed(const Shell& shell) {
    std::map<std::pair<int, int>, int> runs;
    for (const auto& t : shell.triangles) {
        for (int i = 0; i < 3; ++i) ++runs[{t[i], t[(i + 1) % 3]}];
    }
    return std::all_of(runs.begin(), runs.end(), [&runs](const auto& run) {
        const auto back = runs.find({run.first.second, run.first.first});
        return run.second == 1 && back != runs.end() && back->second == 1;
    });
}

}  // namespace culet
