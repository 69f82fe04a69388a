#pragma once
// What each effect of the plan costs, in either engine.

namespace culet {

/// Prints processor times of a picture of `pixels` a side, one thread, the quickest of several,
/// with each effect on and off in turn.
void print_effect_prices(int pixels);

}  // namespace culet
