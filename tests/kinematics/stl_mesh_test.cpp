#include "palpate/kinematics/stl_mesh.h"

#include <cstdint>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::testing::stl_mesh_test {
namespace {

const std::string kText =
    "solid cube\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 1.5e0\n   vertex 2 0 1.5\n"
    "   vertex 0 -3 1.5\n  endloop\n endfacet\nendsolid cube\n";

// A binary file with one triangle, by the definition of the format: 80 bytes, a count, and per
// triangle a normal, three corners (all float) and two bytes.
std::string binaryOf(std::uint32_t count, const std::vector<float>& corners) {
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid");  // as some programs begin a binary file, too
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t i = 0; i < corners.size(); i += 9) {
    bytes.append(12, '\0');
    bytes.append(reinterpret_cast<const char*>(corners.data() + i), 36);
    bytes.append(2, '\0');
  }
  return bytes;
}

class StlMesh : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& bytes) const {
    const std::filesystem::path path = folder_.path() / "a.stl";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  TemporaryFolder folder_;
};

TEST_F(StlMesh, ReadsTextAndBinary) {
  const std::vector<float> corners = {0, 0, 1.5F, 2, 0, 1.5F, 0, -3, 1.5F};
  for (const std::string& bytes : {kText, binaryOf(1, corners)}) {
    const std::vector<StlTriangle> mesh = readStl(write(bytes));
    ASSERT_EQ(mesh.size(), 1u);
    EXPECT_EQ(mesh[0][0], Eigen::Vector3f(0, 0, 1.5F));
    EXPECT_EQ(mesh[0][1], Eigen::Vector3f(2, 0, 1.5F));
    EXPECT_EQ(mesh[0][2], Eigen::Vector3f(0, -3, 1.5F));
  }
}

TEST_F(StlMesh, RefusesWhatIsNoMesh) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(readStl(folder_.path() / "none.stl"), FileError);
  ASSERT_EQ(::mkfifo((folder_.path() / "fifo.stl").c_str(), 0600), 0);
  EXPECT_THROW(readStl(folder_.path() / "fifo.stl"), FileError);
  EXPECT_THROW(readStl(write("")), FormatError);
  EXPECT_THROW(readStl(write("no mesh")), FormatError);
  EXPECT_THROW(readStl(write(binaryOf(1, {0, 0, nan, 0, 0, 0, 0, 0, 0}))), FormatError);
  EXPECT_THROW(readStl(write("solid\nfacet\nvertex 0 0\nendfacet\n")), FormatError);
  EXPECT_THROW(readStl(write("solid\nfacet\nvertex 0 0 inf\nendfacet\n")), FormatError);
  EXPECT_THROW(readStl(write("solid\nfacet\nvertex 0 0 0\nendfacet\n")), FormatError);
}

}  // namespace
}  // namespace palpate::testing::stl_mesh_test
