// A computed series whose rows a thread of its own reads ahead. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "palpate/core/bounded_queue.h"
#include "palpate/recording/exported_series.h"

namespace palpate {

// Its rows are taken by one thread.
class RunningSeries {
 public:
  // Begins to compute. `series` must outlive it; `writer` is named where the series has fewer rows
  // than it says.
  RunningSeries(ExportedSeries& series, std::string writer)
      : series_(series),
        writer_(std::move(writer)),
        width_(series.columns().size()),
        numRows_(series.numRows()),
        thread_([this] { compute(); }) {}
  ~RunningSeries() { queue_.close(); }
  RunningSeries(const RunningSeries&) = delete;
  RunningSeries& operator=(const RunningSeries&) = delete;

  std::size_t taken() const { return taken_; }  // rows before the next one
  // Time of the next row [us since 1970], for which it waits; empty after the last one. Throws what
  // the series threw, and std::logic_error where it has fewer rows than it says.
  std::optional<std::int64_t> nextUs() {
    if (taken_ == numRows_) return std::nullopt;
    if (at_ == block_.times.size()) take();
    return block_.times[at_];
  }
  // The values of that row, a value per column.
  std::span<const double> row() const { return {block_.values.data() + at_ * width_, width_}; }
  void advance() {
    ++at_;
    ++taken_;
  }

 private:
  struct Block {
    std::vector<std::int64_t> times;
    std::vector<double> values;
    std::exception_ptr failure;
  };
  static constexpr std::size_t kRowsPerBlock = 1024;

  void take() {
    auto block = queue_.pop();
    if (!block) throw std::logic_error(writer_ + ": a series has fewer rows than it says");
    if (block->failure) std::rethrow_exception(block->failure);
    block_ = std::move(*block);
    at_ = 0;
  }

  void compute() {
    Block block;
    try {
      std::vector<double> row(width_);
      std::int64_t timeUs = 0;
      while (series_.next(timeUs, row)) {
        block.times.push_back(timeUs);
        block.values.insert(block.values.end(), row.begin(), row.end());
        if (block.times.size() < kRowsPerBlock) continue;
        if (!queue_.push(std::exchange(block, {}))) return;
      }
      if (!block.times.empty()) queue_.push(std::move(block));
    } catch (...) {
      block = {};
      block.failure = std::current_exception();
      queue_.push(std::move(block));
    }
    queue_.close();
  }

  ExportedSeries& series_;
  const std::string writer_;
  const std::size_t width_;
  const std::size_t numRows_;
  std::size_t taken_ = 0;
  Block block_;
  std::size_t at_ = 0;  // in the block
  BoundedQueue<Block> queue_{4};
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace palpate
