// The recording that exports are measured with: an hour of a synthetic SDH-2 in a .palpate.
#pragma once

#include <benchmark/benchmark.h>

#include "palpate/model/profile.h"

namespace palpate::benchmarks {

// Made once per process.
Profile hourOfFrames();
// Two bytes per taxel and frame, as the rate of a benchmark.
void setTaxelBytes(benchmark::State& state, const Profile& profile);

}  // namespace palpate::benchmarks
