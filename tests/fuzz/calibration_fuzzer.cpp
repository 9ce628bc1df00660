// Fuzzes calibrations, noise floors, and the tables that calibrations are made from: what is taken
// reads back as it was written.
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "palpate/calibration/calibration.h"
#include "palpate/calibration/noise_floor.h"
#include "palpate/calibration/pressure_table.h"
#include "palpate/core/error.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

template <typename From>
void readAndWrite(const std::string& text, From from) {
  try {
    const std::string written = jsonOf(from(Json::parse(text))).text(-1);
    require(jsonOf(from(Json::parse(written))).text(-1) == written);
  } catch (const Error&) {
  } catch (const std::invalid_argument&) {
    // A field that is out of range; loadCalibration() names the file.
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  readAndWrite(text, [](const Json& json) { return calibrationFrom(json); });
  readAndWrite(text, [](const Json& json) { return noiseFloorFrom(json); });
  try {
    for (const PressureTableRow& row : parsePressureTable(text, "table.csv"))
      require(row.line > 1 && row.line <= size + 1);
  } catch (const Error&) {
  }
  return 0;
}
