// Reads the triangles of an STL file, binary or text: the shape of a link in a URDF.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace palpate {

// Corners of one triangle, counter-clockwise seen from outside, in the file's unit.
using StlTriangle = std::array<Eigen::Vector3f, 3>;

// Throws FileError, and FormatError for a file that is not an STL file: a wrong length,
// numbers that are not finite, more than a million triangles.
std::vector<StlTriangle> readStl(const std::filesystem::path& path);

}  // namespace palpate
