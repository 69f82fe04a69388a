#pragma once
// The objects and stones of a scene, and their intersection with rays.

#include <limits>
#include <vector>

#include "render/geometry/stone_body.h"
#include "render/objects/mesh_tree.h"
#include "render/scene/scene.h"

namespace culet {

/// Where a ray starts: a part of an object, or a stone that it left for good.
struct RayStart {
    int object = -1, part = -1;
    int stone = -1;
};

struct WorldHit {
    double distance = std::numeric_limits<double>::infinity();
    int object = -1, stone = -1;  ///< at most one is set; both -1: no hit
    int part = -1;                ///< triangle of a mesh, face of a box, facet of a stone
    Vec3 normal{0, 0, 1};         ///< unit, outwards
    Vec3 shading{0, 0, 1};        ///< the same, interpolated if a mesh is smooth
    bool met() const { return object >= 0 || stone >= 0; }
};

/// Copies what it needs of the scene. Stone 0 is the main stone, if any; the others follow.
/// Thread-safe.
class ObjectWorld {
public:
    explicit ObjectWorld(const Scene& scene);

    /// Nearest hit from `origin` along the unit `direction`.
    WorldHit nearest(const Vec3& origin, const Vec3& direction, const RayStart& start) const;
    /// The point of the hit, on an object's surface to the last digits.
    Vec3 place(const WorldHit& hit, const Vec3& origin, const Vec3& direction) const;

    const std::vector<SceneObject>& objects() const { return objects_; }
    int stones() const { return static_cast<int>(stones_.size()); }
    const StoneBody& stone(int i) const { return stones_[static_cast<std::size_t>(i)].body; }
    bool has_first_stone() const { return first_stone_; }

private:
    struct PlacedStone {
        StoneBody body;
        Vec3 center;  ///< of a ball around it
        double radius;
        bool apart_from(const Vec3& origin, const Vec3& direction) const;
    };
    std::vector<SceneObject> objects_;
    std::vector<int> formulas_;  ///< objects that are not meshes
    MeshTree meshes_;
    std::vector<PlacedStone> stones_;
    bool first_stone_ = false;
};

}  // namespace culet
