// Keys that go through choices one after the other.
#pragma once

#include <algorithm>

namespace palpate::gui {

// The choice after `now`, around.
template <class Choices, class Choice>
Choice after(const Choices& all, Choice now) {
  auto at = std::find(all.begin(), all.end(), now);
  if (at == all.end() || ++at == all.end()) at = all.begin();
  return *at;
}

}  // namespace palpate::gui
