// What the built programs load: Qt 6 only, and the core library none of it.
#include "testing/program.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "palpate/recording/hdf5_program.h"

#include "testing/testing.h"

namespace palpate::testing::program_test {
namespace {

std::string librariesOf(const std::string& program) {
  const ProgramResult result = runProgram("/usr/bin/ldd", {program});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return result.out;
}

TEST(Program, LoadsNoQt5) {
  const std::string program = PALPATE_PROGRAM;
  if (program.empty()) GTEST_SKIP() << "built without the program (PALPATE_APPS=OFF)";
  const std::string libraries = librariesOf(program + "_window");
  EXPECT_NE(libraries.find("libQt6Widgets"), std::string::npos) << libraries;
  EXPECT_EQ(libraries.find("Qt5"), std::string::npos) << libraries;
  EXPECT_EQ(libraries.find("opencv_highgui"), std::string::npos) << libraries;
  EXPECT_EQ(libraries.find("not found"), std::string::npos) << libraries;
}

// So that a command without a window starts in a few milliseconds. These libraries bring more than
// sixty others.
TEST(Program, WithoutAWindowLoadsNeitherQtNorOpenCvNorCeresNorHdf5) {
  const std::string program = PALPATE_PROGRAM;
  if (program.empty()) GTEST_SKIP() << "built without the program (PALPATE_APPS=OFF)";
  const std::string libraries = librariesOf(program);
  EXPECT_NE(libraries.find("libbz2"), std::string::npos) << libraries;
  for (const char* name :
       {"libQt", "opencv", "ceres", "glog", "lapack", "libGL", "hdf5", "libcurl", "not found"})
    EXPECT_EQ(libraries.find(name), std::string::npos) << name << "\n" << libraries;
}

// HDF5 is read by a program of its own: it loads the library, and nothing of the window.
TEST(Program, Hdf5IsReadByAProgramOfItsOwn) {
  const std::string libraries = librariesOf(hdf5Program());
  EXPECT_NE(libraries.find("libhdf5"), std::string::npos) << libraries;
  for (const char* name : {"libQt", "opencv", "libsqlite3", "not found"})
    EXPECT_EQ(libraries.find(name), std::string::npos) << name << "\n" << libraries;
}

// This test links the whole core library.
TEST(Program, CoreLibraryLoadsNoQt) {
  const std::string libraries = librariesOf(std::filesystem::read_symlink("/proc/self/exe"));
  EXPECT_NE(libraries.find("libc.so"), std::string::npos) << libraries;
  EXPECT_EQ(libraries.find("libQt"), std::string::npos) << libraries;
}

}  // namespace
}  // namespace palpate::testing::program_test
