// Pressures and forces of any frame of a recording, without a pass over all of it: what a force
// series (force_series.h) has for this frame. Frame after frame takes microseconds; elsewhere the
// half minute in front of the frame is gone through first, because creep depends on how long a
// contact has lasted.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/pressure_map.h>
#include <palpate/calibration/tare.h>
#include <palpate/model/profile.h>

namespace palpate {

class PressureReader {
 public:
  // Throws Error (filtered values, not counts), std::invalid_argument (calibration without P(K, T);
  // settings or tare of another hand).
  PressureReader(Profile profile,
                 const Calibration& calibration,
                 PressureMapOptions options = {},
                 std::optional<Tare> tare = std::nullopt);

  // Throws std::out_of_range; Error where the frame can't be read. Holds until the next call.
  const PressureFrame& at(std::size_t frame);
  std::vector<std::string> assumptions() const { return map_.assumptions(); }

 private:
  void go(std::size_t frame);

  Profile profile_;
  PressureMap map_;
  std::optional<Tare> tare_;
  std::optional<std::size_t> now_;  // the frame that `pressures_` is of
  TactileFrame frame_;
  PressureFrame pressures_;
  std::optional<std::size_t> sample_;  // of temperatures
  std::vector<double> degC_;
};

}  // namespace palpate
