// Judges the stamps of a sender one after the other: unwraps counters of 32 bits (us, ms), finds
// restarts and single wrong stamps. A stamp that goes back, or ahead by more than 10 s, is a
// restart if the next one goes on from it, and wrong otherwise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "palpate/model/time_base.h"

namespace palpate {

class ClockTracker {
 public:
  enum class Verdict : std::uint8_t { kGood, kRestart, kUnusable };
  struct Judged {
    std::size_t item = 0;
    Verdict verdict = Verdict::kGood;
    std::int64_t hostUs = 0;
    std::int64_t deviceUs = 0;  // unwrapped since the last restart
  };
  // Appends the items that are judged now to `judged`. An item that waits for its next one comes
  // later; one that turns out to be wrong comes a second time, as unusable.
  void push(const ClockStamp& stamp, std::vector<Judged>& judged);
  // Judges the item that waits.
  void finish(std::vector<Judged>& judged);

 private:
  struct Item {
    std::size_t item = 0;
    std::int64_t hostUs = 0;
    std::int64_t sentUs = 0;  // as sent
    std::int64_t deviceUs = 0;
  };
  static std::optional<std::int64_t> stepOf(const Item& from, const Item& to);
  void accept(const Item& item, Verdict verdict, std::vector<Judged>& judged);

  std::size_t items_ = 0;
  std::optional<Item> last_;
  std::optional<Item> beforeLast_;  // since the last restart
  std::optional<Item> waiting_;
};

}  // namespace palpate
