// Reads a URDF: the tree of links and joints of a hand. A wrapper, so that only one source file
// includes the URDF library.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "palpate/kinematics/geometry_description.h"

namespace palpate {

struct UrdfJoint {
  enum class Kind { kFixed, kRevolute, kPrismatic };
  std::string name;
  Kind kind = Kind::kFixed;
  // The frame of the joint in the frame of its parent link [mm]; its z axis is the joint's axis.
  Eigen::Isometry3d parentFromJoint = Eigen::Isometry3d::Identity();
  // The frame of the child link in the frame of the joint while the joint is at 0.
  Eigen::Isometry3d jointFromChild = Eigen::Isometry3d::Identity();
  // The joint that this one follows: value = multiplier * its value + offset [deg or mm].
  std::string mimics;  // empty: none
  double multiplier = 1.0;
  double offset = 0.0;
};

struct UrdfLink {
  std::string name;
  std::optional<std::size_t> parent;  // index of the parent link; empty: the root
  UrdfJoint joint;                    // moves this link against its parent; unused for the root
  std::vector<std::size_t> children;  // in the order of the file's names
  std::vector<LinkShape> shapes;      // `place` is not set
};

// The links of a URDF; the first one is the root, and parents come before their children.
using UrdfTree = std::vector<UrdfLink>;

// Throws FormatError with `source` for what is no valid URDF: XML that is not well-formed (with its
// place), links or joints that are missing or form a cycle, numbers that are not finite, joint
// types that a hand does not have. `folder` is where relative names of meshes begin.
UrdfTree readUrdf(const std::string& text,
                  const std::filesystem::path& source,
                  const std::filesystem::path& folder);

}  // namespace palpate
