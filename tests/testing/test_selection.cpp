#include "testing/test_selection.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <stdexcept>

#include <gtest/gtest.h>

namespace palpate::testing {
namespace {

std::string variableText(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

bool selectTests(int& argc, char** argv) {
  std::string file;
  std::string entry;
  int rest = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("--file="))
      file = word.substr(7);
    else if (word.starts_with("--entry="))
      entry = word.substr(8);
    else
      argv[rest++] = argv[i];
  }
  argc = rest;
  argv[argc] = nullptr;
  // Set before GoogleTest is initialised, because that creates the XML reporter.
  const std::string folder = variableText("PALPATE_TEST_REPORTS");
  if (!folder.empty() && !entry.empty()) {
    std::string name = entry;
    std::replace(name.begin(), name.end(), '/', '.');
    GTEST_FLAG_SET(output, "xml:" + folder + "/" + name + ".xml");
  }
  ::testing::InitGoogleTest(&argc, argv);
  if (argc > 1) throw std::invalid_argument(std::string("unknown option ") + argv[1]);
  const std::string pattern = variableText("TEST_FILTER");
  const std::regex wanted(pattern);
  const std::string module = entry.empty() ? std::filesystem::path(argv[0]).stem().string()
                                           : entry.substr(0, entry.rfind('/'));
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  std::string chosen;
  std::string left;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const ::testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const ::testing::TestInfo& test = *suite.GetTestInfo(t);
      const std::string source = std::filesystem::path(test.file()).stem().string();
      const std::string name = std::string(suite.name()) + "." + test.name();
      const bool here = file.empty() || source == file;
      const bool match =
          pattern.empty() || std::regex_search(module + "/" + source + "." + name, wanted);
      std::string& list = here && match ? chosen : left;
      list += (list.empty() ? "" : ":") + name;
    }
  }
  if (chosen.empty() && pattern.empty() && GTEST_FLAG_GET(filter) == "*")
    throw std::invalid_argument("no test is selected" +
                                (file.empty() ? std::string() : ": no source is named " + file));
  // An explicit --gtest_filter is restricted to the tests of the file; otherwise the tests of the
  // file are the filter.
  if (GTEST_FLAG_GET(filter) == "*") {
    GTEST_FLAG_SET(filter, chosen.empty() ? "-*" : chosen);
  } else {
    const std::string own = GTEST_FLAG_GET(filter);
    GTEST_FLAG_SET(filter, own + (own.find('-') == std::string::npos ? "-" : ":") + left);
  }
  return !chosen.empty();
}

}  // namespace palpate::testing
