#pragma once
// Outlines of a stone: one closed curve for each line of sight, in parallel projection. Lengths are
// in the stone's unit.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// One outline, as measured points. Their coordinate along the line of sight has no meaning.
struct Contour {
    Vec3 direction{0, 0, 1};      ///< of the line of sight, unit length; its sign does not matter
    std::vector<Vec3> points;     ///< in order around the outline
    std::vector<double> weights;  ///< by point: its variance is sigma^2 / weight
    double sigma = 0;             ///< standard uncertainty across the outline; 0 if not stated
};

/// The outlines of one [[silhouette]] table.
struct SilhouetteSet {
    /// They have a frame of their own, which may be turned and shifted against the mesh's.
    bool is_free = false;
    std::vector<Contour> contours;
    /// Only compared with the fitted stone: no part of the fit.
    std::vector<Contour> held_out;
    /// Parts of outlines that the file itself marks as not measured.
    int parts_left_out = 0;

    std::size_t points() const;
    bool has_sigma() const;  ///< every outline states one
};

/// Distances of the outlines' points from the outlines of a solid.
struct SilhouetteMisfit {
    double rms = 0, worst = 0;  ///< of the points that count; rms weighted
    int points = 0;             ///< points that count
    int outliers = 0;           ///< points that do not: dust, the holder
    int contours = 0;
};

/// A rigid motion: place_in_stone = turn * place_in_set + shift.
struct FrameMotion {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< columns of the rotation
    Vec3 shift{0, 0, 0};

    Vec3 turned(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
    Vec3 moved(const Vec3& v) const { return turned(v) + shift; }
};

}  // namespace culet
