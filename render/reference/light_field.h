#pragma once
// The lights of a scene, as surroundings of its stone.

#include "render/reference/surroundings.h"

namespace culet {

/// Combines near and distant lights as lights.h says.
class LightField : public Surroundings {
public:
    LightField(const Lights& lights, const WavelengthSet& wavelengths);
    ~LightField() override;

    void add_radiance(const Vec3& origin, const Vec3& direction, double weight, int first,
                      int count, double* radiance) const override;
    void add_stokes(const PathEnd& end, int first, int count, double* stokes,
                    int stride) const override;
    void add_direct_stokes(const EyeRay& ray, const EyeFrame& frame, int nodes,
                           double* stokes) const override;
    double nearest_distance(const Vec3& origin, const Vec3& direction) const override;
    bool stands_at(const Vec3&, const Vec3&) const override { return false; }
    std::string name_at(const Vec3& origin, const Vec3& direction) const override;
    double max_radiance() const override;

private:
    struct Ready;
    std::unique_ptr<Ready> ready_;
};

}  // namespace culet
