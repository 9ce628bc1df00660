// Selects which tests a process runs. One program contains all tests of a module; each source file
// of tests runs in a process of its own, so that files cannot influence each other.
#pragma once

#include <string>

namespace palpate::testing {

// Initialises GoogleTest and selects the tests of this process:
//    --file=NAME    only the tests of the source NAME.cpp
//    --entry=NAME   the name of the process in reports, "MODULE/FILE"
// Environment: TEST_FILTER is a regular expression; only tests whose whole name
// "MODULE/FILE.Suite.Test" matches it are run. PALPATE_TEST_REPORTS is a folder that gets an XML
// report MODULE.FILE.xml. Returns whether any test is selected. Throws std::invalid_argument for an
// unknown option, and when no test is selected although neither TEST_FILTER nor --gtest_filter
// excluded any: a process without tests must not pass.
bool selectTests(int& argc, char** argv);

}  // namespace palpate::testing
