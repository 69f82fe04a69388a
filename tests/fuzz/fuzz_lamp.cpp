// Lamps of IES LM-63 and EULUMDAT: what is read has an intensity in every direction.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "render/scene/photometry.h"
#include "stone/text/errors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace culet;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    for (const char* file : {"lamp.ies", "lamp.ldt"}) {
        try {
            const Photometry lamp = photometry_of(bytes, file);
            for (int i = 0; i < 27; ++i) {
                const glm::dvec3 direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
                if (direction == glm::dvec3(0)) continue;
                const double candela = lamp.at(direction);
                // Linear between values, up to rounding.
                if (!(candela >= 0 && candela <= lamp.greatest * (1 + 1e-9))) std::abort();
                if (!std::isfinite(lamp.factor_at_tilt(90.0 * i / 26))) std::abort();
            }
        } catch (const InputError&) {
        }
    }
    return 0;
}
