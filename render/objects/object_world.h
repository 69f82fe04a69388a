#pragma once
// All that stands in a scene: objects and stones, and where rays meet them.

#include <limits>
#include <vector>

#include "render/geometry/stone_body.h"
#include "render/objects/mesh_tree.h"
#include "render/scene/scene.h"

namespace culet {

/// What a ray starts on, if it is one of these: a part of an object, or a stone that it left for
/// good.
struct RayStart {
    int object = -1, part = -1;
    int stone = -1;
};

struct WorldHit {
    double distance = std::numeric_limits<double>::infinity();
    int object = -1, stone = -1;  ///< one of them; both -1: nothing is met
    int part = -1;                ///< triangle of a mesh, face of a box, facet of a stone
    Vec3 normal{0, 0, 1};         ///< unit, outwards
    Vec3 shading{0, 0, 1};        ///< the same but where a mesh is smooth
    bool met() const { return object >= 0 || stone >= 0; }
};

/// Keeps what it needs of the scene. Stone 0 is the one that the scene is about, if it has one; the
/// others follow. May be asked from any thread.
class ObjectWorld {
public:
    explicit ObjectWorld(const Scene& scene);

    /// The nearest thing from `origin` along the unit `direction`.
    WorldHit nearest(const Vec3& origin, const Vec3& direction, const RayStart& start) const;
    /// Where that is, on the surface of an object to the last digits.
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
    std::vector<int> formulas_;  ///< objects that are no meshes
    MeshTree meshes_;
    std::vector<PlacedStone> stones_;
    bool first_stone_ = false;
};

}  // namespace culet
