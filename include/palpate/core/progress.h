// One callback for the progress of long work and for its cancellation.
#pragma once

#include <functional>

namespace palpate {

// Called from time to time from the working thread with the fraction done, 0..1 (best estimate).
// Return false to cancel the work: it soon throws Cancelled and leaves no incomplete results.
using Progress = std::function<bool(double fraction)>;

}  // namespace palpate
