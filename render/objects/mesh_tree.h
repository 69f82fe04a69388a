#pragma once
// Intersection of rays with meshes, by Embree.

#include <memory>
#include <optional>

#include "render/scene/objects.h"

namespace culet {

struct TriangleHit {
    double distance = 0;
    int object = 0, triangle = 0;
    Vec3 normal{0, 0, 1};   ///< unit, oriented by the order of the corners
    Vec3 shading{0, 0, 1};  ///< the same, or interpolated from the corners' normals if the mesh is
                            ///< smooth
};

/// The meshes of a scene's objects. Embree finds the triangle in single precision, relative to a
/// sphere around all meshes. Distance and normal then come from its plane in double precision.
class MeshTree {
public:
    explicit MeshTree(const std::vector<SceneObject>& objects);
    ~MeshTree();
    MeshTree(const MeshTree&) = delete;
    MeshTree& operator=(const MeshTree&) = delete;

    /// Nearest hit from `origin` along the unit `direction`. `object`, `triangle`: where the ray
    /// starts, which is not hit (-1: none).
    std::optional<TriangleHit> nearest(const Vec3& origin, const Vec3& direction, int object = -1,
                                       int triangle = -1) const;

private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
    std::vector<std::shared_ptr<const TriangleMesh>> meshes_;  // by object; null: another shape
    Vec3 center_{0, 0, 0};
    double radius_ = 0;
};

}  // namespace culet
