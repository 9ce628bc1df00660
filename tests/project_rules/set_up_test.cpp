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
  EXPECT_NE(result.err.find("satisfy --no-install-recommends 'first' 'second'"), std::string::npos)
      << result.err;
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
  writeFile(checkout_ / "cmake/first_time.txt", "cores 8\nprogram_minutes 7\n");
  const ProgramResult result = call("run", {"info"});
  EXPECT_NE(
      result.err.find("installing packages: 319, 12.4 MB/245 MB to fetch, 1,211 MB on disk\n"),
      std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("from nothing: 7 min on 8 cores"), std::string::npos) << result.err;
}

TEST_F(ScriptsSetUp, TooLittleSpaceForPackagesIsNamed) {
  for (const char* said : {"cannot copy extracted data: No space left on device",
                           "You do not have enough free space in /var/cache/apt/archives/."}) {
    standInApt("echo 'E: " + std::string(said) + "'; exit 100");
    expectFailure(call("run"), "no space left for the packages");
  }
  // Where the log itself can't be written.
  standInApt("exit 100");
  standIn("stat", "echo 1 1000000");
  expectFailure(call("run"), "no space left for the packages: 1 MB are free");
}

TEST_F(ScriptsSetUp, AnotherInstallationThatRunsIsNamed) {
  standInApt("echo 'E: Could not get lock /var/lib/dpkg/lock-frontend'; exit 100");
  expectFailure(call("run"), "another program installs packages at the moment");
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
             "E: Unable to locate package second\\n",
             100);
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
  EXPECT_TRUE(lines[3].ends_with("--no-install-recommends first second")) << lines[3];
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
  expectFailure(call("run"), "sudo: a password is required; as root: apt-get satisfy");
}

// As apt 2.6 writes it.
TEST_F(ScriptsSetUp, OtherSystemIsToldWhatItLacksBeforeAnythingIsInstalled) {
  writeFile(folder_ / "os-release", "ID=ubuntu\nVERSION_ID=\"22.04\"\nVERSION_CODENAME=jammy\n");
  writeFile(checkout_ / "cmake/debian-packages.txt", "first  # at least 3.25\nsecond\n");
  standInApt(log("apt-get"),
             "The following packages have unmet dependencies:\\n"
             " satisfy:command-line : Depends: second but it is not installable\\n"
             "                        Depends: first (>= 3.25) but 3.22.1 is to be installed\\n",
             100);
  expectFailure(call("run"),
                "this system (ubuntu 22.04 jammy) lacks: second but it is not installable; "
                "first (>= 3.25) but 3.22.1 is to be installed. ");
  EXPECT_EQ(logged(), "apt-get -q -y -o DPkg::Lock::Timeout=300 update\n");
}

TEST_F(ScriptsSetUp, PackagesOfOtherReleasesAreLeftOut) {
  writeFile(checkout_ / "cmake/debian-packages.txt",
            "first  # at least 4:12\nsecond [bookworm]  # why\nthird [trixie]\n");
  call("run");
  EXPECT_NE(logged().find("--no-install-recommends first (>= 4:12) second\n"), std::string::npos)
      << logged();
  writeFile(folder_ / "os-release", "ID=debian\nVERSION_ID=\"13\"\nVERSION_CODENAME=trixie\n");
  const ProgramResult moved = call("run");
  EXPECT_NE(logged().find("--no-install-recommends first (>= 4:12) third\n"), std::string::npos)
      << logged();
  // A home that moved with its build folder to another release.
  EXPECT_NE(
      moved.err.find("build/release was made elsewhere (debian 12 bookworm): building anew\n"),
      std::string::npos)
      << moved.err;
}

TEST_F(ScriptsSetUp, NothingIsInstalledWhereNothingIsMissing) {
  standInApt(log("apt-get"), "", 0);
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
    std::string version = line.substr(end + atLeast.size());
    if (const std::size_t epoch = version.find(':'); epoch != std::string::npos)
      version.erase(0, epoch + 1);
    const std::string wanted = at->second.substr(colon + 1) + version;
    const std::size_t place = text.find(wanted);
    ASSERT_NE(place, std::string::npos) << at->second.substr(0, colon) << " lacks " << wanted;
    const char behind = text[place + wanted.size()];
    EXPECT_TRUE(behind == ' ' || behind == ')')
        << line << ", but CMake asks for " << wanted << behind;
  }
  EXPECT_EQ(found, asked.size());
}

// ---- Configuring and building

TEST_F(ScriptsSetUp, ToolsThatAreMissingOrTooOldAreNamed) {
  standIn("cmake",
          "[ \"$1\" != --version ] || { echo cmake version 3.22.1; exit 0; }\n"
          "echo 'CMake Error: Could not read presets: Unrecognized \"version\" field'; exit 1");
  expectFailure(call("run"), "cmake version 3.22.1 is too old: Debian 12 has 3.25");
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

TEST_F(ScriptsSetUp, SpaceThatRunsOutWhileBuildingIsNamedAndTheNextCallGoesOn) {
  writeFile(checkout_ / "cmake/first_time.txt", "");
  standIn("stat",
          "case \"$1\" in -f) " + is("full") +
              " && echo 1 1000000 || echo 900 1000000;; *) echo 1;; esac");
  const std::string ninja = readFile(tools_ / "ninja");
  standIn("ninja",
          "case \"$*\" in *' -n '*) exit 0;; esac\n" + make("full") +
              "; echo 'No space left on device'; exit 1");
  expectFailure(call("run"), "no space left for the build: 1 MB are free in ");
  fs::remove(folder_ / "full");
  standIn("ninja", ninja);
  EXPECT_EQ(call("run").exitCode, 3);
  EXPECT_EQ(logged().find("cmake"), std::string::npos) << "configured anew: " << logged();
}

TEST_F(ScriptsSetUp, CheckoutThatCannotBeWrittenIsNamed) {
  writeFile(checkout_ / "build", "");  // no folder can be made there
  expectFailure(call("run"), "can't write to " + (checkout_ / "build").string());
}

// ---- What is shown

TEST_F(ScriptsSetUp, BuildWithoutATerminalShowsOnlyWhatIsNoProgress) {
  standIn("ninja",
          "case \"$*\" in *' -n '*) exit 0;; *--quiet*) ;; *) echo '[1/40] Building x1';; esac\n"
          "echo 'FAILED: x'; echo 'x.cpp:1: error: no'; exit 1");
  const ProgramResult result = call("run");
  expectFailure(result, "the build failed");
  EXPECT_EQ(result.err.find("Building x"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("FAILED: x\nx.cpp:1: error: no\n"), std::string::npos) << result.err;
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
                                   {"trixie", (folder_ / "file/trial").string()},
                                   {{"PALPATE_PACKAGES", "keep"}});
  EXPECT_EQ(place.exitCode, 1);
  EXPECT_EQ(place.out, count) << place.err;
  EXPECT_NE(place.err.find("can't make "), std::string::npos) << place.err;

  fs::create_directories(folder_ / "trial");
  const int lock = ::open((folder_ / "trial/.lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  const ProgramResult other = call("../cmake/fresh_machine",
                                   {"bookworm", (folder_ / "trial").string()},
                                   {{"PALPATE_PACKAGES", "keep"}});
  ::close(lock);
  EXPECT_EQ(other.exitCode, 1);
  EXPECT_EQ(other.out, count) << other.err;
  EXPECT_NE(other.err.find("another trial runs"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace palpate::testing::set_up_test
