#pragma once
// Estimates the moves behind the difference of two pictures: weighted least squares, with
// correlated noise estimated from the pictures.

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace culet {

/// `difference` = `changes` * moves + `nuisances` * amounts + noise, one row for each sample.
struct PictureEquations {
    cv::Mat mask;  ///< CV_8U: where the samples are, row by row
    Eigen::MatrixXd changes, nuisances;
    Eigen::VectorXd difference;
    Eigen::VectorXd noise;         ///< of each sample; only the ratios count
    Eigen::VectorXd nonlinearity;  ///< part of it: the expected non-linear effect of the moves
    Eigen::VectorXd spread;        ///< prior standard deviation of each move
    double blur = 1;               ///< of the pictures, standard deviation in samples
};

/// rows * moves = values, each row with sigma 1, independent of the others and of the nuisances.
struct DeterminedMoves {
    Eigen::MatrixXd rows;
    Eigen::VectorXd values;
    Eigen::VectorXd weights;           ///< of the samples: 1, less for outliers (Huber 1964)
    double noise = 0;                  ///< of a sample, in units of its own `noise`
    double independent = 0;            ///< effective number of independent samples
    double parameters_determined = 0;  ///< number of moves that the picture determines
};

/// Estimates the sums' covariance from products of nearby residuals (Newey and West 1987, in the
/// plane: Conley 1999), because noise is as smooth as the blur, and model errors are largest where
/// moves change most. Adds the expected non-linearity, which the moves partly absorb and residuals
/// do not show. The nuisances have no prior.
DeterminedMoves solved_moves(const PictureEquations& equations);

/// The amounts of the first `spread.size()` nuisances that fit these moves best, without the
/// others. `spread`: prior sigma about 0; 0: free.
Eigen::VectorXd nuisances_beside(const PictureEquations& equations,
                                 const DeterminedMoves& determined, const Eigen::VectorXd& moves,
                                 const Eigen::VectorXd& spread);

}  // namespace culet
