// Counts heap allocations. Tests use it to check that a function allocates nothing.
#pragma once

namespace palpate::testing {

// Starts counting at 0.
void countAllocations();
// Returns the number of allocations since the start and stops counting.
int allocationsCounted();

}  // namespace palpate::testing
