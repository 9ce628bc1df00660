// Which tests a process runs. One program holds all tests of a module; each file of tests is run by
// a process of its own, so that files can't disturb each other.
#pragma once

#include <string>

namespace palpate::testing {

// Initialises GoogleTest and selects the tests of this process:
//   --file=NAME    only the tests of the source NAME.cpp
//   --entry=NAME   what the process is called in reports, "MODULE/FILE"
// Environment: TEST_FILTER, a regular expression: only tests whose whole name,
// "MODULE/FILE.Suite.Test", matches it; PALPATE_TEST_REPORTS, a folder: an XML report
// MODULE.FILE.xml is written into it. Returns whether any test is left; throws
// std::invalid_argument for an option it doesn't know, and where no test is left that neither
// TEST_FILTER nor --gtest_filter took away: a process that has nothing to show must not pass.
bool selectTests(int& argc, char** argv);

}  // namespace palpate::testing
