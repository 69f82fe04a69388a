#include "compare/refine/photograph_evidence.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/calibration/photo_blur.h"
#include "compare/calibration/photo_noise.h"
#include "compare/calibration/stone_samples.h"
#include "compare/photo/resampling.h"
#include "compare/refine/picture_changes.h"
#include "compare/refine/picture_equations.h"
#include "compare/refine/picture_misfit.h"
#include "compare/refine/set_up.h"
#include "compare/scores/aligned_pair.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_tolerance = 0.02;      // of the pictures that are held against the photograph
constexpr double k_least_noise = 0.003;   // of the root of light
constexpr double k_least_sharper = 0.25;  // the square of a blur goes no farther at once
constexpr double k_inside_blurs = 2;      // likewise, in blurs: the ground is another one
// How far a set-up goes in one step: found poses are 0.2 degrees off in the median.
constexpr double k_angle_spread = radians(0.5);
// Of a photograph's own: exposure, place, blur, set-up.
constexpr auto k_amounts = Eigen::Index(Nuisance::k_linear + k_set_up_angles);

}  // namespace

struct PhotographEvidence::Parts {
    Parts(const Photo& photo, const std::vector<float>& mask, const Scene& scene, int threads);

    cv::Mat inside(double blur) const;
    cv::Mat seen(double blur) const;
    Photo picture(const Solid& solid) const;
    void set_equations(const Solid& solid, const std::vector<double>& spread);

    Scene scene;    // the camera of the pictures
    Scene sampled;  // that of the samples
    int threads = 0;
    Vec3 middle{0};
    DraftRenderer renderer;
    CameraModel camera;
    cv::Mat photo_light, photo_mask;  // root of light, and where it may be used
    double photo_diameter = 0;
    cv::Matx33d close_up_from_sample, model_from_sample;
    Frame frame;
    double reduction = 1;
    cv::Mat outline_distance;

    SetUp set_up;
    cv::Matx33d moved = cv::Matx33d::eye();  // samples from where the photograph shows them
    // Of the last measurement.
    Solid measured;
    PictureChanges changes;
    PictureEquations equations;
    MovesTold told;
};

PhotographEvidence::Parts::Parts(const Photo& photo, const std::vector<float>& mask,
                                 const Scene& given, int n)
    : scene(given),
      sampled(sampled_scene(given)),
      threads(n),
      middle(centroid(given.stone.solid)),
      renderer(given, k_tolerance) {
    if (!is_convex(given.stone.solid)) throw InputError("only convex stones are refined");
    const auto first = renderer.sketch(sampled);
    if (!first) {
        throw InputError(
            "this scene is drawn by rays, whose noise hides what a facet's tilt changes: refine "
            "takes convex stones in scenes that beams draw (engine = \"beams\")");
    }
    AlignedPair pair = aligned(photo, mask, renderer.picture(), {});
    if (!pair.comparable()) {
        throw InputError("the stone's outline in the photograph is not that of the scene's stone");
    }
    camera = camera_of(photo, pair);
    frame = pair.frame;
    const MatchedPictures& pictures = pair.pictures;
    photo_light = root_light(pictures.photo, pictures.white);
    photo_mask = pictures.mask;
    photo_diameter = pictures.diameter;
    reduction = sample_reduction(scene);
    model_from_sample = model_from_samples(scene, sampled);
    close_up_from_sample = close_up_from_model(frame) * model_from_sample;
    cv::distanceTransform(inside_of(*first), outline_distance, cv::DIST_L2, cv::DIST_MASK_PRECISE,
                          CV_32F);
}

cv::Mat PhotographEvidence::Parts::inside(double blur) const {
    const double margin = std::max(k_inside, k_inside_blurs * blur) * k_samples_across;
    cv::Mat mask = outline_distance > margin;
    mask.setTo(
        0, resampled_mask(photo_mask, first_rows(close_up_from_sample * moved), mask.size()) == 0);
    return mask;
}

// The photograph's samples.
cv::Mat PhotographEvidence::Parts::seen(double blur) const {
    return resampled(softened(photo_light, blur * photo_diameter),
                     first_rows(close_up_from_sample * moved), outline_distance.size(),
                     Kernel::cubic, Beyond::nearest);
}

Photo PhotographEvidence::Parts::picture(const Solid& solid) const {
    return renderer.draw(set_up_scene(scene, solid, set_up, middle));
}

PhotographEvidence::PhotographEvidence(const Photo& photo, const std::vector<float>& mask,
                                       const Scene& scene, int threads)
    : parts_(std::make_unique<Parts>(photo, mask, scene, threads)) {}
PhotographEvidence::~PhotographEvidence() = default;
PhotographEvidence::PhotographEvidence(PhotographEvidence&&) noexcept = default;

// The equations around `solid`, from the changes of the last sketches.
void PhotographEvidence::Parts::set_equations(const Solid& solid,
                                              const std::vector<double>& spread) {
    PictureEquations& e = equations;
    const cv::Mat& mask = e.mask;
    const auto samples = Eigen::Index(changes.slopes.front().size()),
               moves = Eigen::Index(spread.size());
    const auto column = [&](const std::vector<double>& values) {
        return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
    };
    e.changes.resize(samples, moves);
    Eigen::VectorXd bent = Eigen::VectorXd::Zero(samples);
    for (Eigen::Index k = 0; k < moves; ++k) {
        e.changes.col(k) = column(changes.slopes[std::size_t(k)]);
        // A move of t changes what is not straight by bend (t / step)^2 / 2: the mean square of
        // that over a normal distribution is 3/4 bend^2 (spread / step)^4.
        const double share = 0.75 * std::pow(spread[std::size_t(k)] / k_move_step, 4);
        bent += share * column(changes.bends[std::size_t(k)]).cwiseAbs2();
    }
    e.bent = bent.cwiseSqrt();
    e.noise = (bent.array() + k_least_noise * k_least_noise).sqrt().matrix();
    e.spread = column(spread);

    const Photo drawn = picture(solid);
    const double fine_blur = e.blur / reduction;
    const cv::Mat fine = fine_picture(drawn, camera, camera.psf_px, fine_blur),
                  softer = fine_picture(drawn, camera, k_softer * camera.psf_px, fine_blur);
    const auto nuisances = nuisances_of(fine, softer, model_from_sample, mask.size());
    // The set-up tells where and how large the stone is as a whole: the planes are not asked.
    const auto whole = moves_of_the_whole(solid);
    e.nuisances.resize(samples, k_amounts + Eigen::Index(whole.size()));
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
        CameraModel reduced = p.camera;
        reduced.psf_px *= p.reduction;
        p.changes = picture_changes({p.renderer, p.sampled, solid, p.set_up, p.middle, reduced,
                                     p.outline_distance > 0, e.blur},
                                    e.mask, p.threads, progress);
    }
    p.set_equations(solid, spread);
    p.measured = solid;
    p.told = moves_told(e);

    PlaneEvidence evidence;
    evidence.moves_told = p.told.moves_told;
    for (Eigen::Index r = 0; r < p.told.rows.rows(); ++r) {
        PlaneEvidence::Row& row = evidence.rows.emplace_back();
        row.value = p.told.values[r];
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const auto k = Eigen::Index(k_moves_of_a_facet * f);
            row.facets.push_back(plane_slopes(facets[f], p.told.rows(r, k), p.told.rows(r, k + 1),
                                              p.told.rows(r, k + 2)));
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
        p.equations, p.told,
        Eigen::Map<const Eigen::VectorXd>(moves.data(), Eigen::Index(moves.size())), spread);
    for (double& gain : p.camera.gain) gain *= std::pow(1 + found[Nuisance::exposure], 2);
    // Blurs add in squares.
    p.camera.psf_px *= std::sqrt(
        std::max(k_least_sharper, 1 + (k_softer * k_softer - 1) * found[Nuisance::softer]));
    // The photograph is the picture moved by so much: it is looked at where that was moved from.
    const double around = -2 * k_moved_by_unit / k_samples_across;
    const double scale = around * found[Nuisance::larger], turn = around * found[Nuisance::turned];
    const double x = -k_moved_by_unit * found[Nuisance::right],
                 y = -k_moved_by_unit * found[Nuisance::down];
    const double mx = p.outline_distance.cols / 2.0, my = p.outline_distance.rows / 2.0;
    p.moved = p.moved * cv::Matx33d(1 + scale, -turn, x - scale * mx + turn * my, turn, 1 + scale,
                                    y - scale * my - turn * mx, 0, 0, 1);
    for (std::size_t k = 0; k < k_set_up_angles; ++k) {
        angle_of(p.set_up, k) += found[Eigen::Index(Nuisance::k_linear + k)];
    }
}

EvidenceFit PhotographEvidence::fit_of(const Solid& solid) const {
    const Parts& p = *parts_;
    const Photo picture = p.picture(solid);
    const double fine_blur = k_sample_blur * k_samples_across / p.reduction;
    const cv::Mat fine = fine_picture(picture, p.camera, p.camera.psf_px, fine_blur);
    const cv::Mat mask = p.inside(k_sample_blur);
    const cv::Mat difference =
        p.seen(k_sample_blur) - resampled(fine, first_rows(p.model_from_sample), mask.size(),
                                          Kernel::cubic, Beyond::nearest);
    EvidenceFit fit = picture_misfit(difference, mask);
    const Scene posed = set_up_scene(p.sampled, solid, p.set_up, p.middle);
    const cv::Matx33d photo_from_sample =
        squared(matrix_of(p.frame.render_from_photo)).inv() * p.model_from_sample * p.moved;
    for (Contradiction& one : fit.contradictions) {
        one.facet = facet_seen_at(posed, one.x + 0.5, one.y + 0.5);
        const cv::Vec3d at = photo_from_sample * cv::Vec3d(one.x, one.y, 1);
        one.x = at[0];
        one.y = at[1];
    }
    return fit;
}

}  // namespace culet
