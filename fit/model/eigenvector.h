#pragma once
// The direction of least scatter, and its derivative by the scatter matrix.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace culet {

struct LeastEigenvector {
    glm::dvec3 vector{0, 0, 1};      ///< unit; z >= 0
    glm::dmat3 pseudo_inverse{0.0};  ///< of S - l: d(vector) = -(S - l)^+ dS vector
};

/// Takes a symmetric matrix. If the least eigenvalue is repeated, the direction is arbitrary and
/// the pseudo-inverse omits the eigenspace.
LeastEigenvector least_eigenvector(const glm::dmat3& symmetric);

}  // namespace culet
