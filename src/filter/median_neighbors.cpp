#include "filter/median_neighbors.h"

#include <limits>

namespace palpate::detail {
namespace {

constexpr float kMedianNeighborsInfinity = std::numeric_limits<float>::infinity();
constexpr int kWindow = 3;

}  // namespace

MedianNeighbors::MedianNeighbors(const PaddedMatrix& padded, int depth) {
  const std::vector<float> on = padded.onPlane();
  const auto isOn = [&](int y, int x) {
    return on[static_cast<std::size_t>(padded.at(y, x))] > 0.0F;
  };
  struct Place {
    int y;
    int x;
  };
  std::vector<Place> places;
  for (int y = 0; y < padded.rows(); ++y) {
    for (int x = 0; x < padded.columns(); ++x) {
      if (!isOn(y, x)) continue;
      bool whole = true;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) whole = whole && isOn(y + dy, x + dx);
      if (!whole) places.push_back({y, x});
    }
  }
  for (const Place& place : places)
    taxels_.push_back(static_cast<std::size_t>(padded.at(place.y, place.x)));
  numPadded_ = (places.size() + kFour - 1) / kFour * kFour;
  gathered_.assign(numPadded_ * static_cast<std::size_t>(kWindow * kWindow * depth), 0.0F);
  for (std::size_t i = 0; i < places.size(); ++i) {
    bool low = true;
    std::size_t neighbor = 0;
    for (int plane = 0; plane < depth; ++plane) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx, ++neighbor) {
          const std::size_t to = neighbor * numPadded_ + i;
          if (isOn(places[i].y + dy, places[i].x + dx)) {
            copies_.push_back(
                {to,
                 static_cast<std::size_t>(padded.at(places[i].y + dy, places[i].x + dx)),
                 static_cast<std::size_t>(plane)});
          } else {
            gathered_[to] = low ? -kMedianNeighborsInfinity : kMedianNeighborsInfinity;
            low = !low;
          }
        }
      }
    }
  }
}

void MedianNeighbors::gather(std::span<const float* const> planes) {
  for (const Copy& copy : copies_) gathered_[copy.to] = planes[copy.plane][copy.from];
}

FourLanes MedianNeighbors::lanes(std::size_t index, std::size_t block) const {
  return loadFour(gathered_.data() + index * numPadded_ + block * kFour);
}

void MedianNeighbors::scatter(FourLanes results,
                              std::size_t block,
                              std::vector<float>& plane) const {
  for (std::size_t lane = 0; lane < kFour; ++lane) {
    const std::size_t taxel = block * kFour + lane;
    if (taxel < taxels_.size()) plane[taxels_[taxel]] = results[lane];
  }
}

}  // namespace palpate::detail
