#include "render/scene/turned_lights.h"

#include <utility>

#include "render/scene/environment_layout.h"

namespace culet {

namespace {

void turn(LinearPolarisation& polarisation, const glm::dmat3& by) {
    polarisation.vibration = by * polarisation.vibration;
    if (polarisation.normal) polarisation.normal = by * *polarisation.normal;
}

void turn(LightColour& colour, const glm::dmat3& by) {
    if (colour.polarisation) turn(*colour.polarisation, by);
}

EnvironmentMap turned_map(const EnvironmentMap& map, const glm::dmat3& by) {
    EnvironmentMap result{map.width, map.height, {}};
    result.rgb.reserve(map.rgb.size());
    const glm::dmat3 back = glm::transpose(by);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const Rgb colour =
                map.at(back * lat_long_direction(x + 0.5, y + 0.5, map.width, map.height));
            for (const double c : colour) result.rgb.push_back(static_cast<float>(c));
        }
    }
    return result;
}

struct TurnPart {
    const glm::dmat3& by;
    const Vec3& about;
    void point(Vec3& p) const { p = about + by * (p - about); }
    void direction(Vec3& d) const { d = by * d; }
    void extent(std::optional<Vec3>& e) const {
        if (e) *e = by * *e;
    }
    void number(double&) const {}
};

}  // namespace

Lights turned_lights(const Lights& lights, const glm::dmat3& by, const Vec3& about) {
    Lights result = lights;
    if (lights.environment) {
        result.environment =
            std::make_shared<const EnvironmentMap>(turned_map(*lights.environment, by));
    }
    if (result.polarisation) turn(*result.polarisation, by);
    for (Light& light : result.sources) {
        std::visit([&](auto& l) { l.each_part(l, TurnPart{by, about}); }, light);
        turn(colour_of(light), by);
    }
    return result;
}

}  // namespace culet
