// Builds the scene of a hand in 3-D: bodies in their pose, taxels with their values, and the
// computed contact. Caches what doesn't change between frames.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <palpate/emulator/scene.h>
#include <palpate/kinematics/contact_geometry.h>
#include <palpate/kinematics/hand_geometry.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>
#include <palpate/model/taxel_selection.h>

#include "gui/hand3d/hand_camera.h"
#include "gui/hand3d/hand_look.h"
#include "gui/hand3d/hand_mesh.h"
#include "gui/hand3d/hand_scene.h"
#include "gui/hand3d/taxel_patches.h"
#include "gui/window_state/hand_slip.h"

namespace palpate::gui {

// Factor by which arrows of slip are longer than the motion.
inline constexpr float kSlipEnlarged = 3.0F;

// The hand at one frame.
struct HandState {
  // One per axis; empty: not known, then the rest pose is drawn, greyed.
  std::vector<double> anglesDeg;
  // Nothing: no values yet.
  std::optional<TactileFrame> frame;
  // Computed from angles and frame; empty if either is missing.
  HandContact contact;
};

class HandSceneBuilder {
 public:
  // Sets another hand. One whose geometry isn't known (a pad, another layout) can only be drawn
  // laid flat.
  // `withMeshes` false: bodies that files describe are not read; see meshesMissing(). Those of the
  // same hand are kept.
  void setHand(const HandDescription& hand, bool withMeshes);
  // The geometry whose bodies were not read; null: they all were. Its handBodies() are for
  // setBodies().
  const std::shared_ptr<const HandGeometry>& meshesMissing() const noexcept { return missing_; }
  void setBodies(std::vector<HandBody> bodies);
  // Whether bodies that files describe are drawn.
  bool drawsMeshes() const;
  void clear();
  bool hasHand() const noexcept { return hand_.has_value(); }
  bool hasGeometry() const noexcept { return geometry_ != nullptr; }
  const HandDescription& hand() const { return *hand_; }

  // Sets frame and joint angles [deg]. Angles that aren't numbers, or too few, count as unknown.
  void setMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg);
  // Sets the objects around an emulated hand, in their poses. Returns whether that changed the
  // scene.
  bool setObjects(const std::vector<SceneObject>& objects);
  void setSelection(const TaxelSelection& selection) { selection_ = selection; }
  // Slip of the contacts at this frame; empty: not known.
  void setSlip(std::vector<HandSlip> slip) { slip_ = std::move(slip); }
  const std::vector<HandSlip>& slip() const noexcept { return slip_; }
  const HandState& handState() const noexcept { return handState_; }
  // Whether the pose of the hand is known: by its joint angles, or because it has no axes.
  bool posed() const noexcept {
    return geometry_ && handState_.frame &&
           handState_.anglesDeg.size() == geometry_->description().numAxes;
  }
  const HandPose& pose() const noexcept { return pose_; }

  // The look that is really drawn: taxels are laid flat when the geometry isn't known.
  HandLook effective(HandLook look) const;
  void fill(HandScene& scene, const HandLook& look, const HandCamera& camera) const;
  // The default camera for a look, not yet fitted to the hand.
  HandCamera usualCamera(const HandLook& look) const;
  // Points that the camera must have in its picture [mm].
  std::vector<Eigen::Vector3d> extent(const HandLook& look) const;
  // The taxel that a ray hits first, unless a body hides it.
  std::optional<TaxelPlace> taxelUnder(const Eigen::Vector3d& eyeMm,
                                       const Eigen::Vector3d& ray,
                                       const HandLook& look) const;
  const TaxelPatches& patches(const HandLook& look) const;

 private:
  void addBodies(HandScene& scene, const HandLook& look) const;
  void addObjects(HandScene& scene, const HandLook& look) const;
  void addTaxels(HandScene& scene, const HandLook& look) const;
  void addSelection(HandScene& scene, const HandLook& look) const;
  void addShear(HandScene& scene, const HandLook& look) const;
  void addNormals(HandScene& scene, const HandLook& look) const;
  void addSphere(HandScene& scene, const HandLook& look, const HandCamera& camera) const;
  void addContacts(HandScene& scene, const HandLook& look) const;
  void addAxes(HandScene& scene, const HandLook& look) const;
  void addSlip(HandScene& scene, const HandLook& look, const HandCamera& camera) const;
  bool isShown(const HandBody& body, const HandLook& look) const;
  const Sphere* sphereOf(const HandLook& look) const;

  std::optional<HandDescription> hand_;
  std::shared_ptr<const HandGeometry> geometry_;
  std::shared_ptr<const HandGeometry> missing_;
  std::vector<HandBody> bodies_;
  struct DrawnObject {
    SceneObject object;
    std::vector<HandBody::Corner> triangles;
  };
  std::vector<DrawnObject> objects_;
  HandState handState_;
  HandPose pose_;
  TaxelPatches onHand_, flat_;
  TaxelSelection selection_;
  std::vector<HandSlip> slip_;
};

// The geometry of a known hand; null for others. Shared by the whole program.
std::shared_ptr<const HandGeometry> geometryOf(const HandDescription& hand);

}  // namespace palpate::gui
