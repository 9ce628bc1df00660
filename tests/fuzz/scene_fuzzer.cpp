// Fuzzes scenes: what is taken has a script in order of time.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "palpate/core/error.h"
#include "palpate/emulator/scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const palpate::Scene scene =
        palpate::parseScene({reinterpret_cast<const char*>(data), size}, "scene.json");
    double last = 0.0;
    for (const palpate::ScriptStep& step : scene.script) {
      if (!std::isfinite(step.atS) || step.atS < last) std::abort();
      last = step.atS;
    }
  } catch (const palpate::Error&) {
  }
  return 0;
}
