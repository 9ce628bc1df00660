// What the key Escape does: one thing at a time, the most urgent first. Who can be left or
// cancelled says so here.
#pragma once

#include <functional>
#include <map>
#include <vector>

namespace palpate::gui {

class EscapeHandler {
 public:
  // In this order.
  enum class Order {
    kShow,   // what fills the screen
    kAlarm,  // messages
    kMessage,
    kOpening,  // work that runs
    kExport,
    kWork,
    kComputation,
    kConnecting,
    kTaxels,  // what is chosen
    kSpan,
    kCompare,  // other views
    kFullScreen
  };
  // `leave` returns whether there was anything to leave. What it refers to must outlive this.
  void add(Order order, std::function<bool()> leave) { all_[order].push_back(std::move(leave)); }
  void clear() { all_.clear(); }
  // The first of all that has anything to leave, at this order or behind it.
  void press(Order from = Order::kShow) const {
    for (auto at = all_.lower_bound(from); at != all_.end(); ++at)
      for (const auto& leave : at->second)
        if (leave()) return;
  }

 private:
  std::map<Order, std::vector<std::function<bool()>>> all_;
};

}  // namespace palpate::gui
