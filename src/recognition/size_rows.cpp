#include "palpate/recognition/size_rows.h"

#include <optional>
#include <string>
#include <utility>

#include "palpate/core/number_text.h"

namespace palpate {
namespace {

std::vector<ColumnOf<GraspSize>> sizeColumns() {
  using Row = GraspSize;
  const auto frame = [](const char* name, const char* meaning, auto of) {
    return columnOf<Row>(name, "", meaning, [of](const Row& row) {
      return row.size.valid ? std::optional(of(row.size)) : std::nullopt;
    });
  };
  const auto length = [](const char* name, const char* meaning, double ObjectSizeReport::*of) {
    return columnOf<Row>(name, "mm", meaning, [of](const Row& row) {
      return row.size.valid ? std::optional(row.size.*of) : std::nullopt;
    });
  };
  using Size = const ObjectSizeReport&;
  return {
      columnOf<Row>("begin", "", "first frame", [](const Row& row) { return row.grasp.begin; }),
      columnOf<Row>("end", "", "last frame", [](const Row& row) { return row.grasp.end; }),
      frame("matrix_a", "one pad", [](Size size) { return size.pads.first; }),
      frame("matrix_b", "the other pad", [](Size size) { return size.pads.second; }),
      frame("start_frame", "first contact of both", [](Size size) { return size.startFrame; }),
      frame("plateau_frame", "start of the plateau", [](Size size) { return size.plateauFrame; }),
      length("start_mm", "distance at first contact", &ObjectSizeReport::startMm),
      length("plateau_mm", "distance on the plateau", &ObjectSizeReport::plateauMm),
      length("shrink_mm", "difference of both", &ObjectSizeReport::shrinkMm),
      length("foam_mm", "part of the foam in it", &ObjectSizeReport::foamMm),
      length("compression_mm", "part of the object", &ObjectSizeReport::compressionMm),
      length("compression_sd_mm", "its standard deviation", &ObjectSizeReport::compressionSdMm),
      length("diameter_mm", "diameter of the object", &ObjectSizeReport::diameterMm),
      length("diameter_sd_mm", "its standard deviation", &ObjectSizeReport::diameterSdMm),
      length("sphere_mm",
             "diameter of the sphere around the touched taxels, on the plateau",
             &ObjectSizeReport::spherePlateauMm)};
}

class SizeTable final : public RowTable<GraspSize> {
 public:
  explicit SizeTable(std::vector<GraspSize> rows)
      : RowTable("sizes", sizeColumns(), rows), rows_(std::move(rows)) {}
  std::vector<std::string> problems() const override {
    std::vector<std::string> lines;
    for (const auto& [grasp, size] : rows_) {
      const std::string which =
          "grasp " + std::to_string(grasp.begin) + ".." + std::to_string(grasp.end) + ": ";
      if (size.unusableFrames > 0)
        lines.push_back(which + counted(size.unusableFrames, "frame") +
                        " without usable joint angles left out");
      if (!size.valid) lines.push_back(which + "no size: " + size.problem);
    }
    return lines;
  }

 private:
  std::vector<GraspSize> rows_;
};

}  // namespace

std::unique_ptr<ResultTable> sizeTable(std::vector<GraspSize> rows) {
  return std::make_unique<SizeTable>(std::move(rows));
}

}  // namespace palpate
