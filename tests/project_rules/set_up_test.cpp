// What the scripts say where a machine lacks something, in one line each, and that the next call
// goes on.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "project_rules/scripts_checkout.h"
#include "project_rules/source_tree.h"

namespace palpate::testing::set_up_test {
namespace {
namespace fs = std::filesystem;

class ScriptsSetUp : public Scripts {
 protected:
  // The message that a failed call ends with.
  static std::string lastLine(const ProgramResult& result) {
    const auto lines = linesOf(result.err);
    return lines.empty() ? "" : lines.back();
  }
  // Expects that scripts/run failed, printed nothing, and that its last line begins with `begin`.
  void expectFailure(const ProgramResult& result, const std::string& begin) {
    EXPECT_EQ(result.exitCode, 1) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(lastLine(result).starts_with("palpate: " + begin)) << result.err;
  }
  // A command of shell: succeeds where a file of this name was made by another stand-in.
  std::string is(const std::string& name) const {
    return "[ -f '" + (folder_ / name).string() + "' ]";
  }
  std::string make(const std::string& name) const {
    return "touch '" + (folder_ / name).string() + "'";
  }
};

TEST_F(ScriptsSetUp, FailureOfAptNamesThePackagesAndStopsTheRun) {
  standInApt("echo 'E: no archive'; exit 100");
  const ProgramResult result = call("run", {"info"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("E: no archive"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--no-install-recommends second"), std::string::npos) << result.err;
  EXPECT_EQ(logged(), "");
}

TEST_F(ScriptsSetUp, WithoutAptTheMessageSaysWhatToDo) {
  fs::remove(tools_ / "apt-get");
  const ProgramResult result = call("run", {"info"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.err.find("PALPATE_PACKAGES=keep"), std::string::npos) << result.err;
  EXPECT_EQ(call("run", {"info"}, {{"PALPATE_PACKAGES", "keep"}}).exitCode, 3);
}

TEST_F(ScriptsSetUp, OrdinaryUsersInstallWithSudoOrAreToldHow) {
  standIn("id", "echo 1000");
  const ProgramResult without = call("run", {"info"});
  EXPECT_EQ(without.exitCode, 1);
  EXPECT_NE(without.err.find("there is no sudo"), std::string::npos) << without.err;
  standIn("sudo", log("sudo"));
  EXPECT_EQ(call("run", {"info"}).exitCode, 3);
  EXPECT_TRUE(logged().starts_with("sudo ")) << logged();
}

TEST_F(ScriptsSetUp, FailedBuildStopsTheRun) {
  standIn("ninja", "echo 'x.cpp:1: error: no'; exit 1");
  const ProgramResult result = call("run", {"info"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("error: no"), std::string::npos) << result.err;
}

// ---- Packages

const char kPlan[] =
    "0 upgraded, 319 newly installed, 0 to remove and 0 not upgraded.\\n"
    "Need to get 12.4 MB/245 MB of archives.\\n"
    "After this operation, 1,211 MB of additional disk space will be used.\\n";

TEST_F(ScriptsSetUp, SaysHowMuchItInstallsAndHowLongThatTookTheLastTime) {
  standInApt(log("apt-get"), kPlan);
  writeFile(checkout_ / "cmake/first_time.txt",
            "cores 8\npackages_minutes 3\nprogram_minutes 7\nprogram_mb 9\n");
  const ProgramResult result = call("run", {"info"});
  EXPECT_NE(
      result.err.find("installing 1 packages and what they need (319 together, 12 MB to fetch, "
                      "1211 MB on disk; 3 min the last time): second\n"),
      std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("from nothing: 7 min on 8 cores"), std::string::npos) << result.err;
}

TEST_F(ScriptsSetUp, TooLittleSpaceForPackagesIsToldBeforeAnyIsInstalled) {
  standInApt(log("apt-get"), kPlan);
  standIn("stat", "case \"$1\" in -f) echo 1200 1000000;; *) echo 1;; esac");  // 1200 MB are free
  expectFailure(call("run"),
                "not enough space: the packages take 1223 MB in /usr, 1200 MB are free there.");
  EXPECT_EQ(logged(), "");
  // Where what is fetched lies on another file system, 1211 MB and 12 MB are asked for by
  // themselves.
  standIn("stat",
          "case \"$1 $4\" in '-f /var'*) echo 13 1000000;; '-f '*) echo 1211 1000000;; "
          "*) echo \"$3\";; esac");
  writeFile(checkout_ / "cmake/first_time.txt", "");
  const ProgramResult enough = call("run");
  EXPECT_EQ(enough.exitCode, 3) << enough.err;
}

TEST_F(ScriptsSetUp, SpaceThatRunsOutWhilePackagesAreInstalledIsNamed) {
  standInApt("echo 'cannot copy extracted data: No space left on device'; exit 100");
  expectFailure(call("run"), "no space left for the packages");
}

TEST_F(ScriptsSetUp, MissingNetworkIsNamed) {
  standInApt(log("apt-get") +
             "echo \"E: Failed to fetch http://x Temporary failure resolving 'deb.debian.org'\"; "
             "exit 100");
  expectFailure(call("run"), "no network: Temporary failure resolving 'deb.debian.org'.");
  EXPECT_EQ(linesOf(logged()).size(), 1u) << "tried again: " << logged();
}

// apt-get update succeeds without a network; then no package is known.
TEST_F(ScriptsSetUp, MissingNetworkIsNamedWhereNoPackageListsAreThere) {
  standInApt("echo \"W: Temporary failure resolving 'deb.debian.org'\"",
             "E: Unable to locate package second\\n");
  expectFailure(call("run"), "no network: Temporary failure resolving 'deb.debian.org'.");
}

TEST_F(ScriptsSetUp, InterruptedInstallationIsFinishedFirst) {
  standIn("dpkg", log("dpkg") + make("mended"));
  standInApt(log("apt-get") + is("mended") +
             " || { echo \"E: dpkg was interrupted, you must manually run 'dpkg --configure -a'\"; "
             "exit 100; }");
  const ProgramResult result = call("run", {"info"});
  EXPECT_EQ(result.exitCode, 3) << result.err;
  const auto lines = linesOf(logged());
  ASSERT_GE(lines.size(), 4u) << logged();
  EXPECT_TRUE(lines[1].starts_with("dpkg ") && lines[1].ends_with("--configure -a")) << lines[1];
  EXPECT_TRUE(lines[2].ends_with("-f install")) << lines[2];
  EXPECT_TRUE(lines[3].ends_with("--no-install-recommends second")) << lines[3];
}

TEST_F(ScriptsSetUp, InstallationThatCannotBeFinishedIsNotTriedForever) {
  standIn("dpkg", "exit 1");
  standInApt(
      "echo \"E: dpkg was interrupted, you must manually run 'dpkg --configure -a'\"; exit 100");
  expectFailure(call("run"), "apt-get failed");
}

TEST_F(ScriptsSetUp, RefusalOfSudoIsPassedOn) {
  standIn("id", "echo 1000");
  standIn("sudo", "echo 'sudo: a password is required' >&2; exit 1");
  expectFailure(call("run"), "sudo: a password is required; as root: apt-get install");
}

TEST_F(ScriptsSetUp, OtherSystemIsToldWhatItLacksBeforeAnythingIsInstalled) {
  writeFile(folder_ / "os-release", "ID=ubuntu\nVERSION_ID=\"22.04\"\n");
  writeFile(checkout_ / "cmake/debian-packages.txt",
            "first  # at least 3.25\nsecond\nthird  # at least 12\n");
  standIn("dpkg-query", "exit 1");
  standIn("apt-cache",
          "case $2 in first) echo '  Candidate: 3.22.1-1ubuntu1';; *) echo '  Candidate: "
          "4:12.2.0-3';; esac");
  standInApt(log("apt-get"), "E: Unable to locate package second\\n");
  const ProgramResult result = call("run");
  expectFailure(result,
                "this is ubuntu 22.04, not Debian 12, and nothing was installed: it has no second; "
                "first 3.22.1-1ubuntu1 (wanted: 3.25);");
  EXPECT_EQ(logged(), "apt-get -q -y -o DPkg::Lock::Timeout=300 update\n");
}

TEST_F(ScriptsSetUp, OtherSystemWhereAnotherPackageProvidesWhatIsAskedForInstallsNothing) {
  writeFile(folder_ / "os-release", "ID=debian\nVERSION_ID=\"13\"\n");
  standIn("dpkg-query",
          "case \"$*\" in *Provides*) echo 'installed, other (= 6), second (= 6)';; "
          "*) echo 'installed first'; exit 1;; esac");
  EXPECT_EQ(call("run").exitCode, 3);
  EXPECT_EQ(logged().find("apt-get"), std::string::npos) << logged();
}

// The versions that other systems are asked for are those that CMake asks for.
TEST_F(ScriptsSetUp, VersionsOfPackageListAreThoseOfCMake) {
  const std::map<std::string, std::string> asked = {
      {"cmake", "CMakeLists.txt:cmake_minimum_required(VERSION "},
      {"libboost-program-options-dev", "CMakeLists.txt:find_package(Boost "},
      {"libceres-dev", "CMakeLists.txt:find_package(Ceres "},
      {"libcgal-dev", "CMakeLists.txt:find_package(CGAL "},
      {"libeigen3-dev", "CMakeLists.txt:find_package(Eigen3 "},
      {"nlohmann-json3-dev", "CMakeLists.txt:find_package(nlohmann_json "},
      {"pybind11-dev", "apps/python/CMakeLists.txt:find_package(pybind11 "},
      {"python3-dev", "apps/python/CMakeLists.txt:find_package(Python "},
      {"qt6-base-dev", "apps/palpate/CMakeLists.txt:find_package(Qt6 "},
      {"g++", "cmake/PalpateCompiler.cmake:CMAKE_CXX_COMPILER_VERSION VERSION_LESS "}};
  std::size_t found = 0;
  const std::string atLeast = "  # at least ";
  for (const std::string& line : linesOf(readFile(projectFolder() / "cmake/debian-packages.txt"))) {
    const std::size_t end = line.find(atLeast);
    if (end == std::string::npos) continue;
    const auto at = asked.find(line.substr(0, end));
    ASSERT_NE(at, asked.end()) << line;
    ++found;
    const std::size_t colon = at->second.find(':');
    const std::string text = readFile(projectFolder() / at->second.substr(0, colon));
    const std::string wanted = at->second.substr(colon + 1) + line.substr(end + atLeast.size());
    const std::size_t place = text.find(wanted);
    ASSERT_NE(place, std::string::npos) << at->second.substr(0, colon) << " lacks " << wanted;
    const char behind = text[place + wanted.size()];
    EXPECT_TRUE(behind == ' ' || behind == ')')
        << line << ", but CMake asks for " << wanted << behind;
  }
  EXPECT_EQ(found, asked.size());
}

// ---- Configuring and building

TEST_F(ScriptsSetUp, ToolsThatAreMissingOrTooOldAreNamedBeforeTheyAreCalled) {
  writeFile(checkout_ / "cmake/debian-packages.txt", "first\ncmake  # at least 3.25\n");
  standIn("dpkg-query", "echo 'installed first'; echo 'installed cmake'");
  standIn("cmake", "echo cmake version 3.22.1");
  expectFailure(call("run"), "cmake 3.22.1 is too old: 3.25 or newer is wanted");
  fs::remove(tools_ / "cmake");
  expectFailure(call("run"), "cmake is missing");
}

TEST_F(ScriptsSetUp, ReasonOfCMakeIsTheLastLine) {
  standIn("cmake",
          "[ \"$1\" != --version ] || exit 0\n"
          "printf -- '-- Found X\\nCMake Error at CMakeLists.txt:9 (find_package):\\n  Could not "
          "find Qt6 that\\n"
          "  suits 6.4.\\n\\n  More.\\n'; exit 1");
  expectFailure(call("run"), "configuring failed: Could not find Qt6 that suits 6.4.");
  standIn("cmake", "[ \"$1\" != --version ] || exit 0\ntouch build/release/build.ninja");
  EXPECT_EQ(call("run").exitCode, 3) << "the next call goes on";
}

TEST_F(ScriptsSetUp, TooLittleSpaceForTheBuildIsToldBefore) {
  standIn("stat", "case \"$1\" in -f) echo 30 1000000;; *) echo 1;; esac");
  writeFile(checkout_ / "cmake/first_time.txt", "program_mb 400\ntests_mb 900\n");
  expectFailure(call("run"), "not enough space: the files of the build take ");
  EXPECT_EQ(logged().find("ninja"), std::string::npos) << logged();
}

TEST_F(ScriptsSetUp, SpaceThatRunsOutWhileBuildingIsNamedAndTheNextCallGoesOn) {
  writeFile(checkout_ / "cmake/first_time.txt", "");
  standIn("stat",
          "case \"$1\" in -f) " + is("full") +
              " && echo 1 1000000 || echo 900 1000000;; *) echo 1;; esac");
  const std::string ninja = readFile(tools_ / "ninja");
  standIn("ninja",
          "case \"$*\" in *' -n '*) exit 0;; esac\n" + make("full") +
              "; echo 'No space left on device'; exit 1");
  standIn("dpkg-query", "echo 'installed first'; echo 'installed second'");
  expectFailure(call("run"), "no space left in ");
  fs::remove(folder_ / "full");
  standIn("ninja", ninja);
  EXPECT_EQ(call("run").exitCode, 3);
  EXPECT_EQ(logged().find("cmake"), std::string::npos) << "configured anew: " << logged();
}

TEST_F(ScriptsSetUp, SmallFolderOfTemporaryFilesIsNotUsedByTheBuild) {
  const fs::path small = folder_ / "small";
  fs::create_directories(small);
  standIn(
      "stat",
      "case \"$4\" in '" + small.string() + "') echo 60 1000000;; *) echo 900000 1000000;; esac");
  standIn("ninja",
          "case \"$*\" in *' -n '*) exit 0;; esac\necho \"$TMPDIR\" >> '" +
              (folder_ / "log").string() +
              "'; printf '#!/bin/sh\\nprintf %%s \"$TMPDIR\"\\n' > \"$2/palpate\"; chmod +x "
              "\"$2/palpate\"");
  const ProgramResult result = call("run", {"info"}, {{"TMPDIR", small.string()}});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(logged().find((checkout_ / "build/tmp").string() + "\n"), std::string::npos)
      << logged();
  EXPECT_EQ(result.out, small.string()) << "the program's own folder";
  EXPECT_NE(result.err.find(small.string() + " can't be used or is small (60 MB free)"),
            std::string::npos)
      << result.err;
  fs::remove_all(checkout_ / "build");
  const ProgramResult missing = call("run", {"info"}, {{"TMPDIR", "/no/such/folder"}});
  EXPECT_EQ(missing.exitCode, 0) << missing.err;
}

TEST_F(ScriptsSetUp, CacheOfTheCompilerMovesIntoTheBuildWhereHomeIsReadOnly) {
  standIn("ccache", "echo /proc/none/ccache");  // nobody writes there, root neither
  standIn("ninja",
          "case \"$*\" in *' -n '*) exit 0;; esac\necho \"cache $CCACHE_DIR\" >> '" +
              (folder_ / "log").string() + "'; exit 1");
  call("run");
  EXPECT_NE(logged().find("cache " + (checkout_ / "build/ccache").string()), std::string::npos)
      << logged();
  standIn("ccache", "echo '" + (folder_ / "cache").string() + "'");
  call("run");
  EXPECT_NE(logged().find("cache \n"), std::string::npos) << logged();
}

TEST_F(ScriptsSetUp, CheckoutThatCannotBeWrittenIsNamed) {
  writeFile(checkout_ / "build", "");  // no folder can be made there
  expectFailure(call("run"), "can't write to " + (checkout_ / "build").string());
}

// ---- What is shown

TEST_F(ScriptsSetUp, BuildShowsALinePerTenthAndEverythingThatIsNoProgress) {
  standIn("ninja",
          "case \"$*\" in *' -n '*) echo '[1/40] x'; echo '[40/40] x'; exit 0;; esac\n"
          "i=1; while [ $i -le 40 ]; do echo \"[$i/40] Building x$i\"; i=$((i + 1)); done\n"
          "echo 'FAILED: x'; echo 'x.cpp:1: error: no'; exit 1");
  const ProgramResult result = call("run");
  expectFailure(result, "the build failed");
  EXPECT_NE(result.err.find("building build/release, 40 steps"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("Building x"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("palpate: 20 of 40 steps\n"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("FAILED: x\nx.cpp:1: error: no\n"), std::string::npos) << result.err;
  const std::string log = readFile(checkout_ / "build/release/build.log");
  EXPECT_NE(log.find("[17/40] Building x17"), std::string::npos) << log;
}

// script (bsdutils) gives its command a terminal.
TEST_F(ScriptsSetUp, TerminalIsLeftToNinjaWhichWritesOneLine) {
  standIn("ninja",
          "case \"$*\" in *' -n '*) exit 0;; esac\n[ -t 1 ] && echo \"on a terminal: "
          "$NINJA_STATUS|\"; exit 1");
  fs::create_directories(folder_ / "elsewhere");
  const ProgramResult result =
      runProgram("/usr/bin/script",
                 {"-qec", "'" + (checkout_ / "scripts/run").string() + "' info", "/dev/null"},
                 {{"PATH", tools_.string()},
                  {"SHELL", "/bin/sh"},
                  {"PALPATE_PACKAGES", ""},
                  {"PALPATE_OS_RELEASE", (folder_ / "os-release").string()}});
  EXPECT_NE(result.out.find("on a terminal: palpate: %f of %t  |"), std::string::npos)
      << result.out;
}

TEST_F(ScriptsSetUp, AfterABuildItSaysWhatToTryNextAndNeverOnStandardOutput) {
  const ProgramResult built = call("run", {"info"});
  EXPECT_NE(built.err.find("To try next:"), std::string::npos) << built.err;
  EXPECT_EQ(built.out, (folder_ / "elsewhere").string() + "\n[info]");
  standIn("dpkg-query", "echo 'installed first'; echo 'installed second'");
  EXPECT_EQ(call("run", {"info"}).err, "");
}

TEST_F(ScriptsSetUp, WithoutAStandardErrorItWorksAsWell) {
  const ProgramResult result =
      runProgram("/bin/bash",
                 {"-c", "exec \"$0\" info 2>&-", (checkout_ / "scripts/run").string()},
                 {{"PATH", tools_.string()},
                  {"PALPATE_PACKAGES", ""},
                  {"PALPATE_OS_RELEASE", (folder_ / "os-release").string()}});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_TRUE(result.out.ends_with("\n[info]")) << result.out;
}

TEST_F(ScriptsSetUp, StagesAndTheirSecondsAreWrittenDown) {
  call("run", {"info"}, {{"PALPATE_TIMES", (folder_ / "times").string()}});
  const auto lines = linesOf(readFile(folder_ / "times"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(lines[0].starts_with("packages ")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("configuring ")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("building ")) << lines[2];
}

// ---- The trial on an empty machine

TEST_F(ScriptsSetUp, TrialThatCannotBeginSaysSoInItsLastLine) {
  const std::string count = "0 passed, 1 failed, 0 skipped\n";
  writeFile(folder_ / "file", "");
  const ProgramResult place = call("../cmake/fresh_machine",
                                   {(folder_ / "file/trial").string()},
                                   {{"PALPATE_PACKAGES", "keep"}});
  EXPECT_EQ(place.exitCode, 1);
  EXPECT_EQ(place.out, count) << place.err;
  EXPECT_NE(place.err.find("can't make "), std::string::npos) << place.err;

  fs::create_directories(folder_ / "trial");
  const int lock = ::open((folder_ / "trial/.lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  const ProgramResult other = call(
      "../cmake/fresh_machine", {(folder_ / "trial").string()}, {{"PALPATE_PACKAGES", "keep"}});
  ::close(lock);
  EXPECT_EQ(other.exitCode, 1);
  EXPECT_EQ(other.out, count) << other.err;
  EXPECT_NE(other.err.find("another trial runs"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace palpate::testing::set_up_test
