// Who may include what: the tables of docs/architecture.md, checked against #include lines.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "project_rules/source_tree.h"

namespace palpate::testing {

// What a part of the project (a module, or a folder of apps/palpate) may include of the others.
struct IncludeRules {
  std::map<std::string, std::set<std::string>> modules;  // module -> modules beside itself and core
  // Start of a foreign header -> the parts (or folders of parts) whose sources may include it.
  std::map<std::string, std::set<std::string>> packages;

  // Reads the tables of the sections "Modules", "Inside the window" and "Packages".
  static IncludeRules fromPage(std::string_view page);
};

// "core" for include/palpate/core/x.h and src/core/x.cpp, "apps/palpate/gui/slip" for a file in
// there.
std::string moduleOf(std::string_view path);

// One line for each #include that breaks a rule: "PATH:LINE: what is wrong".
std::vector<std::string> includeFaults(const SourceFile& file, const IncludeRules& rules);

}  // namespace palpate::testing
