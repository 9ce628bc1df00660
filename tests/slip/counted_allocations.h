// Counts what a test takes from the heap while it asks for it.
#pragma once

namespace palpate::testing {

void countAllocations();   // from now on, from 0
int allocationsCounted();  // since then; ends the counting

}  // namespace palpate::testing
