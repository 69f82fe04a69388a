#pragma once
// ASET: where diamond-webgl divides the sky, and the pavilion angle at which the reflection of a
// brilliant's table changes its colour.

#include "render/grade/scope_shares.h"

namespace culet {

/// At heights of 0.70 and 0.98 on the unit sphere: 44.4 and 78.5 degrees of elevation.
ScopeBands diamond_webgl_bands();

/// Found by bisection over round brilliants of index `n`, in degrees.
double table_flip_deg(double n);

/// Light straight down is reflected by two opposite mains and leaves the table under
/// n sin(180 - 4 p) to the vertical; ASET's red ends at 45 degrees.
double closed_form_table_flip_deg(double n);

}  // namespace culet
