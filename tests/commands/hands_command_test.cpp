#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "palpate/core/json.h"

#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::hands_command_test {
namespace {

namespace fs = std::filesystem;

ProgramResult run(const std::vector<std::string>& words) {
  std::vector<std::string> all = {"hands"};
  all.insert(all.end(), words.begin(), words.end());
  return runProgram(PALPATE_PROGRAM, all);
}

TEST(HandsCommand, ListsTheBuiltInHands) {
  const auto result = run({"--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  std::map<std::string, Json> hands;
  const Json list = Json::parse(result.out).at("hands");
  for (std::size_t i = 0; i < list.size(); ++i)
    hands.emplace(list.at(i).at("key").asString(), list.at(i));
  // The figures of the SDH-2: six matrices, 456 taxels, seven axes, nine temperature sensors.
  ASSERT_TRUE(hands.contains("sdh2"));
  const Json& sdh2 = hands.at("sdh2");
  EXPECT_EQ(sdh2.at("taxels").asInteger(), 456);
  EXPECT_EQ(sdh2.at("matrices").size(), 6u);
  EXPECT_EQ(sdh2.at("axes").asInteger(), 7);
  EXPECT_EQ(sdh2.at("temperature_sensors").asInteger(), 9);
  EXPECT_EQ(hands.at("flat_pad_16x16").at("taxels").asInteger(), 256);
  EXPECT_EQ(hands.at("parallel_gripper").at("taxels").asInteger(), 2 * 14 * 6);
  EXPECT_EQ(hands.at("four_fingers").at("axes").asInteger(), 16);
  EXPECT_EQ(hands.at("sole").at("unit").asString(), "kPa");
  for (const auto& [key, hand] : hands) EXPECT_TRUE(hand.at("geometry").asBool()) << key;
}

TEST(HandsCommand, WritesTheListToAFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(run({"-o", folder / "hands.json"}).exitCode, 0);
  EXPECT_EQ(readFile(folder / "hands.json"), run({"--json"}).out);
  const auto result = run({"-o", folder / "hands.csv"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, (folder / "hands.csv").string() + "\n");
  const std::string table = readFile(folder / "hands.csv");
  EXPECT_TRUE(table.starts_with(
      "key,name,maker,unit,matrices,taxels,axes,temperature_sensors,geometry,source\n"))
      << table;
  EXPECT_NE(table.find("\nsdh2,"), std::string::npos) << table;
  EXPECT_NE(table.find(",456,7,9,1,"), std::string::npos) << table;
  EXPECT_EQ(run({"-o", folder / "hands.csv"}).exitCode, 1) << "exists already";
  EXPECT_EQ(run({"-o", folder / "hands.txt"}).exitCode, 2);
}

TEST(HandsCommand, ChecksAFolder) {
  for (const auto& entry : fs::directory_iterator(dataFolder() / "hands")) {
    if (!entry.is_directory()) continue;
    const auto result = run({"check", entry.path().string()});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("with geometry"), std::string::npos) << result.out;
  }
}

TEST(HandsCommand, CheckSaysWhatTheReadingsAre) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "hand.json")
      << R"({"format":"palpate-hand","version":1,"name":"x","full_scale":100,"matrices":)"
      << R"([{"name":"a","rows":4,"columns":4,"pitch_mm":2,"components":3}]})";
  const auto result = run({"check", folder.path().string()});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out,
            folder.path().string() +
                ": x: 4x4, 16 taxels, 3 components, signed, 0 axes, without geometry\n");
}

TEST(HandsCommand, SaysWhatDoesNotFit) {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path() / name) << text;
  };
  const auto expectFault = [&](const std::string& part) {
    const auto result = run({"check", folder.path().string()});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  expectFault("hand.json");
  const std::string begin = R"({"format":"palpate-hand","version":1,"name":"x","full_scale":100,)";
  write("hand.json", begin + R"("matrices":[{"name":"a","rows":0,"columns":4,"pitch_mm":2}]})");
  expectFault("matrices[0].rows is 0, not in 1..256");
  write("hand.json", "{ // a comment\n}");
  expectFault("line 1");
  const std::string mounted =
      begin +
      R"("matrices":[{"name":"a","rows":4,"columns":4,"pitch_mm":2,"surface":{"link":"tip",)"
      R"("origin_mm":[0,0,0],"x_axis":[1,0,0],"y_axis":[0,1,0]}}],"urdf":"hand.urdf"})";
  write("hand.json", mounted);
  expectFault("hand.urdf");
  write("hand.urdf", R"(<robot name="x"><link name="base"/></robot>)");
  expectFault("matrices[0].surface.link names 'tip', which the URDF does not have");
  // Joints that form a cycle.
  const auto joint = [](const std::string& name, const std::string& from, const std::string& to) {
    return "<joint name=\"" + name + "\" type=\"fixed\"><parent link=\"" + from +
           "\"/><child link=\"" + to + "\"/></joint>";
  };
  write("hand.urdf",
        R"(<robot name="x"><link name="base"/><link name="a"/><link name="tip"/>)" +
            joint("1", "a", "tip") + joint("2", "tip", "a") + "</robot>");
  expectFault("hand.urdf");
  write("hand.urdf",
        R"(<robot name="x"><link name="base"/><link name="a"/><link name="tip"/>)" +
            joint("0", "base", "a") + joint("1", "a", "tip") + joint("2", "tip", "a") + "</robot>");
  expectFault("hand.urdf");
  // A mesh that is not there.
  write("hand.urdf",
        R"(<robot name="x"><link name="tip"><visual><geometry><mesh filename="no.stl"/></geometry>)"
        R"(</visual></link></robot>)");
  const auto expectBox = [&](const std::vector<std::string>& parts) {
    const auto result = run({"check", folder.path().string()});
    EXPECT_EQ(result.exitCode, 3) << result.err;
    EXPECT_NE(result.out.find("with geometry"), std::string::npos) << result.out;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    for (const std::string& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << part << ": " << result.err;
  };
  expectBox({"no.stl", "a box is drawn instead"});
  write("no.stl", "solid x\nfacet\nvertex 0 0 nan\n");
  expectBox({"no.stl"});
  const auto writeMesh = [&](const std::string& name) {
    write("hand.urdf",
          R"(<robot name="x"><link name="tip"><visual><geometry><mesh filename=")" + name +
              R"("/></geometry></visual></link></robot>)");
  };
  writeMesh("file:///opt/hand/tip.stl");
  expectBox({"'/opt/hand/tip.stl' is not in the folder of the hand"});
  writeMesh("package://x/tip.dae");
  write("tip.dae", "<COLLADA/>");
  expectBox({"tip.dae", "convert it to STL"});
  write("hand.urdf",
        R"(<robot name="x" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:tip/>)"
        R"(<link name="tip"/></robot>)");
  expectFault("is a xacro that is not expanded");
}

TEST(HandsCommand, WrongUse) {
  EXPECT_EQ(run({"check"}).exitCode, 2);
  EXPECT_EQ(run({"chek", "x"}).exitCode, 2);
  EXPECT_EQ(run({"check", "x", "--json"}).exitCode, 2);
}

}  // namespace
}  // namespace palpate::testing::hands_command_test
