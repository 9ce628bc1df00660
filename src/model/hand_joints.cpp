#include "palpate/model/hand_joints.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <string_view>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/xml.h"
#include "palpate/model/hand_file.h"

namespace palpate {
namespace {

constexpr double kMmPerM = 1000.0;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;

// A joint as it stands in the URDF.
struct JointText {
  std::string name;
  std::string type;
  std::string mimics;  // empty: no other joint
  double multiplier = 1.0;
  double offset = 0.0;  // [deg or mm]

  bool isSliding() const { return type == "prismatic"; }
};

// Collects the elements `joint` below the root.
class JointReader : public XmlHandler {
 public:
  void startElement(std::string_view name, const char* const* attributes) override {
    if (depth_ == 1 && name == "joint") {
      joints_.push_back({std::string(attribute(attributes, "name")),
                         std::string(attribute(attributes, "type")),
                         ""});
      inJoint_ = true;
    } else if (depth_ == 2 && inJoint_ && name == "mimic") {
      takeMimic(attributes);
    }
    ++depth_;
  }
  void endElement(std::string_view) override {
    if (--depth_ == 1) inJoint_ = false;
  }
  void text(std::string_view) override {}

  // Those that can move.
  std::vector<JointText> take() {
    std::erase_if(joints_, [](const JointText& joint) {
      return joint.type != "revolute" && joint.type != "continuous" && !joint.isSliding();
    });
    return std::move(joints_);
  }
  bool hasFixed(std::string_view name) const {
    return std::any_of(joints_.begin(), joints_.end(), [&](const JointText& joint) {
      return joint.name == name && joint.type == "fixed";
    });
  }

 private:
  static std::string_view attribute(const char* const* attributes, std::string_view name) {
    for (; *attributes; attributes += 2)
      if (*attributes == name) return attributes[1];
    return {};
  }

  void takeMimic(const char* const* attributes) {
    JointText& joint = joints_.back();
    joint.mimics = attribute(attributes, "joint");
    joint.multiplier = parseDouble(trimmed(attribute(attributes, "multiplier"))).value_or(1.0);
    joint.offset = parseDouble(trimmed(attribute(attributes, "offset"))).value_or(0.0) *
                   (joint.isSliding() ? kMmPerM : kDegPerRad);
  }

  std::vector<JointText> joints_;
  int depth_ = 0;
  bool inJoint_ = false;
};

class JointsOfHand {
 public:
  explicit JointsOfHand(const HandDescription& hand) : hand_(hand), file_(*hand.file) {
    try {
      XmlParser parser(reader_);
      parser.push(file_.urdf);
      parser.finish();
    } catch (const XmlError& error) {
      throw FormatError(file_.folder / "hand.urdf", error.what(), error.offset());
    }
  }

  std::vector<HandJoint> joints() {
    checkFixed();
    texts_ = reader_.take();
    for (const JointText& joint : texts_) byName_.emplace(joint.name, &joint);
    for (std::size_t axis = 0; axis < file_.axisJoints.size(); ++axis) addAxis(axis);
    for (const JointText& joint : texts_)
      if (!known_.contains(joint.name)) add(followed(joint));
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw FormatError(file_.folder / "hand.json", what);
  }

  static std::string placeOf(std::size_t axis) {
    return "axes[" + std::to_string(axis) + "].joints names '";
  }

  void checkFixed() const {
    for (std::size_t axis = 0; axis < file_.axisJoints.size(); ++axis)
      for (const std::string& name : file_.axisJoints[axis])
        if (reader_.hasFixed(name))
          fail(placeOf(axis) + shortened(name) + "', which is a fixed joint");
  }

  void add(HandJoint joint) {
    known_.emplace(joint.name, result_.size());
    result_.push_back(std::move(joint));
  }

  void addAxis(std::size_t axis) {
    const AxisDescription& moves = hand_.axes[axis];
    if (file_.axisJoints[axis].empty()) result_.push_back({moves.name, moves.isSliding, axis});
    for (const std::string& name : file_.axisJoints[axis]) {
      const auto joint = byName_.find(name);
      if (joint == byName_.end())
        fail(placeOf(axis) + shortened(name) + "', which the URDF does not have");
      const bool slides = joint->second->isSliding();
      if (slides != moves.isSliding)
        fail(placeOf(axis) + shortened(name) + "', whose values are in " + (slides ? "mm" : "deg") +
             "; the axis is in " + moves.unit());
      add({name, slides, axis});
    }
  }

  // A joint that no axis moves: it follows another one, which may follow one again, or rests.
  HandJoint followed(const JointText& joint) const {
    HandJoint result{joint.name, joint.isSliding(), std::nullopt};
    const JointText* follows = &joint;
    for (std::size_t steps = 0; !follows->mimics.empty(); ++steps) {
      result.offset += result.factor * follows->offset;
      result.factor *= follows->multiplier;
      const auto next = byName_.find(follows->mimics);
      if (next == byName_.end() || steps > byName_.size())
        fail("the URDF's joint '" + shortened(joint.name) + "' mimics '" +
             shortened(follows->mimics) + "', which does not exist or mimics it in turn");
      if (next->second->isSliding() != joint.isSliding())
        fail("the URDF's joint '" + shortened(joint.name) + "' mimics a joint of another type, '" +
             shortened(follows->mimics) + "'");
      follows = next->second;
      const auto known = known_.find(follows->name);
      if (known == known_.end() || !result_[known->second].axis) continue;
      const HandJoint& moved = result_[known->second];
      result.axis = moved.axis;
      result.offset += result.factor * moved.offset;
      result.factor *= moved.factor;
      break;
    }
    return result;
  }

  const HandDescription& hand_;
  const HandFile& file_;
  JointReader reader_;
  std::vector<JointText> texts_;
  std::map<std::string, const JointText*> byName_;
  std::map<std::string, std::size_t> known_;  // of `result_`, by name
  std::vector<HandJoint> result_;
};

std::vector<HandJoint> jointPerAxis(const HandDescription& hand) {
  std::vector<HandJoint> joints;
  for (std::size_t axis = 0; axis < hand.axes.size(); ++axis)
    joints.push_back({hand.axes[axis].name, hand.axes[axis].isSliding, axis});
  return joints;
}

}  // namespace

double HandJoint::valueSi(std::span<const double> angles) const {
  const double moved = axis && *axis < angles.size() ? factor * angles[*axis] : 0.0;
  return (moved + offset) / (isSliding ? kMmPerM : kDegPerRad);
}

std::vector<HandJoint> handJoints(const HandDescription& hand) {
  if (!hand.file || hand.file->urdf.empty() || hand.file->axisJoints.size() != hand.axes.size())
    return jointPerAxis(hand);
  return JointsOfHand(hand).joints();
}

std::vector<HandJoint> shownJoints(const HandDescription& hand) {
  try {
    return handJoints(hand);
  } catch (const FormatError&) {
    return jointPerAxis(hand);
  }
}

}  // namespace palpate
