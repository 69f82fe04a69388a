#pragma once
// Price of a picture in processor time, from counts alone, so that plans are alike on every
// machine. Unit: a nanosecond of the machine of docs/plan.md; the pilot's clock gives this
// machine's factor.

namespace culet {

/// Work of the reference renderer.
struct PathWork {
    double rays = 0;    ///< eye rays x bands
    double events = 0;  ///< faces met
    bool general = false, polarised = true;
    int nodes = 1;  ///< wavelengths in a band
    /// Edges of a stone that is not convex: every segment is tested against all of them.
    double edges = 0;
    double met = 0;  ///< rays among objects, including the shading of what they meet
};
double price_ns(const PathWork& work);

/// Work of beams that have been drawn.
struct DrawnBeams {
    long long grown = 0;      ///< isotropic or merged beams grown
    long long split = 0;      ///< beams of a crystal's two waves
    long long walked = 0;     ///< faces met by beams that follow their middle ray alone
    long long fragments = 0;  ///< pixels covered, counted once per pass
    long long faces = 0;      ///< met by fragments; up to eight of a beam count once
    int nodes = 1;            ///< wavelengths per pass
};
double price_ns(const DrawnBeams& work);

/// Estimated work of beams, before drawing.
struct BeamWork {
    double pixels = 0;  ///< of the stone
    double bands = 1;
    double events_per_ray = 1;  ///< of the reference's rays; if split, of their trees
    double tolerance = 0.01;    ///< of the beams' settings
    double cut = 0;             ///< the beams' cut_weight; 0: as the tolerance
    double views = 1;           ///< points of the pupil
    bool polarised = true;
    bool split = false;  ///< a crystal's two waves are followed separately
    int nodes = 1;
};
double price_ns(const BeamWork& work);

}  // namespace culet
