// Outline of a contact: the outer border of the largest group of active taxels, and how round it
// is. RotationTracker uses the roundness to decide whether a contact has a direction.
//
// Active taxels that share an edge or a corner belong to one group. The border runs through the
// centres of the outermost taxels of the group, so that its area is smaller than that of the
// taxels: a 2 x 2 block has area 1 and length 4.
#pragma once

#include <cstdint>
#include <vector>

#include <palpate/model/tactile_frame.h>

namespace palpate {

struct OutlineShape {
  // Number of groups of active taxels.
  int groups = 0;
  // Area [taxels^2] enclosed by the border of the largest group (the largest by area, then by
  // length).
  double area = 0.0;
  // Length of that border [taxels].
  double length = 0.0;
  // 4 pi area / length^2: 1 for a circle, 0 for a line or a single taxel.
  double roundness = 0.0;
};

// Describes the outline of the contact on one matrix. The buffers are allocated in the constructor;
// describe() allocates nothing.
class ContactOutline {
 public:
  // Throws std::invalid_argument when rows or columns are outside of 1..256.
  ContactOutline(int rows, int columns);

  // Describes the outline of the taxels whose value is greater than `above`. The matrix must have
  // the size given to the constructor.
  OutlineShape describe(const ConstMatrixMap& matrix, float above = 0.0F);
  // Describes the outline as the study's program did: taxels below 0.2 % of the maximum are ignored
  // (the program scaled to 8 bits), and the group that begins last in reading order is described,
  // whatever its size.
  OutlineShape describeLikeStudy(const ConstMatrixMap& matrix);

 private:
  int findGroups(const ConstMatrixMap& matrix, float above);
  OutlineShape borderOf(int start) const;
  std::uint16_t root(std::uint16_t label);

  int rows_ = 0;
  int columns_ = 0;
  int stride_ = 0;
  // Group label per taxel, with a border of one taxel around the matrix; 0: not active.
  std::vector<std::uint16_t> labels_;
  // Parent of each label (union-find).
  std::vector<std::uint16_t> parents_;
  // First taxel of each group in reading order.
  std::vector<int> starts_;
};

}  // namespace palpate
