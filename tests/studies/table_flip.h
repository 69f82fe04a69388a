#pragma once
// The pavilion angle at which the reflection of a brilliant's table in ASET changes its colour.

namespace culet {

/// Found by bisection over round brilliants of index `n`, in degrees.
double table_flip_deg(double n);

/// Light straight down is reflected by two opposite mains and leaves the table under
/// n sin(180 - 4 p) to the vertical; ASET's red ends at 45 degrees.
double closed_form_table_flip_deg(double n);

}  // namespace culet
