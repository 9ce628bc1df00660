#include "gui/slip/slip_tables.h"

#include <cmath>

#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

namespace palpate::gui {
namespace {

// Writes the value with the precision of a float.
std::string slipTablesText(float value) { return numberText(value); }
std::string slipTablesFlag(bool value) { return value ? "1" : "0"; }

std::string timeMs(const SlipSeries& series, std::size_t frame) {
  return std::to_string(series.firstUs / kUsPerMs + std::llround(series.timeS[frame] * kMsPerS));
}

struct Place {
  std::uint32_t frame;
  std::uint16_t matrix;
  std::uint32_t index;
};

// Ordered by frame, then by matrix.
std::vector<Place> slipTablesPlacesOf(const SlipSeries& series) {
  std::vector<Place> places;
  std::vector<std::size_t> next(series.matrices.size(), 0);
  for (std::size_t frame = 0; frame < series.timeS.size(); ++frame)
    for (std::size_t m = 0; m < next.size(); ++m) {
      const auto& samples = series.matrices[m];
      if (next[m] >= samples.size() || samples[next[m]].frame != frame) continue;
      places.push_back({static_cast<std::uint32_t>(frame),
                        static_cast<std::uint16_t>(m),
                        static_cast<std::uint32_t>(next[m]++)});
    }
  return places;
}

}  // namespace

TextTable slipTable(const std::shared_ptr<const SlipSeries>& series) {
  auto places = std::make_shared<const std::vector<Place>>(slipTablesPlacesOf(*series));
  return {.header = {"frame",
                     "time_ms",
                     "matrix",
                     "active",
                     "valid",
                     "dx",
                     "dy",
                     "ref_dx",
                     "ref_dy",
                     "rotation_valid",
                     "rotation_deg",
                     "ref_rotation_deg",
                     "orientation_deg",
                     "eccentricity",
                     "roundness",
                     "residual",
                     "confidence",
                     "p_moved",
                     "state",
                     "slipping"},
          .numRows = places->size(),
          .row = [series, places](std::size_t row) {
            const Place& place = (*places)[row];
            const SlipSample& sample = series->matrices[place.matrix][place.index];
            const auto known = [](bool is, float value) {
              return is ? slipTablesText(value) : std::string();
            };
            return std::vector<std::string>{
                std::to_string(place.frame),
                timeMs(*series, place.frame),
                std::to_string(place.matrix),
                std::to_string(sample.active),
                slipTablesFlag(sample.valid),
                known(sample.valid, sample.dx),
                known(sample.valid, sample.dy),
                known(sample.valid && sample.refValid, sample.refDx),
                known(sample.valid && sample.refValid, sample.refDy),
                slipTablesFlag(sample.rotationValid),
                known(sample.rotationValid, sample.rotationDeg),
                known(sample.rotationValid && sample.refRotationValid, sample.refRotationDeg),
                slipTablesText(sample.orientationDeg),
                slipTablesText(sample.eccentricity),
                slipTablesText(sample.roundness),
                slipTablesText(sample.residual),
                slipTablesText(sample.confidence),
                known(sample.pMoved >= 0.0F, sample.pMoved),
                std::string(nameOf(sample.state)),
                slipTablesFlag(sample.slipping)};
          }};
}

TextTable slipSegmentTable(const std::shared_ptr<const SlipSeries>& series) {
  return {.header = {"begin",
                     "end",
                     "begin_ms",
                     "end_ms",
                     "matrix",
                     "path_taxels",
                     "rotation_deg",
                     "confidence"},
          .numRows = series->slips.size(),
          .row = [series](std::size_t row) {
            const SlipSegment& slip = series->slips[row];
            return std::vector<std::string>{std::to_string(slip.begin),
                                            std::to_string(slip.end),
                                            timeMs(*series, slip.begin),
                                            timeMs(*series, slip.end),
                                            std::to_string(slip.matrix),
                                            numberText(slip.pathTaxels),
                                            numberText(slip.rotationDeg),
                                            numberText(slip.confidence)};
          }};
}

}  // namespace palpate::gui
