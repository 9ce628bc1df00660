#include "palpate/recording/frame_table.h"

#include <vector>

#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

namespace palpate {

TextTable taxelTable(const TactileFrame& frame, const std::string& index) {
  struct Place {
    std::size_t matrix;
    int y;
    int x;
    float value;
  };
  std::vector<Place> places;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const MatrixLayout& layout = frame.layout->matrix(m);
    const auto values = frame.matrix(m);
    for (int y = 0; y < layout.rows; ++y)
      for (int x = 0; x < layout.columns; ++x)
        if (layout.enabled(y, x)) places.push_back({m, y, x, values(y, x)});
  }
  const std::size_t numCells = places.size();
  return {.header = {"frame", "time_ms", "matrix", "y", "x", "value"},
          .numRows = numCells,
          .row = [places = std::move(places),
                  index,
                  timeMs = std::to_string(frame.hostUs / kUsPerMs)](std::size_t row) {
            const Place& place = places[row];
            return std::vector<std::string>{index,
                                            timeMs,
                                            std::to_string(place.matrix),
                                            std::to_string(place.y),
                                            std::to_string(place.x),
                                            numberText(place.value)};
          }};
}

}  // namespace palpate
