// Progress of long work, and its cancelling: one callback for both.
#pragma once

#include <functional>

namespace palpate {

// Called now and then from the working thread with the fraction done, 0..1 (best known). Returning
// false asks the work to stop: it throws Cancelled soon and leaves nothing half-done.
using Progress = std::function<bool(double fraction)>;

}  // namespace palpate
