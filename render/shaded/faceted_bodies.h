#pragma once
// What stands in a scene as bodies of flat facets, for shadings that colour facets and vertices.

#include <memory>
#include <vector>

#include "render/objects/object_world.h"
#include "render/shaded/plain_surface.h"

namespace culet {

/// Triangles, and which facet each belongs to: a stone's facet, a side of a box, a triangle of a
/// mesh or of a tessellated sphere.
struct FacetedBody {
    std::shared_ptr<const TriangleMesh> mesh;
    std::vector<int> facet_of;  ///< of each triangle
    struct Face {
        Vec3 middle{0, 0, 0}, normal{0, 0, 1};  ///< of its corners; unit, outwards
    };
    std::vector<Face> facets;
    /// Unit normals of each triangle's corners: the mean, by area, of the facets that meet there;
    /// of a mesh that has its own: those.
    std::vector<std::array<Vec3, 3>> corner_normals;

    /// Weights of a triangle's corners at a point of it (barycentric), none below 0; their sum is
    /// 1.
    std::array<double, 3> weights(int triangle, const Vec3& point) const;
};

/// Everything in a scene, stones too, as one list. Spheres are bodies where `tessellated`; planes
/// and discs never are.
class FacetedBodies {
public:
    FacetedBodies(const Scene& scene, bool tessellated);

    int size() const { return static_cast<int>(surfaces_.size()); }
    /// Nothing for a plane, a disc and a sphere that is a sphere.
    const FacetedBody* body(int i) const { return bodies_[static_cast<std::size_t>(i)].get(); }
    const PlainSurface& surface(int i) const { return surfaces_[static_cast<std::size_t>(i)]; }
    /// A point that an endless plane or a disc is given by.
    Vec3 middle(int i) const;
    const ObjectWorld& world() const { return *world_; }

private:
    std::vector<std::unique_ptr<FacetedBody>> bodies_;
    std::vector<PlainSurface> surfaces_;
    std::unique_ptr<const ObjectWorld> world_;
};

/// Middle of all that has a size: stones and objects, but endless planes. Of nothing else: the
/// camera's look_at.
Vec3 middle_of(const Scene& scene);

}  // namespace culet
