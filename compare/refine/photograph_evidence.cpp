#include "compare/refine/photograph_evidence.h"

#include <cmath>
#include <opencv2/core.hpp>

#include "compare/calibration/photo_noise.h"
#include "compare/calibration/stone_samples.h"
#include "compare/refine/picture_changes.h"
#include "compare/refine/picture_equations.h"
#include "compare/refine/picture_misfit.h"
#include "compare/refine/set_up.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_tolerance = 0.02;      // of the pictures compared with the photograph
constexpr double k_least_noise = 0.003;   // of the root of light
constexpr double k_least_sharper = 0.25;  // lower limit of one step's factor on the squared blur
constexpr double k_inside_blurs = 2;      // from the outline, in blurs: the ground differs
// Prior sigma of the set-up's angles: found poses are 0.2 degrees off in the median.
constexpr double k_angle_spread = radians(0.5);
// Number of a photograph's own unknowns: exposure, place, blur, set-up.
constexpr auto k_amounts = Eigen::Index(Nuisance::k_linear + k_set_up_angles);

}  // namespace

struct PhotographEvidence::Parts {
    Parts(const Photo& photo, const Scene& scene, int threads);

    cv::Mat inside(double blur) const;
    cv::Mat seen(double blur) const;
    Photo picture(const Solid& solid) const;
    void set_equations(const Solid& solid, const std::vector<double>& spread);

    Scene scene;  // with the pictures' camera
    int threads = 0;
    Vec3 middle{0};
    DraftRenderer renderer;
    StoneSamples samples;
    CameraModel camera;
    SampledPhoto photo;
    Similarity model_from_photo;

    SetUp set_up;
    cv::Matx33d moved = cv::Matx33d::eye();  // displacement of the samples in the photograph
    // Of the last measurement.
    Solid measured;
    PictureChanges changes;
    PictureEquations equations;
    DeterminedMoves determined;
};

PhotographEvidence::Parts::Parts(const Photo& taken, const Scene& given, int n)
    : scene(given), threads(n), middle(centroid(given.stone.solid)), renderer(given, k_tolerance) {
    if (!is_convex(given.stone.solid)) throw InputError("only convex stones are refined");
    samples = StoneSamples(given, renderer);
    if (!samples.sketch) {
        throw InputError(
            "this scene is drawn by rays, whose noise hides what a facet's tilt changes: refine "
            "takes convex stones in scenes that beams draw (engine = \"beams\")");
    }
    const AlignedPair pair = aligned(taken, renderer.picture());
    if (!pair.comparable()) {
        throw InputError("the stone's outline in the photograph is not that of the scene's stone");
    }
    camera = camera_of(taken, pair);
    photo = SampledPhoto(pair, samples);
    model_from_photo = pair.frame.render_from_photo;
}

cv::Mat PhotographEvidence::Parts::inside(double blur) const {
    const double margin = std::max(k_inside, k_inside_blurs * blur) * k_samples_across;
    cv::Mat mask = samples.outline_distance > margin;
    photo.keep_usable(mask, moved);
    return mask;
}

// The photograph at the samples.
cv::Mat PhotographEvidence::Parts::seen(double blur) const {
    return photo.at_samples(samples.size(), blur, moved);
}

Photo PhotographEvidence::Parts::picture(const Solid& solid) const {
    return renderer.draw(set_up_scene(scene, solid, set_up, middle));
}

PhotographEvidence::PhotographEvidence(const Photo& photo, const Scene& scene, int threads)
    : parts_(std::make_unique<Parts>(photo, scene, threads)) {}
PhotographEvidence::~PhotographEvidence() = default;
PhotographEvidence::PhotographEvidence(PhotographEvidence&&) noexcept = default;

void PhotographEvidence::Parts::set_equations(const Solid& solid,
                                              const std::vector<double>& spread) {
    PictureEquations& e = equations;
    const cv::Mat& mask = e.mask;
    const auto rows = Eigen::Index(changes.slopes.front().size()),
               moves = Eigen::Index(spread.size());
    const auto column = [&](const std::vector<double>& values) {
        return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
    };
    e.changes.resize(rows, moves);
    Eigen::VectorXd nonlinearity = Eigen::VectorXd::Zero(rows);
    for (Eigen::Index k = 0; k < moves; ++k) {
        e.changes.col(k) = column(changes.slopes[std::size_t(k)]);
        // A move t has the non-linear effect c (t / step)^2 / 2. Its mean square over a normal
        // distribution is 3/4 c^2 (spread / step)^4.
        const double share = 0.75 * std::pow(spread[std::size_t(k)] / k_move_step, 4);
        nonlinearity += share * column(changes.second_differences[std::size_t(k)]).cwiseAbs2();
    }
    e.nonlinearity = nonlinearity.cwiseSqrt();
    e.noise = (nonlinearity.array() + k_least_noise * k_least_noise).sqrt().matrix();
    e.spread = column(spread);

    const Photo drawn = picture(solid);
    const cv::Mat fine = samples.fine_picture(drawn, camera, camera.psf_px, e.blur),
                  softer = samples.fine_picture(drawn, camera, k_softer * camera.psf_px, e.blur);
    const auto nuisances = nuisances_of(fine, softer, samples);
    // The set-up, not the planes, determines the stone's place and size as a whole.
    const auto whole = moves_of_the_whole(solid);
    e.nuisances.resize(rows, k_amounts + Eigen::Index(whole.size()));
    for (std::size_t k = 0; k < std::size_t(k_amounts); ++k) {
        e.nuisances.col(Eigen::Index(k)) =
            k < Nuisance::k_linear
                ? Eigen::VectorXd(column(samples_of(nuisances[k], mask)))
                : Eigen::VectorXd(
                      column(changes.slopes[std::size_t(moves) + k - Nuisance::k_linear]));
    }
    for (std::size_t k = 0; k < whole.size(); ++k) {
        e.nuisances.col(k_amounts + Eigen::Index(k)) = e.changes * column(whole[k]);
    }
    const double blur = e.blur / k_samples_across;
    e.difference = column(samples_of(seen(blur) - nuisances[Nuisance::exposure], mask));
}

PlaneEvidence PhotographEvidence::measure(const Solid& solid, const std::vector<double>& spread,
                                          double blur, bool sketch_anew, const Progress& progress) {
    Parts& p = *parts_;
    PictureEquations& e = p.equations;
    const std::vector<FacetMoves> facets = moves_of(solid);
    if (sketch_anew || p.changes.slopes.size() != spread.size() + k_set_up_angles) {
        e.mask = p.inside(blur);
        e.blur = blur * k_samples_across;
        if (cv::countNonZero(e.mask) < AlignedPair::k_least_pixels) {
            throw InputError("too little of the stone is seen to tell its facets from");
        }
        p.changes =
            picture_changes({p.renderer, p.samples, solid, p.set_up, p.middle, p.camera, e.blur},
                            e.mask, p.threads, progress);
    }
    p.set_equations(solid, spread);
    p.measured = solid;
    p.determined = solved_moves(e);

    PlaneEvidence evidence;
    evidence.parameters_determined = p.determined.parameters_determined;
    for (Eigen::Index r = 0; r < p.determined.rows.rows(); ++r) {
        PlaneEvidence::Row& row = evidence.rows.emplace_back();
        row.value = p.determined.values[r];
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const auto k = Eigen::Index(k_moves_of_a_facet * f);
            row.facets.push_back(plane_slopes(facets[f], p.determined.rows(r, k),
                                              p.determined.rows(r, k + 1),
                                              p.determined.rows(r, k + 2)));
        }
    }
    return evidence;
}

void PhotographEvidence::settle(const Solid& solid) {
    Parts& p = *parts_;
    const std::vector<double> moves = moves_between(p.measured, solid);
    Eigen::VectorXd spread = Eigen::VectorXd::Zero(k_amounts);
    spread.tail(k_set_up_angles).setConstant(k_angle_spread);
    const Eigen::VectorXd found = nuisances_beside(
        p.equations, p.determined,
        Eigen::Map<const Eigen::VectorXd>(moves.data(), Eigen::Index(moves.size())), spread);
    for (double& gain : p.camera.gain) gain *= std::pow(1 + found[Nuisance::exposure], 2);
    // Blurs add in squares.
    p.camera.psf_px *= std::sqrt(
        std::max(k_least_sharper, 1 + (k_softer * k_softer - 1) * found[Nuisance::softer]));
    // The samples move opposite to the picture.
    const double around = -2 * k_moved_by_unit / k_samples_across;
    const double scale = around * found[Nuisance::larger], turn = around * found[Nuisance::turned];
    const double x = -k_moved_by_unit * found[Nuisance::right],
                 y = -k_moved_by_unit * found[Nuisance::down];
    const double mx = p.samples.size().width / 2.0, my = p.samples.size().height / 2.0;
    p.moved = p.moved * cv::Matx33d(1 + scale, -turn, x - scale * mx + turn * my, turn, 1 + scale,
                                    y - scale * my - turn * mx, 0, 0, 1);
    for (std::size_t k = 0; k < k_set_up_angles; ++k) {
        angle_of(p.set_up, k) += found[Eigen::Index(Nuisance::k_linear + k)];
    }
}

EvidenceFit PhotographEvidence::fit_of(const Solid& solid) const {
    const Parts& p = *parts_;
    const Photo picture = p.picture(solid);
    const cv::Mat fine = p.samples.fine_picture(picture, p.camera, p.camera.psf_px,
                                                k_sample_blur * k_samples_across);
    const cv::Mat mask = p.inside(k_sample_blur);
    const cv::Mat difference = p.seen(k_sample_blur) - p.samples.at_samples(fine);
    EvidenceFit fit = picture_misfit(difference, mask);
    const Scene posed = set_up_scene(p.samples.scene, solid, p.set_up, p.middle);
    const cv::Matx33d photo_from_sample =
        squared(matrix_of(p.model_from_photo)).inv() * p.samples.model_from_sample * p.moved;
    for (Contradiction& one : fit.contradictions) {
        one.facet = facet_seen_at(posed, one.x + 0.5, one.y + 0.5);
        const cv::Vec3d at = photo_from_sample * cv::Vec3d(one.x, one.y, 1);
        one.x = at[0];
        one.y = at[1];
    }
    return fit;
}

}  // namespace culet
