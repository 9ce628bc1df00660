#include "project_rules/scripts_checkout.h"

#include "project_rules/source_tree.h"

namespace palpate::testing {
namespace fs = std::filesystem;

void Scripts::SetUp() {
  checkout_ = folder_ / "a ch\u00e4ck out";
  tools_ = folder_ / "tools";
  for (const char* name : {"scripts", "cmake"}) {
    fs::create_directories(checkout_ / name);
    for (const auto& entry : fs::directory_iterator(projectFolder() / name))
      if (entry.is_regular_file())
        fs::copy_file(entry.path(), checkout_ / name / entry.path().filename());
  }
  writeFile(checkout_ / "CMakePresets.json", "{}");
  writeFile(checkout_ / "cmake/debian-packages.txt", "# a comment\nfirst  # why\n\nsecond\n");
  fs::create_directories(tools_);
  for (const char* name : {"awk",  "bash", "cat",   "chmod",  "cp",    "dirname", "env", "flock",
                           "grep", "head", "mkdir", "mktemp", "nproc", "paste",   "pwd", "readlink",
                           "rm",   "sed",  "sh",    "tail",   "tee",   "touch"})
    fs::create_symlink(
        fs::exists(fs::path("/bin") / name) ? fs::path("/bin") / name : fs::path("/usr/bin") / name,
        tools_ / name);
  standIn("id", "echo 0");
  standIn("stat", "echo 1000000 1000000");  // free blocks and their size
  writeFile(folder_ / "os-release", "ID=debian\nVERSION_ID=\"12\"\nVERSION_CODENAME=bookworm\n");
  standInApt(log("apt-get"));
  // "cmake --preset release" makes the folder, ninja the program.
  standIn("cmake",
          "[ \"$1\" != --version ] || { echo cmake version 3.25.1; exit 0; }\n" + log("cmake") +
              "touch build/release/build.ninja\n"
              "echo \"CMAKE_HOME_DIRECTORY:INTERNAL=$PWD\" > build/release/CMakeCache.txt");
  standIn("ninja",
          "case \"$*\" in *' -n '*)\n"
          "  [ ! -x \"$2/palpate\" ] || echo 'ninja: no work to do.'; exit 0;; esac\n" +
              log("ninja") + "echo compiling\n" +
              "printf '#!/bin/sh\\npwd\\nprintf \"[%%s]\" \"$@\"\\nexit 3\\n' > "
              "\"$2/palpate\"\nchmod +x \"$2/palpate\"");
}

std::string Scripts::log(const std::string& name) const {
  return "echo \"" + name + " $*\" >> '" + (folder_ / "log").string() + "'\n";
}

void Scripts::standIn(const std::string& name, const std::string& body) {
  fs::remove(tools_ / name);
  writeFile(tools_ / name, "#!/bin/sh\n" + body + "\n");
  fs::permissions(tools_ / name, fs::perms::owner_all);
}

void Scripts::standInApt(const std::string& body, const std::string& plan, int planExit) {
  standIn("apt-get",
          "case \"$*\" in *--assume-no*) printf '" + plan + "'; exit " + std::to_string(planExit) +
              ";; esac\n" + body);
}

ProgramResult Scripts::call(const std::string& script,
                            std::vector<std::string> arguments,
                            std::map<std::string, std::string> environment) {
  writeFile(folder_ / "log", "");
  fs::create_directories(folder_ / "elsewhere");
  arguments.insert(arguments.begin(),
                   {"-c",
                    "cd \"$0\" && exec \"$@\"",
                    (folder_ / "elsewhere").string(),
                    (checkout_ / "scripts" / script).string()});
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "PALPATE_PACKAGES", "PALPATE_TIMES"})
    environment.try_emplace(name, "");
  environment.try_emplace("PALPATE_WERROR", "");  // CI sets it
  environment.try_emplace("PALPATE_OS_RELEASE", (folder_ / "os-release").string());
  environment["PATH"] = tools_.string();
  return runProgram("/bin/bash", arguments, environment);
}

}  // namespace palpate::testing
