#include "render/scene/plain_shading.h"

#include <fmt/format.h>

namespace culet {

namespace {

constexpr double k_strongest = 100, k_highest_exponent = 1e5;

void read_coefficient(const TomlTable& table, const char* key, double most, double& value) {
    const auto given = table.number(key);
    if (!given) return;
    if (!(*given >= 0 && *given <= most))
        table.fail(key, fmt::format("{} is 0 to {}, found {}", key, most, *given));
    value = *given;
}

}  // namespace

PlainShading read_shading(const TomlTable& table) {
    table.refuse_unknown({"ambient", "diffuse", "specular", "exponent", "attenuation"});
    PlainShading shading;
    read_coefficient(table, "ambient", k_strongest, shading.ambient);
    read_coefficient(table, "diffuse", k_strongest, shading.diffuse);
    read_coefficient(table, "specular", k_strongest, shading.specular);
    read_coefficient(table, "exponent", k_highest_exponent, shading.exponent);
    if (const auto given = table.vector("attenuation")) {
        const bool positive = given->x >= 0 && given->y >= 0 && given->z >= 0;
        if (!positive || !(given->x + given->y + given->z > 0)) {
            table.fail("attenuation",
                       "attenuation is [constant, linear, quadratic], none below 0 and not all 0");
        }
        shading.attenuation = {given->x, given->y, given->z};
    }
    return shading;
}

}  // namespace culet
