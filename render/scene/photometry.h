#pragma once
// Luminous intensity of lamps over directions, as their makers' files state it: IES LM-63 (1986 to
// 2019) and EULUMDAT.

#include <filesystem>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

namespace culet {

struct Photometry {
    /// LM-63's types; EULUMDAT is of type C. The lamp's z axis is nadir in types C and B, the beam
    /// in type A; x is the direction of C = 0, V = 90 (B) or of the lamp's top (A). Seen from above
    /// the lamp, C turns counter-clockwise, and horizontal angles of A and B turn clockwise.
    enum class Type { a, b, c };
    Type type = Type::c;
    std::vector<double> vertical, horizontal;  ///< degrees, ascending; one part of a symmetric lamp
    std::vector<double> candela;               ///< [horizontal][vertical]
    double greatest = 0;                       ///< candela
    double opening_mm2 = 0;                    ///< area of the luminous opening; 0: not given
    std::vector<double> tilt, tilt_factor;     ///< degrees, ascending, and factors; or empty

    /// Candela in the direction x, y, z of the lamp (of any length but 0), y being x cross z:
    /// linear in both angles, by the lamp's symmetry, 0 outside the measured angles.
    double at(const glm::dvec3& direction) const;
    /// 1 without a tilt table; the nearest value beyond its ends.
    double factor_at_tilt(double degrees) const;
};

/// Reads `.ies` and `.ldt`, by the name's extension. `bytes` is the file's content. Throws
/// InputError with file and line.
Photometry photometry_of(std::string_view bytes, const std::filesystem::path& file);

}  // namespace culet
