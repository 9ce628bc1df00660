// Computes pressures and forces of any single frame of a recording, with the same result as a force
// series (force_series.h) but without a pass over the whole recording. Consecutive frames take
// microseconds. After a jump, the half minute before the frame is processed first, because creep
// depends on how long a contact has lasted. The window uses it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/pressure_map.h>
#include <palpate/calibration/tare.h>
#include <palpate/model/profile.h>

namespace palpate {

// Reads frames of one recording and computes their pressures.
class PressureReader {
 public:
  // Throws Error (the recording has filtered values, not counts), std::invalid_argument (a
  // calibration without P(K, T); settings or tare of another hand).
  PressureReader(Profile profile,
                 const Calibration& calibration,
                 PressureMapOptions options = {},
                 std::optional<Tare> tare = std::nullopt);

  // Throws std::out_of_range, and Error when the frame cannot be read. The result is valid until
  // the next call.
  const PressureFrame& at(std::size_t frame);
  std::vector<std::string> assumptions() const { return map_.assumptions(); }

 private:
  void go(std::size_t frame);

  Profile profile_;
  PressureMap map_;
  std::optional<Tare> tare_;
  std::optional<std::size_t> now_;  // the frame that `pressures_` belongs to
  TactileFrame frame_;
  PressureFrame pressures_;
  std::optional<std::size_t> sample_;  // the current sample of temperatures
  std::vector<double> degC_;
};

}  // namespace palpate
