#include "palpate/kinematics/geometry_description.h"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/LU>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/hand_joints.h"

#include "kinematics/urdf_tree.h"

namespace palpate {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

[[noreturn]] void misfit(const std::string& what) {
  throw std::invalid_argument("GeometryDescription: " + what);
}

void validateFrame(const Isometry3d& frame, const std::string& name) {
  if (!frame.matrix().allFinite()) misfit(name + " is at a place that is not a number");
  if (!frame.linear().isUnitary(1e-6) || frame.linear().determinant() < 0.0)
    misfit(name + " has a matrix that is not a rotation");
}

void validateFinger(const Finger& finger, const std::string& name, std::size_t numAxes) {
  Isometry3d base = Isometry3d::Identity();
  base.linear() = finger.baseRotation;
  base.translation() = finger.baseMm;
  validateFrame(base, name);
  for (const ChainLink& link : finger.links) {
    if (link.axis && *link.axis >= numAxes)
      misfit("there is no axis " + std::to_string(*link.axis));
    for (const double value : {link.factor, link.offset})
      if (!std::isfinite(value)) misfit("a link of " + name + " is not a number");
    validateFrame(link.jointFromEnd, "a link of " + name);
  }
}

// Makes the geometry of a hand from its file and the tree of its URDF.
class GeometryBuilder {
 public:
  GeometryBuilder(const HandDescription& hand, BendRadius radius)
      : hand_(hand), file_(*hand.file), radius_(radius) {}

  GeometryDescription build() {
    out_.numAxes = hand_.axes.size();
    out_.layout = *hand_.layout;
    if (!file_.urdf.empty()) {
      tree_ = readUrdf(file_.urdf, file_.folder / "hand.urdf", file_.folder);
      findAxes();
      places_.resize(tree_.size());
      linkFromUrdf_.resize(tree_.size(), Isometry3d::Identity());
      addFingers(0, {});
      for (std::size_t i = 0; i < tree_.size(); ++i)
        for (LinkShape shape : tree_[i].shapes) {
          shape.place = places_[i];
          shape.linkFromShape = linkFromUrdf_[i] * shape.linkFromShape;
          out_.shapes.push_back(std::move(shape));
        }
      for (std::size_t i = 0; i < tree_.size(); ++i)
        out_.links.push_back({tree_[i].name, tree_[i].parent, places_[i], linkFromUrdf_[i]});
    }
    for (std::size_t m = 0; m < file_.surfaces.size(); ++m)
      out_.surfaces.push_back(surfaceOf(file_.surfaces[m], m));
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw FormatError(file_.folder / "hand.json", what);
  }

  // A joint's value by the axes of the hand.
  struct Drive {
    std::optional<std::size_t> axis;
    double factor = 1.0, offset = 0.0;
  };

  void findAxes() {
    for (const HandJoint& joint : handJoints(hand_))
      drives_[joint.name] = {joint.axis, joint.factor, joint.offset};
  }

  // Whether this link only marks the end of the link before it.
  bool isEnd(std::size_t link) const {
    return tree_[link].children.empty() && tree_[link].joint.kind == UrdfJoint::Kind::kFixed;
  }

  // Follows the tree from `link`, to which `chain` leads, and adds a finger per tip.
  void addFingers(std::size_t link, const std::vector<std::size_t>& chain) {
    const std::vector<std::size_t>& children = tree_[link].children;
    bool goesOn = false;
    for (const std::size_t child : children) {
      if (!chain.empty() && isEnd(child)) continue;
      goesOn = true;
      std::vector<std::size_t> longer = chain;
      longer.push_back(child);
      addFingers(child, longer);
    }
    if (!goesOn && !chain.empty()) addFinger(chain);
  }

  void addFinger(const std::vector<std::size_t>& chain) {
    Finger finger;
    const std::size_t index = out_.fingers.size();
    finger.name = tree_[chain.back()].name;
    const Isometry3d base = tree_[chain.front()].joint.parentFromJoint;
    finger.baseMm = base.translation();
    finger.baseRotation = base.linear();
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const UrdfLink& link = tree_[chain[i]];
      ChainLink out;
      out.type = link.joint.kind == UrdfJoint::Kind::kPrismatic ? JointType::kPrismatic
                                                                : JointType::kRevolute;
      if (const auto drive = drives_.find(link.joint.name); drive != drives_.end()) {
        out.axis = drive->second.axis;
        out.factor = drive->second.factor;
        out.offset = drive->second.offset;
      }
      // The link ends at the next joint, at the link that marks its end, or where it begins.
      Isometry3d linkFromEnd = Isometry3d::Identity();
      if (i + 1 < chain.size()) {
        linkFromEnd = tree_[chain[i + 1]].joint.parentFromJoint;
      } else {
        for (const std::size_t child : link.children)
          if (isEnd(child)) {
            linkFromEnd = tree_[child].joint.parentFromJoint;
            break;
          }
      }
      out.jointFromEnd = link.joint.jointFromChild * linkFromEnd;
      finger.links.push_back(out);
      const Isometry3d endFromLink = linkFromEnd.inverse(Eigen::Isometry);
      place(chain[i], {index, i}, endFromLink);
      for (const std::size_t child : link.children)
        if (isEnd(child))
          place(child, {index, i}, endFromLink * tree_[child].joint.parentFromJoint);
    }
    out_.fingers.push_back(std::move(finger));
  }

  void place(std::size_t link, LinkPlace at, const Isometry3d& endFromLink) {
    if (places_[link].link) return;  // a link that fingers have in common: the first one counts
    places_[link] = at;
    linkFromUrdf_[link] = endFromLink;
  }

  SensorSurface surfaceOf(const MatrixSurface& from, std::size_t matrix) const {
    SensorSurface surface;
    Isometry3d placeFromLink = Isometry3d::Identity();
    if (!from.link.empty()) {
      std::size_t i = 0;
      while (i < tree_.size() && tree_[i].name != from.link) ++i;
      if (i == tree_.size())
        fail("matrices[" + std::to_string(matrix) + "].surface.link names '" +
             shortened(from.link) + "', which the URDF does not have");
      surface.place = places_[i];
      placeFromLink = linkFromUrdf_[i];
    }
    for (const TaxelPose& taxel : from.taxels) {
      surface.positionsMm.push_back(placeFromLink *
                                    Vector3d(Eigen::Map<const Vector3d>(taxel.positionMm.data())));
      surface.normals.push_back(placeFromLink.linear() *
                                Eigen::Map<const Vector3d>(taxel.normal.data()).normalized());
    }
    if (!from.taxels.empty()) return surface;
    const Vector3d x = Eigen::Map<const Vector3d>(from.xAxis.data()).normalized();
    Vector3d y = Eigen::Map<const Vector3d>(from.yAxis.data());
    y = (y - x * x.dot(y)).normalized();
    Isometry3d linkFromSurface = Isometry3d::Identity();
    linkFromSurface.linear().col(0) = x;
    linkFromSurface.linear().col(1) = y;
    linkFromSurface.linear().col(2) = x.cross(y);
    linkFromSurface.translation() = Eigen::Map<const Vector3d>(from.originMm.data());
    surface.linkFromSurface = placeFromLink * linkFromSurface;
    surface.bendRow = from.bendRow;
    if (from.bendRow)
      surface.radiusMm =
          radius_ == BendRadius::kEffective ? from.effectiveBendRadiusMm : from.bendRadiusMm;
    return surface;
  }

  const HandDescription& hand_;
  const HandFile& file_;
  const BendRadius radius_;
  UrdfTree tree_;
  std::map<std::string, Drive> drives_;   // by the joint's name
  std::vector<LinkPlace> places_;         // per link of the URDF
  std::vector<Isometry3d> linkFromUrdf_;  // frame of the URDF's link in the frame of its place
  GeometryDescription out_;
};

}  // namespace

ChainLink denavitHartenbergLink(std::optional<std::size_t> axis,
                                double sign,
                                double offsetDeg,
                                double dMm,
                                double rMm,
                                double alphaDeg) {
  ChainLink link;
  link.axis = axis;
  link.factor = sign;
  link.offset = offsetDeg;
  link.jointFromEnd.translation() = Vector3d(rMm, 0.0, dMm);
  // Exact at multiples of a right angle, so that a straight finger is straight.
  const double quarters = std::nearbyint(alphaDeg / 90.0);
  const double rest = (alphaDeg - 90.0 * quarters) * (std::numbers::pi / 180.0);
  Eigen::Matrix3d quarterTurn = Eigen::Matrix3d::Identity(), turn = Eigen::Matrix3d::Identity();
  quarterTurn.block<2, 2>(1, 1) << 0.0, -1.0, 1.0, 0.0;
  const int count = static_cast<int>(quarters - 4.0 * std::floor(quarters / 4.0));
  for (int i = 0; i < count; ++i) turn = quarterTurn * turn;
  link.jointFromEnd.linear() = turn * Eigen::AngleAxisd(rest, Vector3d::UnitX()).toRotationMatrix();
  return link;
}

void GeometryDescription::validate() const {
  if (surfaces.size() != layout.numMatrices())
    misfit(std::to_string(surfaces.size()) + " surfaces for " +
           std::to_string(layout.numMatrices()) + " matrices");
  for (std::size_t f = 0; f < fingers.size(); ++f)
    validateFinger(fingers[f], "finger " + std::to_string(f), numAxes);
  const auto requirePlace = [this](const LinkPlace& place, const std::string& name) {
    if (place.link &&
        (place.finger >= fingers.size() || *place.link >= fingers[place.finger].links.size()))
      misfit(name + " is on a link that does not exist");
  };
  for (std::size_t m = 0; m < surfaces.size(); ++m) {
    const SensorSurface& surface = surfaces[m];
    const std::string name = "matrix " + std::to_string(m);
    requirePlace(surface.place, name);
    validateFrame(surface.linkFromSurface, name);
    if (surface.bendRow && !std::isfinite(*surface.bendRow))
      misfit(name + " is bent from a row that is not a number");
    if (surface.bendRow && !(surface.radiusMm > 0.0 && std::isfinite(surface.radiusMm)))
      misfit(name + " is bent with a radius that isn't positive");
    if (surface.positionsMm.empty() && surface.normals.empty()) continue;
    const std::size_t places = layout.matrix(m).numCells();
    if (surface.positionsMm.size() != places || surface.normals.size() != places)
      misfit(name + " doesn't have one position and one normal per place");
    for (std::size_t i = 0; i < places; ++i)
      if (!surface.positionsMm[i].allFinite() ||
          !(std::abs(surface.normals[i].norm() - 1.0) < 1e-6))
        misfit(name + " has a taxel without a place or a normal");
  }
  for (const NamedLink& link : links) {
    requirePlace(link.place, "a link of the URDF");
    validateFrame(link.placeFromLink, "a link of the URDF");
  }
  for (const LinkShape& shape : shapes) {
    requirePlace(shape.place, "a shape");
    validateFrame(shape.linkFromShape, "a shape");
    if (!shape.sizeMm.allFinite()) misfit("a shape has a size that is not a number");
  }
}

SurfaceRow surfaceRow(const SensorSurface& surface, const TaxelPitch& pitchMm, double row) {
  if (!surface.bendRow || row > *surface.bendRow) return {pitchMm.y * row, 0.0, 0.0, -1.0};
  const double angle = (*surface.bendRow - row) * pitchMm.y / surface.radiusMm;
  const double sine = std::sin(angle), cosine = std::cos(angle);
  return {pitchMm.y * *surface.bendRow - surface.radiusMm * sine,
          surface.radiusMm * (1.0 - cosine),
          -sine,
          -cosine};
}

bool hasGeometry(const HandDescription& hand) {
  return hand.file && !hand.file->surfaces.empty() &&
         hand.file->surfaces.size() == hand.layout->numMatrices() &&
         (hand.file->axisJoints.size() == hand.axes.size() || hand.file->urdf.empty());
}

GeometryDescription describeGeometry(const HandDescription& hand, BendRadius radius) {
  if (!hasGeometry(hand))
    throw Error(hand.name +
                ": its description contains no geometry: give each matrix a surface in hand.json");
  return GeometryBuilder(hand, radius).build();
}

}  // namespace palpate
