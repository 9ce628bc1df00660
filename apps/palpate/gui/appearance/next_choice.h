// Returns the next of several choices, for keys that go through the choices one by one.
#pragma once

#include <algorithm>

namespace palpate::gui {

// The choice after `now`; the first one after the last.
template <class Choices, class Choice>
Choice after(const Choices& all, Choice now) {
  auto at = std::find(all.begin(), all.end(), now);
  if (at == all.end() || ++at == all.end()) at = all.begin();
  return *at;
}

}  // namespace palpate::gui
