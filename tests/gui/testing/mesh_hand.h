// A pad of 4x4 taxels with a body that a file describes: a triangle 300 mm wide.
#pragma once

#include <filesystem>

#include <palpate/model/hand_file.h>

#include "testing/testing.h"

namespace palpate::gui {

inline void writeMesh(const std::filesystem::path& folder) {
  testing::writeFile(folder / "body.stl",
                     "solid body\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0.3 0 0\n"
                     "vertex 0 0.3 0\nendloop\nendfacet\nendsolid body\n");
}

// Without the file of the mesh.
inline HandDescription meshHand(const std::filesystem::path& folder) {
  testing::writeFile(
      folder / "hand.json",
      R"({"format":"palpate-hand","version":1,"name":"meshed","full_scale":100,)"
      R"("urdf":"hand.urdf","matrices":[{"name":"a","rows":4,"columns":4,"pitch_mm":2,)"
      R"("surface":{"link":"tip","origin_mm":[0,0,0],"x_axis":[1,0,0],"y_axis":[0,1,0]}}]})");
  testing::writeFile(
      folder / "hand.urdf",
      R"(<robot name="x"><link name="tip"><visual><geometry><mesh filename="body.stl"/>)"
      R"(</geometry></visual></link></robot>)");
  return readHandFolder(folder);
}

}  // namespace palpate::gui
