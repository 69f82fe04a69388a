#pragma once
// ASET: diamond-webgl's division of the sky, and the pavilion angle at which the reflection of a
// brilliant's table changes its colour.

#include "render/grade/scope_shares.h"

namespace culet {

/// At heights of 0.70 and 0.98 on the unit sphere, that is 44.4 and 78.5 degrees of elevation.
ScopeBands diamond_webgl_bands();

/// Bisects over round brilliants of index `n`; degrees.
double table_flip_deg(double n);

/// Two opposite mains reflect light that comes straight down; it leaves the table at n sin(180 - 4
/// p) to the vertical, and ASET's red ends at 45 degrees.
double closed_form_table_flip_deg(double n);

}  // namespace culet
