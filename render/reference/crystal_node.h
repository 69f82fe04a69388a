#pragma once
// One step of the tree of crystal_paths.h: what a facet makes of one or two waves.
//
// Inside the stone a node is one mode, or both modes of one K while they are coherent. Two modes
// that leave a face together meet the next one at points x0, x1 with retardation G = (N1 - N0).x.
// Beyond the coherence length of the band's light they become two nodes, each followed exactly.
// Below it they stay one node: their coherency gets the phase 2 pi G / wavelength and the factor
// sinc^2(pi G / coherence length), the mean over a triangular band, which reaches 0 where they
// split. The node continues from the power-weighted means of their points and of their K: exact if
// the two K are equal (isotropic stones, plates with parallel faces), otherwise off by the order of
// the birefringence.

#include <array>

#include "render/geometry/stone_body.h"
#include "render/optics/eye_coherency.h"
#include "render/optics/path.h"

namespace culet {

struct CrystalNode {
    bool inside = true;
    Vec3 at{0, 0, 0};
    int facet = -1;                                   ///< where it starts
    std::array<CrystalMode, 2> modes;                 ///< inside
    Vec3 direction{0, 0, 0}, u{0, 0, 0}, v{0, 0, 0};  ///< outside: the ray and its two vibrations
    BodyHit again;                                    ///< outside: its next hit of the stone
    EyeCoherency c;                                   ///< of the two modes or vibrations
    NodeWeights tau{};                                ///< transmission at each wavelength
    int event = 0;                                    ///< number of the hit that ends it

    double power() const { return c.power(); }
};

/// Splits a node at a facet: `inner` continues inside the stone, `outer` outside. Both start at
/// inner.facet, and their powers sum to the arriving power less absorption.
class CrystalSteps {
public:
    /// Keeps references.
    CrystalSteps(const StoneBody& body, const Band& band) : body_(body), band_(band) {}

    /// From outside, at node.at on `facet`.
    void meet_from_outside(const CrystalNode& node, int facet, CrystalNode& inner,
                           CrystalNode& outer);
    /// Mode m of a node inside, alone. `absorbed`: power lost on the way, per wavelength.
    void meet_alone(CrystalNode& node, int m, CrystalNode& inner, CrystalNode& outer,
                    NodeWeights& absorbed);
    /// Both modes as one. Returns false, without any change, if they are not coherent or meet
    /// different facets.
    bool meet_together(CrystalNode& node, CrystalNode& inner, CrystalNode& outer,
                       NodeWeights& absorbed);

    /// Largest |sum of powers - 1| at a face, which is then normalised.
    double worst_imbalance() const { return worst_imbalance_; }

private:
    void absorb_together(CrystalNode& node, const std::array<double, 2>& length,
                         NodeWeights& absorbed) const;
    double alpha(const CrystalMode& mode, int wavelength) const;

    const StoneBody& body_;
    const Band& band_;
    double worst_imbalance_ = 0;
};

}  // namespace culet
