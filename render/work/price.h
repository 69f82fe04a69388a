#pragma once
// What a picture costs in processor time, from counts alone: the same scene is planned the same way
// on every machine. The unit is the nanosecond of the machine of docs/plan.md; a pilot's clock says
// how this one differs.

namespace culet {

/// Work of the reference renderer.
struct PathWork {
    double rays = 0;    ///< eye rays x bands
    double events = 0;  ///< faces met
    bool general = false, polarised = true;
    int nodes = 1;  ///< wavelengths in a band
    /// Of a stone that is not convex: each way through it is held against all of them.
    double edges = 0;
    double met = 0;  ///< rays among objects, each with what it is answered
};
double price_ns(const PathWork& work);

/// Work of beams that were drawn.
struct DrawnBeams {
    long long grown = 0;      ///< isotropic or merged, of trees
    long long split = 0;      ///< of a crystal's two waves
    long long walked = 0;     ///< faces met by those that are followed alone
    long long fragments = 0;  ///< pixels under them, each wavelength's pass by itself
    long long faces = 0;      ///< met by fragments, up to eight of a beam at once
    int nodes = 1;            ///< wavelengths of a pass
};
double price_ns(const DrawnBeams& work);

/// Work of the beams, guessed beforehand.
struct BeamWork {
    double pixels = 0;  ///< of the stone
    double bands = 1;
    double events_per_ray = 1;  ///< of the reference's rays; split: of their trees
    double tolerance = 0.01;    ///< of the beams' settings
    double cut = 0;    ///< their cut_weight, one way through the stone; 0: as the tolerance
    double views = 1;  ///< points of the pupil
    bool polarised = true;
    bool split = false;  ///< a crystal's two waves, each its own way
    int nodes = 1;
};
double price_ns(const BeamWork& work);

}  // namespace culet
