// The geometry of a hand as data: chains of joints, sensor surfaces and visible shapes on their
// links. HandGeometry computes poses from it. It is made from a hand's description (hand.json and
// URDF): describeGeometry().
//
// Frames: the hand's base frame is that of the URDF's root link (SDH-2: the palm's, z up from the
// palm). All interfaces use lengths in mm and angles in degrees.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <palpate/core/option_check.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/matrix_layout.h>

namespace palpate {

enum class JointType { kRevolute, kPrismatic };

// A joint and the link that it moves. The joint's frame coincides with the frame before it while
// the joint is at 0; the joint moves about or along its z axis.
struct ChainLink {
  // The axis of the hand that moves the link; empty: the joint rests at `offset`.
  std::optional<std::size_t> axis;
  JointType type = JointType::kRevolute;
  // Value of the joint = factor * value of the axis + offset [deg or mm].
  double factor = 1.0;
  double offset = 0.0;
  // Where the link ends (the next joint, or the tip of the finger), in the frame of its joint.
  Eigen::Isometry3d jointFromEnd = Eigen::Isometry3d::Identity();
};

// Returns a link of a standard (distal) Denavit-Hartenberg table: its joint turns by
// theta = sign * angle of the axis + offset, and the link ends at Tz(d) Tx(r) Rx(alpha).
ChainLink denavitHartenbergLink(std::optional<std::size_t> axis,
                                double sign,
                                double offsetDeg,
                                double dMm,
                                double rMm,
                                double alphaDeg);

// A chain of links from the base frame to a tip. Links that several fingers have in common (a
// wrist, for example) are listed in each of them.
struct Finger {
  std::string name;                                  // name of its last link
  Eigen::Vector3d baseMm = Eigen::Vector3d::Zero();  // first joint in the base frame [mm]
  Eigen::Matrix3d baseRotation = Eigen::Matrix3d::Identity();
  std::vector<ChainLink> links;
};

// A place in the hand: the end of link `link` of a finger, or the base frame.
struct LinkPlace {
  std::size_t finger = 0;
  std::optional<std::size_t> link;  // empty: the base frame
  bool operator==(const LinkPlace&) const = default;
};

// The surface of one matrix. Its frame has its origin at the centre of taxel (0, 0), x along rising
// columns, y along rising rows, and z into the body, so that -z is the outward normal. Column x,
// row y are at (pitch.x x, pitch.y y, 0), and, from row `bendRow` on towards row 0, on a cylinder
// that continues this plane:
//   a = (bendRow - y) pitch.y / radius,
//   (pitch.x x, pitch.y bendRow - radius sin a, radius (1 - cos a)).
struct SensorSurface {
  LinkPlace place;
  Eigen::Isometry3d linkFromSurface = Eigen::Isometry3d::Identity();
  std::optional<double> bendRow;  // empty: flat
  double radiusMm = 0.0;          // radius of the bend [mm]
  // When the surface is neither flat nor a cylinder: positions [mm] and outward normals of all
  // places in the frame of the link, row by row; otherwise empty.
  std::vector<Eigen::Vector3d> positionsMm = {};
  std::vector<Eigen::Vector3d> normals = {};
};

// A visible shape of a link (URDF: visual).
struct LinkShape {
  enum class Kind { kBox, kCylinder, kSphere, kMesh };
  LinkPlace place;
  Eigen::Isometry3d linkFromShape = Eigen::Isometry3d::Identity();
  Kind kind = Kind::kBox;
  // Box: its three lengths; cylinder (about z): diameter, diameter, length; sphere: its diameter
  // three times [mm]. Mesh: factors by which the file's coordinates become mm.
  Eigen::Vector3d sizeMm = Eigen::Vector3d::Ones();
  std::filesystem::path mesh;  // file of a mesh (STL); empty: meshFault says why there is none
  std::string meshFault = {};  // "'/a/b.stl' is not in the folder of the hand"
};

// A link of the hand's URDF.
struct NamedLink {
  std::string name;
  std::optional<std::size_t> parent;  // index of its parent link; empty: the root
  LinkPlace place;
  // The frame that the URDF gives the link, in the frame of its place.
  Eigen::Isometry3d placeFromLink = Eigen::Isometry3d::Identity();
};

// The geometry of a whole hand.
struct GeometryDescription {
  std::size_t numAxes = 0;
  std::vector<Finger> fingers;
  std::vector<SensorSurface> surfaces;  // one per matrix
  SensorLayout layout;
  std::vector<LinkShape> shapes = {};  // may be empty
  // All links of the URDF, the root first, parents before their children; empty without a URDF.
  std::vector<NamedLink> links = {};

  // Throws std::invalid_argument that names the inconsistency (an axis or link that does not exist,
  // a value that is not finite, and so on).
  void validate() const;
};

// A row of a sensor surface that is flat or bent, in the surface's frame: where its line of taxels
// crosses x = 0, and the outward normal there.
struct SurfaceRow {
  double yMm = 0.0, zMm = 0.0;
  double normalY = 0.0, normalZ = -1.0;
};
// Returns the surface at any row, also between taxels and beyond the edge.
SurfaceRow surfaceRow(const SensorSurface& surface, const TaxelPitch& pitchMm, double row);

// The two radii of bent surfaces in a hand's description.
enum class BendRadius {
  kNominal,    // as constructed
  kEffective,  // with which the same rigid object always measures the same
};
inline constexpr std::array<OptionWord<BendRadius>, 2> kBendRadiusWords{
    {{"study", BendRadius::kNominal}, {"effective", BendRadius::kEffective}}};

// Returns whether the description of a hand contains what describeGeometry() needs.
bool hasGeometry(const HandDescription& hand);
// Returns the geometry that a hand's file describes, for the layout and the axes of `hand`. Throws
// palpate::Error that names what does not fit in hand.json or the URDF.
GeometryDescription describeGeometry(const HandDescription& hand,
                                     BendRadius radius = BendRadius::kNominal);

}  // namespace palpate
