// main() of the test programs that need no window.
#include <cstdio>
#include <exception>
#include <vector>

#include <gtest/gtest.h>

#include "testing/test_run.h"
#include "testing/test_selection.h"

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc + 1);
  try {
    palpate::testing::selectTests(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return palpate::testing::runTests(arguments.data());
}
