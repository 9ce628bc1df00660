// Reads the triangles of an STL file, binary or text: the shape of a link in a URDF.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <palpate/kinematics/geometry_description.h>

namespace palpate {

// Corners of one triangle, counter-clockwise seen from outside, in the file's unit.
using StlTriangle = std::array<Eigen::Vector3f, 3>;

// Throws FileError, and FormatError for a file that is not an STL file: a wrong length,
// numbers that are not finite, more than a million triangles.
std::vector<StlTriangle> readStl(const std::filesystem::path& path);

// Why each mesh of a hand that can't be read can't, a line each, and what to do. Only the looks of
// the hand need them: a box is drawn in their place.
std::vector<std::string> meshFaults(const GeometryDescription& hand);

}  // namespace palpate
