// The modules include what docs/architecture.md allows, and nothing else.
#include "project_rules/include_rule.h"

#include <gtest/gtest.h>

#include "testing/testing.h"

namespace palpate::testing::include_rule_test {
namespace {

IncludeRules projectRules() {
  return IncludeRules::fromPage(readFile(projectFolder() / "docs/architecture.md"));
}

const std::string kWindow = "apps/palpate/gui";

std::size_t numFaults(const std::string& path, const std::string& line) {
  return includeFaults({path, "#pragma once\n" + line + "\n"}, projectRules()).size();
}

TEST(IncludeRule, HoldsInTheWholeProject) {
  const IncludeRules rules = projectRules();
  const auto files = cppFiles({"include", "src", "apps"});
  EXPECT_GT(files.size(), 50u) << "the project was not found";
  for (const SourceFile& file : files)
    for (const std::string& fault : includeFaults(file, rules)) ADD_FAILURE() << fault;
}

TEST(IncludeRule, KnowsEveryModuleThatIsBuilt) {
  const IncludeRules rules = projectRules();
  const auto known = [&](const std::filesystem::path& folder, const std::string& before) {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.is_directory()) {
        EXPECT_TRUE(rules.modules.contains(before + entry.path().filename().string()))
            << entry.path();
      }
  };
  known(projectFolder() / "src", "");
  known(projectFolder() / kWindow, kWindow + "/");
  for (const auto& [module, allowed] : rules.modules) {
    const auto folder =
        module.starts_with("apps/") ? projectFolder() / module : projectFolder() / "src" / module;
    EXPECT_TRUE(std::filesystem::is_directory(folder)) << "no such module: " << module;
  }
}

TEST(IncludeRule, ArrowsOfTheTableMakeNoCircle) {
  const IncludeRules rules = projectRules();
  std::set<std::string> placed = {"core"};
  for (bool progress = true; progress;) {
    progress = false;
    for (const auto& [module, allowed] : rules.modules) {
      if (placed.contains(module)) continue;
      bool ready = true;
      for (const std::string& other : allowed)
        ready = ready && (other == "all" || other == kWindow || placed.contains(other));
      if (ready) progress = placed.insert(module).second;
    }
  }
  for (const auto& [module, allowed] : rules.modules)
    EXPECT_TRUE(placed.contains(module)) << module << " includes itself";
}

TEST(IncludeRule, FindsAPlantedWrongInclude) {
  // Against the arrows.
  EXPECT_EQ(numFaults("src/core/x.cpp", "#include \"palpate/model/profile.h\""), 1u);
  EXPECT_EQ(numFaults("include/palpate/core/x.h", "#include <palpate/model/profile.h>"), 1u);
  EXPECT_EQ(numFaults("src/model/x.cpp", "# include <palpate/filter/gaussian.h>"), 1u);
  EXPECT_EQ(numFaults("src/filter/x.cpp", "#include <palpate/recording/dsa_reader.h>"), 1u);
  // Windows.
  EXPECT_EQ(numFaults("src/core/x.cpp", "#include <QString>"), 1u);
  EXPECT_EQ(numFaults("src/recording/x.cpp", "#include <QtCore/QFile>"), 1u);
  EXPECT_EQ(numFaults("src/filter/x.cpp", "#include \"gui/color_map.h\""), 1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/slip/x.cpp", "#include \"commands/commands.h\""), 1u);
  // Foreign types in public headers.
  for (const char* name : {"opencv2/core.hpp",
                           "ceres/ceres.h",
                           "CGAL/Point.h",
                           "boost/any.hpp",
                           "sqlite3.h",
                           "libserialport.h",
                           "nlohmann/json.hpp",
                           "expat.h",
                           "bzlib.h",
                           "openssl/evp.h",
                           "QString",
                           "unistd.h"})
    EXPECT_EQ(numFaults("include/palpate/recording/x.h", std::string("#include <") + name + ">"),
              1u)
        << name;
  // A package outside of its place, or one that no row names.
  EXPECT_EQ(numFaults("src/model/x.cpp", "#include <nlohmann/json.hpp>"), 1u);
  EXPECT_EQ(numFaults("src/core/x.cpp", "#include <fftw3.h>"), 1u);
  // Private headers.
  EXPECT_EQ(numFaults("src/capture/x.cpp", "#include \"recording/dsa_sensor.h\""), 1u);
  EXPECT_EQ(numFaults("include/palpate/recording/x.h", "#include \"recording/dsa_sensor.h\""), 1u);
  EXPECT_EQ(numFaults("src/recording/native/x.cpp", "#include \"recording/dsa/dsa_xml_stream.h\""),
            1u);
  // Quotes make no neighbour of it.
  EXPECT_EQ(numFaults("src/model/x.cpp", "#include \"sqlite3.h\""), 1u);
  // A module without a row.
  EXPECT_EQ(numFaults("src/utils/x.cpp", "#include <vector>"), 1u);
}

TEST(IncludeRule, FindsAPlantedWrongIncludeInsideTheWindow) {
  // A feature of another, the ground of a feature, anything of the shell.
  EXPECT_EQ(numFaults("apps/palpate/gui/slip/x.h", "#include \"gui/hand/stop_key.h\""), 1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/matrices/x.h", "#include \"gui/hand3d/hand_view.h\""), 1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/window_state/x.cpp", "#include \"gui/slip/slip_panel.h\""),
            1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/appearance/x.cpp", "#include \"gui/source/session.h\""),
            1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/slip/x.h", "#include \"gui/shell/main_window.h\""), 1u);
  // No folder, a folder without a row, a folder in a folder.
  EXPECT_EQ(numFaults("apps/palpate/gui/x.cpp", "#include <vector>"), 1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/slip/x.cpp", "#include \"gui/theme.h\""), 1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/shell/x.cpp", "#include \"gui/theme.h\""), 1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/utils/x.cpp", "#include <vector>"), 1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/shell/x.cpp", "#include \"gui/utils/x.h\""), 1u);
  EXPECT_EQ(numFaults("apps/palpate/gui/slip/x.cpp", "#include \"gui/appearance/old/x.h\""), 1u);
  // The window of a command.
  EXPECT_EQ(numFaults("apps/palpate/commands/x.cpp", "#include \"gui/slip/slip_panel.h\""), 1u);

  EXPECT_EQ(numFaults("apps/palpate/gui/slip/x.h", "#include \"gui/appearance/theme.h\""), 0u);
  EXPECT_EQ(numFaults("apps/palpate/gui/slip/x.h", "#include \"gui/slip/slip_panel.h\""), 0u);
  EXPECT_EQ(numFaults("apps/palpate/gui/slip/x.h", "#include <palpate/slip/slip_hypotheses.h>"),
            0u);
  EXPECT_EQ(numFaults("apps/palpate/gui/hand3d/x.h", "#include \"gui/matrices/taxel_text.h\""), 0u);
  EXPECT_EQ(numFaults("apps/palpate/gui/shell/x.h", "#include \"gui/slip/slip_panel.h\""), 0u);
}

TEST(IncludeRule, AllowsWhatTheTablesAllow) {
  EXPECT_EQ(numFaults("include/palpate/model/x.h", "#include <Eigen/Core>"), 0u);
  EXPECT_EQ(numFaults("include/palpate/model/x.h", "#include <palpate/core/error.h>"), 0u);
  EXPECT_EQ(numFaults("src/core/x.cpp", "#include <expat.h>"), 0u);
  EXPECT_EQ(numFaults("src/core/x.cpp", "#include <sys/stat.h>"), 0u);
  EXPECT_EQ(numFaults("src/recording/x.cpp", "#include \"recording/dsa_sensor.h\""), 0u);
  EXPECT_EQ(numFaults("src/recording/x.cpp", "#include \"recording/dsa/dsa_xml_stream.h\""), 0u);
  EXPECT_EQ(numFaults("src/recording/dsa/x.cpp", "#include \"recording/dsa/dsa_xml_stream.h\""),
            0u);
  EXPECT_EQ(numFaults("src/recording/dsa/x.cpp", "#include \"recording/dsa_sensor.h\""), 0u);
  EXPECT_EQ(numFaults("src/recording/x.cpp", "#include <palpate/model/profile.h>"), 0u);
  EXPECT_EQ(numFaults("apps/palpate/gui/slip/x.h", "#include <QWidget>"), 0u);
  EXPECT_EQ(numFaults("apps/palpate/commands/x.cpp", "#include \"gui/shell/run_window.h\""), 0u);
  EXPECT_EQ(numFaults("apps/palpate/main.cpp", "#include \"commands/commands.h\""), 0u);
  EXPECT_EQ(numFaults("src/core/x.cpp", "// #include <QString> was here"), 0u);
}

}  // namespace
}  // namespace palpate::testing::include_rule_test
