// A test during which something was thrown at an event has failed: the application catches it, and
// goes on.
#pragma once

#include <cstddef>

#include <gtest/gtest.h>

#include "gui/desktop/application.h"

namespace palpate::testing {

class ThrownAtEvents : public ::testing::EmptyTestEventListener {
 public:
  void OnTestStart(const ::testing::TestInfo&) override { before_ = gui::failuresAtEvents(); }
  void OnTestEnd(const ::testing::TestInfo&) override {
    if (gui::failuresAtEvents() > before_)
      ADD_FAILURE() << "the window threw at " << gui::failuresAtEvents() - before_ << " events";
  }

 private:
  std::size_t before_ = 0;
};

}  // namespace palpate::testing
