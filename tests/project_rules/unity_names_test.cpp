// Names in anonymous namespaces differ within a folder, the window with its folders being one: its
// sources are compiled several at a time, and which of them meet changes with every file that is
// added.
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "project_rules/source_tree.h"

namespace palpate::testing::unity_names_test {
namespace {

// What is declared at the outermost level of the anonymous namespaces of a source: types,
// constants, functions.
std::set<std::string> anonymousNames(const std::string& text) {
  static const std::regex type("^(?:struct|class|enum class|enum|union)\\s+(\\w+)");
  static const std::regex alias("^using (\\w+) =");
  static const std::regex function("^[^(=\":]*(?:::[^(=\":]+)*[ *&](\\w+)\\(");
  static const std::regex variable("^[^()=\"]*?\\b(\\w+)(?:\\[[^\\]]*\\])?\\s*(?:=|\\{|;)");
  static const std::regex other("^(?:[ })/#]|template|using|static_assert|namespace)");
  std::set<std::string> names;
  bool inside = false;
  bool raw = false;  // in a raw string, such as a style sheet
  for (const std::string& line : linesOf(text)) {
    if (line == "namespace {") inside = true;
    if (line == "}  // namespace") inside = false;
    const bool opens = line.find("R\"(") != std::string::npos;
    const bool wasRaw = raw;
    if (opens) raw = true;
    if (line.find(")\"") != std::string::npos) raw = false;
    if (!inside || wasRaw || line.empty() || line == "namespace {") continue;
    std::smatch match;
    if (std::regex_search(line, match, type) || std::regex_search(line, match, alias)) {
      names.insert(match[1]);
      continue;
    }
    if (std::regex_search(line, other)) continue;
    std::smatch call;
    const bool isCall = std::regex_search(line, call, function);
    const bool isVariable = std::regex_search(line, match, variable);
    if (isCall && (!isVariable || call.length() <= match.length()))
      names.insert(call[1]);
    else if (isVariable)
      names.insert(match[1]);
  }
  return names;
}

// Overloads of one function that public headers declare, too.
const std::set<std::string> kOverloaded = {"jsonOf"};

std::vector<std::string> clashesIn(const std::vector<SourceFile>& files) {
  std::map<std::pair<std::string, std::string>, std::string> seen;  // folder, name -> file
  std::vector<std::string> clashes;
  for (const SourceFile& file : files) {
    if (!file.path.ends_with(".cpp")) continue;
    const std::string folder = file.path.starts_with("apps/palpate/gui/")
                                   ? "apps/palpate/gui"
                                   : file.path.substr(0, file.path.rfind('/'));
    for (const std::string& name : anonymousNames(file.text)) {
      if (kOverloaded.contains(name)) continue;
      const auto [at, isNew] = seen.try_emplace({folder, name}, file.path);
      if (!isNew) clashes.push_back(name + ": " + at->second + " and " + file.path);
    }
  }
  return clashes;
}

TEST(UnityNames, DifferWithinAFolder) {
  for (const std::string& clash : clashesIn(cppFiles({"src", "apps"}))) ADD_FAILURE() << clash;
}

TEST(UnityNames, TestsHaveANamespaceEach) {
  for (const SourceFile& file : cppFiles({"tests"})) {
    if (!file.path.ends_with("_test.cpp")) continue;
    const std::size_t slash = file.path.rfind('/');
    const std::string stem = file.path.substr(slash + 1, file.path.size() - slash - 5);
    EXPECT_TRUE(
        std::regex_search(file.text, std::regex("namespace palpate[a-z_:]*::" + stem + " \\{")))
        << file.path << " has no namespace of its name";
  }
}

TEST(UnityNames, APlantedClashIsFound) {
  const auto source = [](const char* path, const std::string& body) {
    return SourceFile{path,
                      "namespace palpate {\nnamespace {\n\n" + body + "\n\n}  // namespace\n}\n"};
  };
  const auto a = source("src/core/a.cpp", "constexpr double kPart = 0.5;");
  EXPECT_EQ(clashesIn({a, source("src/core/b.cpp", "constexpr int kPart = 2;")}),
            (std::vector<std::string>{"kPart: src/core/a.cpp and src/core/b.cpp"}));
  EXPECT_TRUE(clashesIn({a, source("src/model/b.cpp", "constexpr int kPart = 2;")}).empty());
  EXPECT_EQ(clashesIn({source("apps/palpate/gui/slip/a.cpp", "constexpr int kPart = 2;"),
                       source("apps/palpate/gui/hand/b.cpp", "constexpr int kPart = 2;")})
                .size(),
            1u);
  const auto f = source("src/core/f.cpp", "int sum(int a) {\n  return kPart;\n}\nclass Line {\n};");
  EXPECT_EQ(clashesIn({f, source("src/core/g.cpp", "double sum() { return 0; }")}).size(), 1u);
  EXPECT_EQ(clashesIn({f, source("src/core/g.cpp", "struct Line {\n};")}).size(), 1u);
  EXPECT_TRUE(clashesIn({a, f}).empty());
}

}  // namespace
}  // namespace palpate::testing::unity_names_test
