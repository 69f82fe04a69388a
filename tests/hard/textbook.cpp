#include "tests/hard/textbook.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace culet::hard {

FacePowers textbook_face(double n1, double n2, double cosine) {
    FacePowers face;
    const double eta = n1 / n2;
    const double k = 1 - eta * eta * (1 - cosine * cosine);
    if (k < 0) return {1, 1, 0, 0};
    const double beyond = std::sqrt(k);
    const double s = (n1 * cosine - n2 * beyond) / (n1 * cosine + n2 * beyond);
    const double p = (n2 * cosine - n1 * beyond) / (n2 * cosine + n1 * beyond);
    face.R_s = s * s;
    face.R_p = p * p;
    face.T_s = 1 - face.R_s;
    face.T_p = 1 - face.R_p;
    return face;
}

namespace {

using Coefficients = std::array<double, 5>;  // by rising power of q

Coefficients operator+(Coefficients a, const Coefficients& b) {
    for (std::size_t i = 0; i < 5; ++i) a[i] += b[i];
    return a;
}
Coefficients operator-(Coefficients a, const Coefficients& b) {
    for (std::size_t i = 0; i < 5; ++i) a[i] -= b[i];
    return a;
}
// Terms beyond q^4 cancel in the determinant.
Coefficients operator*(const Coefficients& a, const Coefficients& b) {
    Coefficients product{};
    for (std::size_t i = 0; i < 5; ++i) {
        for (std::size_t j = 0; i + j < 5; ++j) product[i + j] += a[i] * b[j];
    }
    return product;
}

}  // namespace

std::array<TextbookWave, 4> textbook_waves(const std::array<Vec3, 3>& axes,
                                           const std::array<double, 3>& n, const Vec3& K,
                                           const Vec3& normal) {
    double eps[3][3] = {};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            for (int a = 0; a < 3; ++a) eps[i][j] += n[a] * n[a] * axes[a][i] * axes[a][j];
        }
    }
    const double k_squared = glm::dot(K, K);
    std::array<std::array<Coefficients, 3>, 3> m{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            m[i][j] = {K[i] * K[j] + eps[i][j], K[i] * normal[j] + normal[i] * K[j],
                       normal[i] * normal[j], 0, 0};
            if (i == j) m[i][j] = m[i][j] - Coefficients{k_squared, 0, 1, 0, 0};
        }
    }
    const auto minor = [&](int j, int k) { return m[1][j] * m[2][k] - m[1][k] * m[2][j]; };
    const Coefficients c = m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1);
    Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
    for (int i = 0; i < 3; ++i) companion(i + 1, i) = 1;
    for (int i = 0; i < 4; ++i) companion(i, 3) = -c[std::size_t(i)] / c[4];
    const Eigen::Vector4cd roots = companion.eigenvalues();
    std::array<TextbookWave, 4> waves;
    for (int w = 0; w < 4; ++w) {
        waves[std::size_t(w)].q = roots[w];
        Eigen::Matrix3cd at;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                const Coefficients& e = m[std::size_t(i)][std::size_t(j)];
                at(i, j) = e[0] + roots[w] * (e[1] + roots[w] * e[2]);
            }
        }
        // The longest cross product of two rows.
        Eigen::Vector3cd best = Eigen::Vector3cd::Zero();
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3cd a = at.row(i), b = at.row((i + 1) % 3);
            const Eigen::Vector3cd x{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                     a[0] * b[1] - a[1] * b[0]};
            if (x.norm() > best.norm()) best = x;
        }
        if (best.norm() > 0) best.normalize();
        waves[std::size_t(w)].E = {best[0], best[1], best[2]};
    }
    return waves;
}

void relax_vertices(Solid& solid, int sweeps) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        std::vector<Vec3> sum(solid.vertices.size(), Vec3(0));
        std::vector<int> count(solid.vertices.size(), 0);
        for (Facet& facet : solid.facets) {
            std::vector<Vec3> loop;
            for (const int corner : facet.corners) {
                loop.push_back(solid.vertices[std::size_t(corner)]);
            }
            facet.plane = plane_through(loop);
            for (const int corner : facet.corners) {
                const Vec3& v = solid.vertices[std::size_t(corner)];
                sum[std::size_t(corner)] += v - height_above(facet.plane, v) * facet.plane.normal;
                ++count[std::size_t(corner)];
            }
        }
        for (std::size_t v = 0; v < sum.size(); ++v) {
            if (count[v] > 0) solid.vertices[v] = sum[v] / double(count[v]);
        }
    }
}

}  // namespace culet::hard
