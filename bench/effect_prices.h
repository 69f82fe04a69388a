#pragma once
// What each effect of the plan costs, on and off, by either engine.

namespace culet {

/// Prints a table: processor time of one picture of `pixels` a side, one thread, the quickest of
/// several, each pair in turn.
void print_effect_prices(int pixels);

}  // namespace culet
