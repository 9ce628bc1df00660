#include "palpate/slip/contact_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace palpate {

ContactOutline::ContactOutline(int rows, int columns) : rows_(rows), columns_(columns) {
  if (rows < 1 || rows > 256 || columns < 1 || columns > 256)
    throw std::invalid_argument("ContactOutline: " + std::to_string(rows) + " x " +
                                std::to_string(columns) + " taxels");
  stride_ = columns + 2;
  const auto places = static_cast<std::size_t>(stride_ * (rows + 2));
  labels_.resize(places);
  // At most every second taxel of every second row begins a group of its own.
  const auto most = static_cast<std::size_t>(rows * columns / 2 + 2);
  parents_.resize(most);
  starts_.resize(most);
}

std::uint16_t ContactOutline::root(std::uint16_t label) {
  while (parents_[label] != label) label = parents_[label] = parents_[parents_[label]];
  return label;
}

// Labels the groups and returns the number of labels. A second pass would give all taxels of a
// group the same label; here each label refers to the root of its group, which is sufficient.
int ContactOutline::findGroups(const ConstMatrixMap& matrix, float above) {
  std::uint16_t next = 1;
  for (int y = 0; y < rows_; ++y) {
    const float* values = matrix.data() + y * columns_;
    std::uint16_t* labels = labels_.data() + (y + 1) * stride_ + 1;
    for (int x = 0; x < columns_; ++x) {
      if (!(values[x] > above)) {
        labels[x] = 0;
        continue;
      }
      const std::uint16_t* over = labels + x - stride_;
      // The taxel above is a neighbour of the other three; if it is not active, two groups may meet
      // here.
      std::uint16_t label = over[0];
      if (label == 0) {
        const std::uint16_t left = labels[x - 1] != 0 ? labels[x - 1] : over[-1];
        const std::uint16_t right = over[1];
        label = left != 0 ? left : right;
        if (left != 0 && right != 0 && left != right) {
          const std::uint16_t a = root(left);
          const std::uint16_t b = root(right);
          if (a != b) parents_[std::max(a, b)] = std::min(a, b);
        }
      }
      if (label == 0) {
        label = next++;
        parents_[label] = label;
        starts_[label] = (y + 1) * stride_ + x + 1;
      }
      labels[x] = label;
    }
  }
  return next - 1;
}

// Follows the border of the group (Moore-neighbour tracing): at each taxel it searches the
// neighbours in clockwise order, until it leaves the start in the same direction as at first.
OutlineShape ContactOutline::borderOf(int start) const {
  // Neighbours clockwise on the screen, starting on the right.
  const std::array<int, 8> offsets{
      1, stride_ + 1, stride_, stride_ - 1, -1, -stride_ - 1, -stride_, -stride_ + 1};
  constexpr std::array<int, 8> kX{1, 1, 0, -1, -1, -1, 0, 1};
  constexpr std::array<int, 8> kY{0, 1, 1, 1, 0, -1, -1, -1};
  OutlineShape shape;
  int straight = 0;
  int diagonal = 0;
  int twiceArea = 0;
  int place = start;
  int x = 0;
  int y = 0;
  // The first taxel in reading order has no neighbour to its left or above, so that the search
  // starts after its left neighbour.
  int direction = 5;
  int first = -1;
  const int most = 8 * rows_ * columns_;
  for (int steps = 0; steps < most; ++steps) {
    int found = -1;
    for (int i = 0; i < 8; ++i) {
      const int way = (direction + i) & 7;
      if (labels_[static_cast<std::size_t>(place + offsets[static_cast<std::size_t>(way)])] != 0) {
        found = way;
        break;
      }
    }
    // A single taxel has no border.
    if (found < 0) break;
    if (place == start && found == first) break;
    if (first < 0) first = found;
    const auto way = static_cast<std::size_t>(found);
    twiceArea += x * kY[way] - y * kX[way];
    (found % 2 == 0 ? straight : diagonal) += 1;
    x += kX[way];
    y += kY[way];
    place += offsets[way];
    // The search continues two directions back, at the first neighbour that was not visible from
    // the previous taxel.
    direction = (found + 6) & 7;
    if (found % 2 == 1) direction = (found + 5) & 7;
  }
  shape.area = 0.5 * std::abs(twiceArea);
  shape.length = straight + diagonal * std::numbers::sqrt2;
  if (shape.length > 0.0)
    shape.roundness = 4.0 * std::numbers::pi * shape.area / (shape.length * shape.length);
  return shape;
}

OutlineShape ContactOutline::describe(const ConstMatrixMap& matrix, float above) {
  const int labels = findGroups(matrix, above);
  OutlineShape largest;
  int groups = 0;
  for (int label = 1; label <= labels; ++label) {
    const auto group = static_cast<std::uint16_t>(label);
    if (parents_[group] != group) continue;
    ++groups;
    const OutlineShape shape = borderOf(starts_[group]);
    if (groups == 1 || shape.area > largest.area ||
        (shape.area == largest.area && shape.length > largest.length))
      largest = shape;
  }
  largest.groups = groups;
  return largest;
}

OutlineShape ContactOutline::describeLikeStudy(const ConstMatrixMap& matrix) {
  float most = 0.0F;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) most = std::max(most, matrix.data()[i]);
  // The study scaled to 255 and rounded: values from half a step up become 1.
  const int labels = findGroups(matrix, 0.5F / 255.0F * most);
  int groups = 0;
  int last = 0;
  for (int label = 1; label <= labels; ++label)
    if (parents_[static_cast<std::size_t>(label)] == label) {
      ++groups;
      last = label;
    }
  if (groups == 0) return {};
  OutlineShape shape = borderOf(starts_[static_cast<std::size_t>(last)]);
  shape.groups = groups;
  return shape;
}

}  // namespace palpate
