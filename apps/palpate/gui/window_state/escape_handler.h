// Decides what the key Escape does: one thing at a time, the most urgent first. Features register
// here what can be left or cancelled.
#pragma once

#include <functional>
#include <map>
#include <vector>

namespace palpate::gui {

class EscapeHandler {
 public:
  // In the order in which Escape tries them.
  enum class Order {
    // A view that fills the screen.
    kShow,
    // Messages.
    kAlarm,
    kMessage,
    // Work that runs.
    kOpening,
    kExport,
    kWork,
    kComputation,
    kConnecting,
    // The comparison, which hides the selections.
    kCompare,
    // Selections.
    kTaxels,
    kSpan,
    kFullScreen
  };
  // `leave` returns whether there was anything to leave. What it refers to must outlive this
  // object.
  void add(Order order, std::function<bool()> leave) { all_[order].push_back(std::move(leave)); }
  void clear() { all_.clear(); }
  // Calls the registered functions in order, from `from` on, until one has left something.
  void press(Order from = Order::kShow) const {
    for (auto at = all_.lower_bound(from); at != all_.end(); ++at)
      for (const auto& leave : at->second)
        if (leave()) return;
  }

 private:
  std::map<Order, std::vector<std::function<bool()>>> all_;
};

}  // namespace palpate::gui
