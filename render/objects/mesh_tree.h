#pragma once
// Where rays meet the triangles of meshes, by Embree.

#include <memory>
#include <optional>

#include "render/scene/objects.h"

namespace culet {

struct TriangleHit {
    double distance = 0;
    int object = 0, triangle = 0;
    Vec3 normal{0, 0, 1};   ///< unit, by the order of the corners
    Vec3 shading{0, 0, 1};  ///< the same, or where the mesh is smooth that of its corners' mean
};

/// The meshes among a scene's objects. Embree finds the triangle in single precision, relative to a
/// sphere around all meshes; distance and normal are then those of its plane in double precision.
class MeshTree {
public:
    explicit MeshTree(const std::vector<SceneObject>& objects);
    ~MeshTree();
    MeshTree(const MeshTree&) = delete;
    MeshTree& operator=(const MeshTree&) = delete;

    /// The nearest, from `origin` along the unit `direction`. `object`, `triangle`: what the origin
    /// lies on, and is not met; -1: nothing of these.
    std::optional<TriangleHit> nearest(const Vec3& origin, const Vec3& direction, int object = -1,
                                       int triangle = -1) const;

private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
    std::vector<std::shared_ptr<const TriangleMesh>> meshes_;  // by object; none: other shapes
    Vec3 center_{0, 0, 0};
    double radius_ = 0;
};

}  // namespace culet
