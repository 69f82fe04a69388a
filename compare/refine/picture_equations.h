#pragma once
// From the difference of two pictures to what it says of the moves that may have made it: weighted
// least squares whose noise is correlated between neighbours, by an amount that the pictures
// themselves show.

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace culet {

/// `difference` = `changes` * moves + `nuisances` * amounts + noise, a row a sample.
struct PictureEquations {
    cv::Mat mask;  ///< CV_8U: where the samples are, row by row
    Eigen::MatrixXd changes, nuisances;
    Eigen::VectorXd difference;
    Eigen::VectorXd noise;   ///< of each sample; only the ratios count
    Eigen::VectorXd bent;    ///< part of it: what of the changes is not straight, as it is expected
    Eigen::VectorXd spread;  ///< standard deviation of each move before the picture is looked at
    double blur = 1;         ///< of the pictures, standard deviation in samples
};

/// What a picture says: rows * moves = values, each row within 1 and independent of the others,
/// whatever the nuisances are.
struct MovesTold {
    Eigen::MatrixXd rows;
    Eigen::VectorXd values;
    Eigen::VectorXd weights;  ///< of the samples: 1, less for those far off (Huber 1964)
    double noise = 0;         ///< of a sample, in units of its own `noise`
    double independent = 0;   ///< as many independent samples would know as much
    double moves_told = 0;    ///< how many moves, of all, the picture tells
};

/// The covariance of the least-squares sums is estimated from products of the residuals near each
/// other (Newey and West 1987, in the plane: Conley 1999): noise is as smooth as the blur, and what
/// the pictures' models leave out is largest where moves change most. What is not straight is added
/// as it is expected: moves take up as much of it as they can, and residuals do not show that. The
/// nuisances' amounts are left open.
MovesTold moves_told(const PictureEquations& equations);

/// The amounts of the first `spread.size()` nuisances that suit these moves best, without the
/// others; each is held near 0 within its `spread` (0: it is free).
Eigen::VectorXd nuisances_beside(const PictureEquations& equations, const MovesTold& told,
                                 const Eigen::VectorXd& moves, const Eigen::VectorXd& spread);

}  // namespace culet
