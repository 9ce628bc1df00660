// Medians of a window in one frame and in several frames.
#include "filter/median_filters.h"

#include <algorithm>
#include <array>

#include "filter/median_neighbors.h"
#include "filter/median_networks.h"
#include "filter/padded_matrix.h"
#include "filter/spatial_filter.h"

namespace palpate::detail {
namespace {

constexpr int kFastSize = 3;
constexpr int kFastDepth = 3;

// Number of blocks that cover the columns and one more column on either side.
int widerBlocks(int columns) { return (columns + 2 + kFour - 1) / kFour; }

class Median3x3 final : public MatrixKernel {
 public:
  explicit Median3x3(const MatrixLayout& layout)
      : padded_(layout, 1),
        neighbors_(padded_, 1),
        low_(padded_.size(), 0.0F),
        mid_(padded_.size(), 0.0F),
        high_(padded_.size(), 0.0F),
        out_(padded_.size(), 0.0F) {}

  void apply(float* values) override {
    padded_.fill(values, 0.0F);
    sortColumns();
    for (int y = 0; y < padded_.rows(); ++y) {
      for (int x = 0; x < padded_.columns(); x += kFour) {
        const int i = padded_.at(y, x);
        store(out_.data() + i, median9(triple(i - 1), triple(i), triple(i + 1)));
      }
    }
    if (!neighbors_.empty()) besideMasked();
    padded_.writeBack(out_, values);
  }

 private:
  void sortColumns() {
    const int stride = padded_.stride();
    for (int y = 0; y < padded_.rows(); ++y) {
      for (int block = 0; block < widerBlocks(padded_.columns()); ++block) {
        const int i = padded_.at(y, -1 + block * kFour);
        const float* from = padded_.data() + i;
        const SortedTriple column =
            sorted(loadFour(from - stride), loadFour(from), loadFour(from + stride));
        store(low_.data() + i, column.low);
        store(mid_.data() + i, column.mid);
        store(high_.data() + i, column.high);
      }
    }
  }
  SortedTriple triple(int i) const {
    return {loadFour(low_.data() + i), loadFour(mid_.data() + i), loadFour(high_.data() + i)};
  }
  void besideMasked() {
    const float* plane = padded_.data();
    neighbors_.gather({&plane, 1});
    for (std::size_t block = 0; block < neighbors_.numBlocks(); ++block) {
      std::array<SortedTriple, 3> columns;
      for (std::size_t i = 0; i < 3; ++i)
        columns[i] = sorted(neighbors_.lanes(3 * i, block),
                            neighbors_.lanes(3 * i + 1, block),
                            neighbors_.lanes(3 * i + 2, block));
      neighbors_.scatter(median9(columns[0], columns[1], columns[2]), block, out_);
    }
  }

  PaddedMatrix padded_;
  MedianNeighbors neighbors_;
  std::vector<float> low_;  // of three vertical neighbours each, sorted
  std::vector<float> mid_;
  std::vector<float> high_;
  std::vector<float> out_;
};

// Median of any window size and any number of frames.
class AnyMedian final : public MatrixKernel, public FramesMedian {
 public:
  AnyMedian(const MatrixLayout& layout, int size) : layout_(layout) {
    const int radius = size / 2;
    for (int y = 0; y < layout.rows; ++y) {
      for (int x = 0; x < layout.columns; ++x) {
        if (!layout.enabled(y, x)) continue;
        Taxel taxel{static_cast<std::size_t>(y * layout.columns + x), {}};
        for (int dy = -radius; dy <= radius; ++dy) {
          for (int dx = -radius; dx <= radius; ++dx) {
            const int fromY = std::clamp(y + dy, 0, layout.rows - 1);
            const int fromX = std::clamp(x + dx, 0, layout.columns - 1);
            if (layout.enabled(fromY, fromX))
              taxel.neighbors.push_back(static_cast<std::size_t>(fromY * layout.columns + fromX));
          }
        }
        taxels_.push_back(std::move(taxel));
      }
    }
  }

  void apply(float* values) override {
    read_.assign(values, values + layout_.numCells());
    const float* frame = read_.data();
    apply({&frame, 1}, values);
  }

  void apply(std::span<const float* const> frames, float* values) override {
    for (const Taxel& taxel : taxels_) {
      window_.clear();
      for (const float* frame : frames)
        for (const std::size_t neighbor : taxel.neighbors) window_.push_back(frame[neighbor]);
      // For an even number of values, take the smaller of the two in the middle, unlike
      // core/statistics.h.
      const auto middle = window_.begin() + static_cast<std::ptrdiff_t>((window_.size() - 1) / 2);
      std::nth_element(window_.begin(), middle, window_.end());
      values[taxel.place] = *middle;
    }
  }

 private:
  struct Taxel {
    std::size_t place;
    std::vector<std::size_t> neighbors;  // neighbours at the border appear more than once
  };
  const MatrixLayout layout_;
  std::vector<Taxel> taxels_;
  std::vector<float> window_;
  std::vector<float> read_;
};

class Median3x3x3 final : public FramesMedian {
 public:
  explicit Median3x3x3(const MatrixLayout& layout)
      : frames_{PaddedMatrix(layout, 1), PaddedMatrix(layout, 1), PaddedMatrix(layout, 1)},
        neighbors_(frames_[0], kFastDepth),
        out_(frames_[0].size(), 0.0F) {
    for (auto& rank : ranks_) rank.assign(frames_[0].size(), 0.0F);
  }

  void apply(std::span<const float* const> frames, float* values) override {
    for (std::size_t f = 0; f < kFastDepth; ++f) frames_[f].fill(frames[f], 0.0F);
    sortColumns();
    const PaddedMatrix& shape = frames_[0];
    for (int y = 0; y < shape.rows(); ++y) {
      for (int x = 0; x < shape.columns(); x += kFour) {
        const int i = shape.at(y, x);
        store(out_.data() + i, median27(column(i - 1), column(i), column(i + 1)));
      }
    }
    if (!neighbors_.empty()) besideMasked();
    shape.writeBack(out_, values);
  }

 private:
  void sortColumns() {
    const PaddedMatrix& shape = frames_[0];
    const int stride = shape.stride();
    for (int y = 0; y < shape.rows(); ++y) {
      for (int block = 0; block < widerBlocks(shape.columns()); ++block) {
        const int i = shape.at(y, -1 + block * kFour);
        Nine column;
        for (std::size_t f = 0; f < kFastDepth; ++f) {
          const float* from = frames_[f].data() + i;
          column[3 * f] = loadFour(from - stride);
          column[3 * f + 1] = loadFour(from);
          column[3 * f + 2] = loadFour(from + stride);
        }
        sort(column);
        for (std::size_t rank = 0; rank < column.size(); ++rank)
          store(ranks_[rank].data() + i, column[rank]);
      }
    }
  }
  Nine column(int i) const {
    Nine lanes;
    for (std::size_t rank = 0; rank < lanes.size(); ++rank)
      lanes[rank] = loadFour(ranks_[rank].data() + i);
    return lanes;
  }
  void besideMasked() {
    const std::array<const float*, kFastDepth> planes = {
        frames_[0].data(), frames_[1].data(), frames_[2].data()};
    neighbors_.gather(planes);
    for (std::size_t block = 0; block < neighbors_.numBlocks(); ++block) {
      std::array<Nine, 3> columns;
      for (std::size_t c = 0; c < columns.size(); ++c) {
        for (std::size_t i = 0; i < 9; ++i) columns[c][i] = neighbors_.lanes(9 * c + i, block);
        sort(columns[c]);
      }
      neighbors_.scatter(median27(columns[0], columns[1], columns[2]), block, out_);
    }
  }

  std::array<PaddedMatrix, kFastDepth> frames_;
  MedianNeighbors neighbors_;
  std::array<std::vector<float>, 9>
      ranks_;  // of nine taxels each: three vertical neighbours in three frames
  std::vector<float> out_;
};

}  // namespace

std::unique_ptr<MatrixKernel> medianKernel(const MatrixLayout& layout, int size) {
  if (size == kFastSize) return std::make_unique<Median3x3>(layout);
  return std::make_unique<AnyMedian>(layout, size);
}

std::unique_ptr<FramesMedian> framesMedian(const MatrixLayout& layout, int size, int depth) {
  if (size == kFastSize && depth == kFastDepth) return std::make_unique<Median3x3x3>(layout);
  return std::make_unique<AnyMedian>(layout, size);
}

}  // namespace palpate::detail
