#pragma once
// Tail probabilities for the tests of a fit.

namespace culet {

/// P(X > chi2) for chi-square with (possibly fractional) degrees of freedom; 1 for dof <= 0.
double chi2_tail(double chi2, double dof);

/// P(X < chi2); 1 for dof <= 0.
double chi2_lower_tail(double chi2, double dof);

/// The chi2 whose upper tail is `level`; 0 for dof <= 0.
double chi2_quantile(double level, double dof);

/// P(|T| > t) for Student's T.
double student_tail(double t, double dof);

/// The z with P(|Z| > z) = level for a standard normal Z.
double two_sided_normal_quantile(double level);

}  // namespace culet
