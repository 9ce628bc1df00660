#include "palpate/signals/centre_rows.h"

#include <vector>

#include "palpate/model/active_taxels.h"
#include "palpate/model/matrix_rows.h"

namespace palpate {

std::optional<ForceCentre> forceCentre(const TactileFrame& frame, std::size_t matrix) {
  const MatrixLayout& layout = frame.layout->matrix(matrix);
  ForceCentre centre;
  std::size_t place = frame.layout->offset(matrix);
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x, ++place) {
      if (!isActive(frame, place)) continue;
      const auto value = static_cast<double>(frame.values[place]);
      centre.sum += value;
      centre.x += value * x;
      centre.y += value * y;
    }
  if (!(centre.sum > 0.0)) return std::nullopt;
  centre.x /= centre.sum;
  centre.y /= centre.sum;
  centre.xMm = centre.x * layout.pitchMm.x;
  centre.yMm = centre.y * layout.pitchMm.y;
  return centre;
}

std::unique_ptr<ResultTable> centreTable(const Profile& profile,
                                         std::optional<std::int64_t> matrix,
                                         const Progress& progress) {
  using Centre = ForceCentre;
  const std::vector<ColumnOf<Centre>> columns = {
      columnOf<Centre>("sum", profile.hand().unit, "sum of the touched taxels", &Centre::sum),
      columnOf<Centre>("x", "taxels", "column of the centre of force", &Centre::x),
      columnOf<Centre>("y", "taxels", "row of the centre of force", &Centre::y),
      columnOf<Centre>("x_mm", "mm", "the same on the unrolled surface", &Centre::xMm),
      columnOf<Centre>("y_mm", "mm", "the same on the unrolled surface", &Centre::yMm)};
  return std::make_unique<RowTable<MatrixRow<Centre>>>(
      "centres",
      matrixRowColumns(columns),
      [profile, matrix, progress, at = std::size_t{0}, frame = TactileFrame()](
          std::vector<MatrixRow<Centre>>& rows) mutable {
        if (at == profile.numFrames()) return false;
        reportProgress(progress, at, profile.numFrames());
        profile.readFrame(at, frame);
        for (std::size_t m = 0; m < profile.layout().numMatrices(); ++m)
          if (!matrix || *matrix == static_cast<std::int64_t>(m))
            if (const auto centre = forceCentre(frame, m))
              rows.push_back({at, frame.hostUs, m, *centre});
        ++at;
        return true;
      });
}

}  // namespace palpate
