// main() of the test programs that need no window.
#include <cstdio>
#include <exception>

#include <gtest/gtest.h>

#include "testing/test_selection.h"

int main(int argc, char** argv) {
  try {
    palpate::testing::selectTests(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return RUN_ALL_TESTS();
}
