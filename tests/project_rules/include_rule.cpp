#include "project_rules/include_rule.h"

#include <filesystem>
#include <iterator>
#include <regex>
#include <sstream>

namespace palpate::testing {
namespace {

bool isStandardHeader(const std::string& name) {
  static const std::regex pattern("[a-z_0-9]+");
  return std::regex_match(name, pattern);
}

std::set<std::string> wordsOf(std::string list) {
  for (char& c : list)
    if (c == ',' || c == '`') c = ' ';
  std::istringstream in(list);
  return {std::istream_iterator<std::string>(in), {}};
}

// "gui/FOLDER/x.h" and "commands/x.h" stand for folders of apps/palpate, "python/x.h" for
// apps/python, any other for private headers. "gui/x.h", a header of no folder, stands for
// apps/palpate/gui.
std::string moduleOfInclude(const std::string& name) {
  const std::string first = name.substr(0, name.find('/'));
  if (first == "palpate") {
    const std::string rest = name.substr(8);
    return rest.substr(0, rest.find('/'));
  }
  if (first == "python") return "apps/python";
  if (first == "gui") return "apps/palpate/" + name.substr(0, name.rfind('/'));
  return first == "commands" ? "apps/palpate/" + first : first;
}

// What lies in its folders; no file lies in it.
const std::string kWindow = "apps/palpate/gui";

bool isPublic(std::string_view path) { return path.starts_with("include/"); }

// "dsa" of src/recording/dsa/x.cpp and of the private header recording/dsa/x.h; empty: directly in
// its module.
std::string privateFolderOf(std::string path) {
  if (path.starts_with("src/")) path = path.substr(4);
  const std::size_t module = path.find('/');
  const std::size_t folder = path.rfind('/');
  return module == folder || module == std::string::npos
             ? std::string()
             : path.substr(module + 1, folder - module - 1);
}

class Judge {
 public:
  Judge(const SourceFile& file, const IncludeRules& rules)
      : rules_(rules), path_(file.path), module_(moduleOf(file.path)) {}

  // Empty when the include is right.
  std::string faultOf(const std::string& name, bool quoted) const {
    if (module_.empty()) return "lies in no module";
    if (module_ == kWindow) return "lies in no folder of the window";
    if (module_ != "apps/palpate" && !rules_.modules.contains(module_))
      return "the module " + module_ + " isn't in the table of docs/architecture.md";
    if (name.find('/') == std::string::npos && isStandardHeader(name)) return {};
    if (quoted && isNeighbour(name)) return {};
    const std::string target = moduleOfInclude(name);
    const bool ours = name.starts_with("palpate/") || quoted;
    return ours && name.find('/') != std::string::npos ? faultOfOurs(name, target)
                                                       : faultOfForeign(name);
  }

 private:
  // A header beside the including file, named without its folder.
  bool isNeighbour(const std::string& name) const {
    return name.find('/') == std::string::npos && !isPublic(path_) &&
           std::filesystem::exists((projectFolder() / path_).parent_path() / name);
  }

  std::string faultOfOurs(const std::string& name, const std::string& target) const {
    const bool targetIsPublic = name.starts_with("palpate/");
    if (target == kWindow) return name + " lies in no folder of the window";
    if (target == module_) return faultWithinModule(name, targetIsPublic);
    if (!targetIsPublic && !target.starts_with("apps/"))
      return name + " is private to the module " + target;
    if (module_ == "apps/palpate") return {};  // main.cpp
    const auto& allowed = rules_.modules.at(module_);
    if (target == "core" || allowed.contains(target)) return {};
    const bool isModule = rules_.modules.contains(target);
    if (allowed.contains("all") && !target.starts_with("apps/") && isModule) return {};
    if (allowed.contains(kWindow) && target.starts_with(kWindow + "/") && isModule) return {};
    return module_ + " may not include " + name;
  }

  // Private headers of a folder of a module serve this folder, and what lies directly in the module
  // and joins them.
  std::string faultWithinModule(const std::string& name, bool targetIsPublic) const {
    if (targetIsPublic) return {};
    if (isPublic(path_)) return "a public header includes the private " + name;
    if (!path_.starts_with("src/")) return {};
    const std::string from = privateFolderOf(path_), to = privateFolderOf(name);
    return from.empty() || to.empty() || from == to ? std::string()
                                                    : name + " is private to the folder " + to;
  }

  std::string faultOfForeign(const std::string& name) const {
    if (isPublic(path_)) {
      if (name.starts_with("Eigen/")) return {};
      return name + " may not stand in a public header";
    }
    for (const auto& [start, places] : rules_.packages) {
      if (!name.starts_with(start)) continue;
      for (const std::string& place : places)
        if (place == "all" || module_ == place || module_.starts_with(place + "/")) return {};
    }
    return name + " may not be included in " + module_ + " (table of packages)";
  }

  const IncludeRules& rules_;
  std::string path_;
  std::string module_;
};

}  // namespace

IncludeRules IncludeRules::fromPage(std::string_view page) {
  IncludeRules rules;
  for (const std::string& line : sectionOf(page, "Modules")) {
    const auto cells = cellsOf(line);
    if (cells.size() == 3 && cells[0].starts_with('`'))
      rules.modules[codeWordsOf(cells[0]).at(0)] = wordsOf(cells[2]);
  }
  // Folders of the window may include every module, and of each other what their row names.
  std::set<std::string> ground;
  for (const std::string& line : sectionOf(page, "Inside the window")) {
    const auto cells = cellsOf(line);
    if (cells.size() != 3 || !cells[0].starts_with('`')) continue;
    const std::string folder = codeWordsOf(cells[0]).at(0);
    std::set<std::string>& allowed = rules.modules[kWindow + "/" + folder];
    allowed = {"all"};
    for (const std::string& word : wordsOf(cells[2])) {
      if (word == "all")
        allowed.insert(kWindow);
      else if (word == "BASE")
        for (const std::string& base : ground) allowed.insert(base);
      else
        allowed.insert(kWindow + "/" + word);
    }
    if (cells[0].find("BASE") != std::string::npos) ground.insert(kWindow + "/" + folder);
  }
  for (const std::string& line : sectionOf(page, "Packages")) {
    const auto cells = cellsOf(line);
    if (cells.size() != 4) continue;
    for (const std::string& start : codeWordsOf(cells[1]))
      rules.packages[start] = wordsOf(cells[2]);
  }
  return rules;
}

std::string moduleOf(std::string_view path) {
  static const std::regex pattern(
      "(?:include/palpate|src)/([^/]+)/.*|(apps/palpate/gui/[^/]+)/.*|(apps/palpate(?:/[^/]+)?)/[^/"
      "]+|"
      "(apps/[^/]+)/.*");
  std::cmatch match;
  if (!std::regex_match(path.data(), path.data() + path.size(), match, pattern)) return {};
  for (std::size_t group = 1; group < match.size(); ++group)
    if (match[group].matched) return match[group];
  return {};
}

std::vector<std::string> includeFaults(const SourceFile& file, const IncludeRules& rules) {
  static const std::regex pattern(R"re(\s*#\s*include\s*([<"])([^>"]+)[>"].*)re");
  const Judge judge(file, rules);
  std::vector<std::string> faults;
  int number = 0;
  for (const std::string& line : linesOf(file.text)) {
    ++number;
    std::smatch match;
    if (!std::regex_match(line, match, pattern)) continue;
    const std::string fault = judge.faultOf(match[2], match[1] == "\"");
    if (!fault.empty()) faults.push_back(file.path + ":" + std::to_string(number) + ": " + fault);
  }
  return faults;
}

}  // namespace palpate::testing
