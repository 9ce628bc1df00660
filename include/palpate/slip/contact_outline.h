// The outline of a contact: the outer border of its largest group of active taxels, and how round
// it is.
//
// Taxels that touch by an edge or a corner are one group. The border runs through the centres of
// its outermost taxels, so that its area is smaller than theirs: a 2 x 2 block has area 1 and
// length 4.
#pragma once

#include <cstdint>
#include <vector>

#include <palpate/model/tactile_frame.h>

namespace palpate {

struct OutlineShape {
  int groups = 0;
  // enclosed by the border of the largest group (by area, then by length) [taxels^2]
  double area = 0.0;
  double length = 0.0;  // of that border [taxels]
  // 4 pi area / length^2: 1 for a circle, 0 for a line or a single taxel.
  double roundness = 0.0;
};

// Keeps its scratch: describe() allocates nothing.
class ContactOutline {
 public:
  // Throws std::invalid_argument for a size outside of 1..256.
  ContactOutline(int rows, int columns);

  // Of the size above; active is what is above `above`.
  OutlineShape describe(const ConstMatrixMap& matrix, float above = 0.0F);
  // As the study's program did: only taxels of 0.2 % of the maximum or more (its 8 bits), and of
  // the group that begins last in reading order, whatever its size.
  OutlineShape describeLikeStudy(const ConstMatrixMap& matrix);

 private:
  int findGroups(const ConstMatrixMap& matrix, float above);
  OutlineShape borderOf(int start) const;
  std::uint16_t root(std::uint16_t label);

  int rows_ = 0;
  int columns_ = 0;
  int stride_ = 0;
  std::vector<std::uint16_t> labels_;   // with one place around; 0: not active
  std::vector<std::uint16_t> parents_;  // of labels
  std::vector<int> starts_;             // of groups: their first place in reading order
};

}  // namespace palpate
