#pragma once
// Compares render/optics/crystal.h with the oracle, one face problem after the other.
//
// A deviation passes when it is below the tolerance, or below the effect of the input's rounding on
// the true answer (backward stability). The oracle's answers move by `sensitivity` when K and the
// crystal's orientation move by one unit in the last place, 2^-52, in six fixed random ways; the
// double computation, some ten roundings long, may be off by eight times that. The second rule
// matters only next to a critical angle (where powers go as the square root of the distance), at
// grazing incidence, and at optic axes (where the fields turn through a finite angle at a point).
// How often it was needed is recorded.
//
// Where two waves have the same N to a double's last digits, any pair of fields is valid: the
// answers are then compared as fields (the oracle's amplitudes rotated into culet's pair) and as
// sums of powers.

#include <string>
#include <vector>

#include "tests/render/face_oracle.h"

namespace culet {

class FaceJudge {
public:
    explicit FaceJudge(double tolerance = 1e-12) : tolerance_(tolerance) {}
    /// Records its figures as properties of the running test.
    ~FaceJudge();
    FaceJudge(const FaceJudge&) = delete;
    FaceJudge& operator=(const FaceJudge&) = delete;

    /// Compares light from outside, where |K| <= n_outside, and each wave from inside, with normal,
    /// K and the waves' normals and rays.
    void compare(const oracle::Face& face);

    int faces() const { return faces_; }
    int excused() const { return excused_; }

    struct Worst {
        double amplitude = 0, power = 0, wave = 0, ray = 0, imbalance = 0;
        /// The largest change of the oracle's answers by rounding of the input, computed only for
        /// deviations beyond the tolerance.
        double sensitivity = 0;
    };
    Worst worst() const { return {amplitude_, power_, wave_, ray_, imbalance_, sensitivity_}; }

private:
    struct Column;
    void judge(const oracle::Face& face, const Column& column);

    double tolerance_;
    std::vector<oracle::Answer> nudged_;  ///< of the current face, if needed
    int faces_ = 0, columns_ = 0, excused_ = 0;
    double amplitude_ = 0, power_ = 0, wave_ = 0, ray_ = 0, imbalance_ = 0, of_tolerance_ = 0,
           sensitivity_ = 0;
};

std::string described(const oracle::Face& face);

}  // namespace culet
