#include "kinematics/urdf_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/xml.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kMmPerM = 1000.0;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr std::size_t kMaxLinks = 1000;
constexpr double kFarM = 100.0;
// Rotations this close to one by right angles are meant to be one: the file holds rounded radians.
constexpr double kRightAngle = 1e-12;

// Collects the messages of the URDF library, which it otherwise prints.
class UrdfMessages : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR || !first_.empty()) return;
    first_ = text;
  }
  const std::string& first() const { return first_; }

 private:
  std::string first_;
};

// Checks that the text is well-formed XML without deep nesting, which the URDF library, whose
// reader is recursive, does not do, and whether it is an unexpanded xacro.
class UrdfCheck : public XmlHandler {
 public:
  void startElement(std::string_view name, const char* const* attributes) override {
    isXacro_ |= name.starts_with("xacro:");
    for (; *attributes; attributes += 2)
      isXacro_ |= std::string_view(attributes[1]).find("${") != std::string_view::npos ||
                  std::string_view(attributes[1]).find("$(") != std::string_view::npos;
  }
  void endElement(std::string_view) override {}
  void text(std::string_view) override {}
  bool isXacro() const { return isXacro_; }

 private:
  bool isXacro_ = false;
};

urdf::ModelInterfaceSharedPtr parseModel(const std::string& text, const fs::path& source) {
  try {
    UrdfCheck check;
    XmlParser parser(check, {.maxDepth = 16});
    parser.push(text);
    parser.finish();
    if (check.isXacro())
      throw FormatError(source,
                        "is a xacro that is not expanded: expand it with 'xacro IN.xacro -o "
                        "hand.urdf'");
  } catch (const XmlError& error) {
    throw FormatError(source, error.what(), error.offset());
  }
  // The handler of messages is one for the whole process.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  UrdfMessages messages;
  console_bridge::useOutputHandler(&messages);
  urdf::ModelInterfaceSharedPtr model;
  std::string thrown;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    thrown = error.what();
  }
  console_bridge::restorePreviousOutputHandler();
  if (model && messages.first().empty() && thrown.empty()) return model;
  const std::string& why = messages.first().empty() ? thrown : messages.first();
  throw FormatError(source, "not a valid URDF" + (why.empty() ? why : ": " + shortened(why)));
}

class UrdfTreeBuilder {
 public:
  UrdfTreeBuilder(const urdf::ModelInterface& model, const fs::path& source, const fs::path& folder)
      : model_(model), source_(source), folder_(folder) {}

  UrdfTree build() {
    if (!model_.getRoot()) fail("has no root link");
    if (model_.links_.size() > kMaxLinks)
      fail("has more than " + std::to_string(kMaxLinks) + " links");
    add(*model_.getRoot(), std::nullopt);
    // Each link once, in the order of levels: recursion is not needed, and a cycle is found.
    for (std::size_t i = 0; i < tree_.size(); ++i) {
      const urdf::Link& link = *model_.getLink(tree_[i].name);
      std::vector<std::string> names;
      for (const urdf::JointSharedPtr& joint : link.child_joints)
        names.push_back(joint->child_link_name);
      std::sort(names.begin(), names.end());
      for (const std::string& name : names) add(*model_.getLink(name), i);
    }
    if (tree_.size() != model_.links_.size()) {
      for (const auto& [name, link] : model_.links_)
        if (!known_.contains(name))
          fail("has a link '" + shortened(name) + "' that is not connected to the root link '" +
               shortened(tree_.front().name) + "'");
    }
    return std::move(tree_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw FormatError(source_, "the URDF " + what);
  }

  double finite(double value, double most, const std::string& where) const {
    if (!(std::abs(value) <= most)) fail("has a number in " + where + " that is too large");
    return value;
  }

  Isometry3d frame(const urdf::Pose& pose, const std::string& where) const {
    Isometry3d frame = Isometry3d::Identity();
    frame.translation() = kMmPerM * Vector3d(finite(pose.position.x, kFarM, where),
                                             finite(pose.position.y, kFarM, where),
                                             finite(pose.position.z, kFarM, where));
    const Eigen::Quaterniond rotation(
        pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
    if (!(std::abs(rotation.norm() - 1.0) < 1e-6)) fail("has an invalid rotation in " + where);
    Eigen::Matrix3d matrix = rotation.normalized().toRotationMatrix();
    const Eigen::Matrix3d rounded = matrix.array().round().matrix();
    if ((matrix - rounded).cwiseAbs().maxCoeff() < kRightAngle) matrix = rounded;
    frame.linear() = matrix;
    return frame;
  }

  UrdfJoint jointOf(const urdf::Joint& from) const {
    const std::string where = "joint '" + shortened(from.name) + "'";
    UrdfJoint joint;
    joint.name = from.name;
    joint.parentFromJoint = frame(from.parent_to_joint_origin_transform, where);
    switch (from.type) {
      case urdf::Joint::FIXED:
        return joint;
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        joint.kind = UrdfJoint::Kind::kRevolute;
        break;
      case urdf::Joint::PRISMATIC:
        joint.kind = UrdfJoint::Kind::kPrismatic;
        break;
      default:
        fail("has a " + where +
             " of a type that is not supported (supported: fixed, revolute, continuous, "
             "prismatic)");
    }
    const Vector3d axis(from.axis.x, from.axis.y, from.axis.z);
    if (!(axis.norm() > 1e-6) || !axis.allFinite()) fail("has a " + where + " without an axis");
    // Rotates z to the axis; about x or y by a right angle where that does it.
    Isometry3d turn = Isometry3d::Identity();
    const Vector3d unit = axis.normalized();
    if (unit.isApprox(Vector3d(-Vector3d::UnitZ()), kRightAngle))
      turn.linear() = Vector3d(1.0, -1.0, -1.0).asDiagonal();
    else if (!unit.isApprox(Vector3d::UnitZ(), kRightAngle))
      turn.linear() =
          Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), unit).toRotationMatrix();
    joint.parentFromJoint = joint.parentFromJoint * turn;
    joint.jointFromChild = turn.inverse(Eigen::Isometry);
    if (from.mimic) {
      const double unitsPerSi = joint.kind == UrdfJoint::Kind::kPrismatic ? kMmPerM : kDegPerRad;
      joint.mimics = from.mimic->joint_name;
      joint.multiplier = finite(from.mimic->multiplier, 1e6, where);
      joint.offset = finite(from.mimic->offset, 1e3, where) * unitsPerSi;
    }
    return joint;
  }

  LinkShape shapeOf(const urdf::Visual& visual, const std::string& where) const {
    LinkShape shape;
    shape.linkFromShape = frame(visual.origin, where);
    const auto lengths = [&](double x, double y, double z) {
      return Vector3d(kMmPerM * Vector3d(finite(x, kFarM, where),
                                         finite(y, kFarM, where),
                                         finite(z, kFarM, where)));
    };
    switch (visual.geometry->type) {
      case urdf::Geometry::BOX: {
        const auto& box = static_cast<const urdf::Box&>(*visual.geometry);
        shape.kind = LinkShape::Kind::kBox;
        shape.sizeMm = lengths(box.dim.x, box.dim.y, box.dim.z);
        break;
      }
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(*visual.geometry);
        shape.kind = LinkShape::Kind::kCylinder;
        shape.sizeMm = lengths(2.0 * cylinder.radius, 2.0 * cylinder.radius, cylinder.length);
        break;
      }
      case urdf::Geometry::SPHERE: {
        const auto& sphere = static_cast<const urdf::Sphere&>(*visual.geometry);
        shape.kind = LinkShape::Kind::kSphere;
        shape.sizeMm = lengths(2.0 * sphere.radius, 2.0 * sphere.radius, 2.0 * sphere.radius);
        break;
      }
      case urdf::Geometry::MESH: {
        const auto& mesh = static_cast<const urdf::Mesh&>(*visual.geometry);
        shape.kind = LinkShape::Kind::kMesh;
        shape.sizeMm = lengths(mesh.scale.x, mesh.scale.y, mesh.scale.z);
        setMesh(shape, mesh.filename);
        return shape;
      }
    }
    if (!(shape.sizeMm.minCoeff() > 0.0)) fail("has a shape without extent in " + where);
    return shape;
  }

  // A mesh lies in the folder of the hand; "package://NAME/" and "file://" are taken off. One that
  // lies elsewhere is not read: only the looks of the hand need it.
  void setMesh(LinkShape& shape, std::string name) const {
    if (name.starts_with("package://")) {
      const std::size_t slash = name.find('/', 10);
      name = slash == std::string::npos ? std::string() : name.substr(slash + 1);
    } else if (name.starts_with("file://")) {
      name = name.substr(7);
    }
    const fs::path path(name);
    const bool leaves = std::find(path.begin(), path.end(), "..") != path.end();
    if (name.empty() || path.is_absolute() || leaves)
      shape.meshFault = "'" + shortened(name) + "' is not in the folder of the hand: copy it there";
    else
      shape.mesh = folder_.empty() ? path : folder_ / path;
  }

  void add(const urdf::Link& from, std::optional<std::size_t> parent) {
    if (!known_.emplace(from.name, tree_.size()).second)
      fail("has a link '" + shortened(from.name) + "' with two parents, or in a cycle");
    UrdfLink link;
    link.name = from.name;
    link.parent = parent;
    if (parent) {
      if (!from.parent_joint) fail("has no joint for link '" + shortened(from.name) + "'");
      link.joint = jointOf(*from.parent_joint);
      tree_[*parent].children.push_back(tree_.size());
    }
    for (const urdf::VisualSharedPtr& visual : from.visual_array)
      if (visual && visual->geometry)
        link.shapes.push_back(shapeOf(*visual, "link '" + shortened(from.name) + "'"));
    tree_.push_back(std::move(link));
  }

  const urdf::ModelInterface& model_;
  const fs::path& source_;
  const fs::path& folder_;
  UrdfTree tree_;
  std::map<std::string, std::size_t> known_;
};

}  // namespace

UrdfTree readUrdf(const std::string& text, const fs::path& source, const fs::path& folder) {
  const urdf::ModelInterfaceSharedPtr model = parseModel(text, source);
  return UrdfTreeBuilder(*model, source, folder).build();
}

}  // namespace palpate
