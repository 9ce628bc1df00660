// Sizes of grasped objects as a result table. docs/manual/tables.md explains the columns.
#pragma once

#include <memory>
#include <vector>

#include <palpate/core/result_table.h>
#include <palpate/kinematics/object_size.h>
#include <palpate/recognition/grasp_segments.h>

namespace palpate {

struct GraspSize {
  GraspSegment grasp;
  ObjectSizeReport size;
};
// The table "sizes", a row for each grasp; its problems say which have no size.
std::unique_ptr<ResultTable> sizeTable(std::vector<GraspSize> rows);

}  // namespace palpate
