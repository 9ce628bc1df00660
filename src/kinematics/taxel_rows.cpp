#include "palpate/kinematics/taxel_rows.h"

#include <string>
#include <utility>

namespace palpate {

std::vector<PlacedTaxel> taxelPlaces(const HandPose& pose,
                                    const SensorLayout& layout,
                                    std::optional<std::size_t> matrix) {
  std::vector<PlacedTaxel> places;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m)
    for (int y = 0; y < layout.matrix(m).rows && matrix.value_or(m) == m; ++y)
      for (int x = 0; x < layout.matrix(m).columns; ++x)
        places.push_back({m,
                          static_cast<double>(x),
                          static_cast<double>(y),
                          pose.positionMm(m, y, x),
                          pose.normal(m, y, x),
                          layout.matrix(m).exists(y, x)});
  return places;
}

std::unique_ptr<ResultTable> taxelTable(std::vector<PlacedTaxel> places) {
  using Place = PlacedTaxel;
  std::vector<ColumnOf<Place>> columns = {
      columnOf<Place>("matrix", "", "number of the matrix, from 0", &Place::matrix),
      columnOf<Place>("x", "taxels", "column of the taxel, from 0", &Place::x),
      columnOf<Place>("y", "taxels", "row of the taxel, from 0 at the fingertip", &Place::y)};
  constexpr const char* kAxes[] = {"x", "y", "z"};
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    columns.push_back(columnOf<Place>(std::string(kAxes[axis]) + "_mm",
                                      "mm",
                                      "centre of the taxel, in the hand's base frame",
                                      [axis](const Place& row) { return row.positionMm[axis]; }));
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    columns.push_back(columnOf<Place>(std::string("n") + kAxes[axis],
                                      "",
                                      "outward normal there, a unit vector",
                                      [axis](const Place& row) { return row.normal[axis]; }));
  columns.push_back(columnOf<Place>("exists", "", "whether there is a taxel", &Place::exists));
  return std::make_unique<RowTable<Place>>("kinematics", std::move(columns), std::move(places));
}

}  // namespace palpate
