#include "palpate/recognition/sample_splits.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace palpate {
namespace {

using Members = std::vector<std::vector<std::size_t>>;

Members membersOf(const std::vector<int>& y) {
  if (y.empty()) throw std::invalid_argument("no sample to split");
  if (*std::min_element(y.begin(), y.end()) < 0)
    throw std::invalid_argument("a label below 0 can't be split");
  Members members(static_cast<std::size_t>(*std::max_element(y.begin(), y.end())) + 1);
  for (std::size_t i = 0; i < y.size(); ++i) members[static_cast<std::size_t>(y[i])].push_back(i);
  return members;
}

// Own shuffle and drawing, because std::shuffle and std::uniform_int_distribution give different
// results in different standard libraries.
std::size_t drawBelow(std::mt19937_64& generator, std::size_t bound) {
  const std::uint64_t whole = std::mt19937_64::max() - std::mt19937_64::max() % bound;
  std::uint64_t drawn = generator();
  while (drawn >= whole) drawn = generator();
  return static_cast<std::size_t>(drawn % bound);
}

void shuffle(std::vector<std::size_t>& items, std::mt19937_64& generator) {
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[drawBelow(generator, i)]);
}

// Returns the number of test samples of each class.
std::vector<std::size_t> shares(const Members& members,
                                std::size_t wanted,
                                std::mt19937_64& generator) {
  std::size_t all = 0, given = 0;
  for (const auto& one : members) all += one.size() > 1 ? one.size() : 0;
  std::vector<std::size_t> share(members.size(), 0);
  // Remainder and class; ties are in random order.
  std::vector<std::pair<double, std::size_t>> remainders;
  std::vector<std::size_t> order(members.size());
  for (std::size_t c = 0; c < order.size(); ++c) order[c] = c;
  shuffle(order, generator);
  for (const std::size_t c : order) {
    if (members[c].size() < 2) continue;
    const double part = static_cast<double>(wanted) * static_cast<double>(members[c].size()) /
                        static_cast<double>(all);
    share[c] = std::min(static_cast<std::size_t>(part), members[c].size() - 1);
    given += share[c];
    remainders.emplace_back(part - std::floor(part), c);
  }
  std::stable_sort(remainders.begin(), remainders.end(), [](const auto& a, const auto& b) {
    return a.first > b.first;
  });
  for (const auto& [remainder, c] : remainders) {
    if (given >= wanted) break;
    // At least one sample of the class is kept for training.
    if (share[c] + 1 >= members[c].size()) continue;
    ++share[c];
    ++given;
  }
  return share;
}

void order(SampleSplit& split) {
  std::sort(split.train.begin(), split.train.end());
  std::sort(split.test.begin(), split.test.end());
}

}  // namespace

std::vector<SampleSplit> stratifiedSplits(const std::vector<int>& y,
                                          std::size_t splits,
                                          std::uint64_t seed,
                                          double testFraction) {
  if (!(testFraction > 0.0) || !(testFraction < 1.0))
    throw std::invalid_argument("the share for testing must be between 0 and 1");
  const Members members = membersOf(y);
  const auto wanted =
      static_cast<std::size_t>(std::ceil(testFraction * static_cast<double>(y.size())));
  std::mt19937_64 generator(seed);
  std::vector<SampleSplit> all(splits);
  for (SampleSplit& split : all) {
    const std::vector<std::size_t> share = shares(members, wanted, generator);
    for (std::size_t c = 0; c < members.size(); ++c) {
      std::vector<std::size_t> items = members[c];
      shuffle(items, generator);
      const auto middle = items.begin() + static_cast<std::ptrdiff_t>(share[c]);
      split.test.insert(split.test.end(), items.begin(), middle);
      split.train.insert(split.train.end(), middle, items.end());
    }
    if (split.test.empty() || split.train.empty())
      throw std::invalid_argument(
          std::to_string(y.size()) +
          " samples leave no test samples when each class needs training samples");
    order(split);
  }
  return all;
}

std::vector<SampleSplit> blockSplits(const std::vector<int>& y, std::size_t blocks) {
  if (blocks < 2) throw std::invalid_argument("at least two blocks are needed");
  const Members members = membersOf(y);
  std::vector<SampleSplit> all(blocks);
  for (const auto& items : members)
    for (std::size_t i = 0; i < items.size(); ++i)
      for (std::size_t k = 0; k < blocks; ++k) {
        const bool examines = items.size() > 1 && i >= k * items.size() / blocks &&
                              i < (k + 1) * items.size() / blocks;
        (examines ? all[k].test : all[k].train).push_back(items[i]);
      }
  for (SampleSplit& split : all) order(split);
  std::erase_if(all, [](const SampleSplit& split) { return split.test.empty(); });
  return all;
}

std::vector<SampleSplit> leaveClassOutSplits(const std::vector<int>& y) {
  const Members members = membersOf(y);
  std::vector<SampleSplit> all;
  for (std::size_t c = 0; c < members.size(); ++c) {
    if (members[c].empty()) continue;
    SampleSplit split;
    for (std::size_t i = 0; i < y.size(); ++i)
      (y[i] == static_cast<int>(c) ? split.test : split.train).push_back(i);
    all.push_back(std::move(split));
  }
  return all;
}

}  // namespace palpate
