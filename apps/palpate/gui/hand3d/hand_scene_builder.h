// Fills the scene of a hand in space: bodies in their pose, taxels with their values, and what was
// computed of the contact. Keeps what doesn't change.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

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

inline constexpr float kSlipEnlarged = 3.0F;  // of arrows

// A hand at one moment.
struct HandState {
  std::vector<double> anglesDeg;      // one per axis; empty: not known, the rest pose, greyed
  std::optional<TactileFrame> frame;  // nothing: no values yet
  HandContact contact;                // of both; empty without either
};

class HandSceneBuilder {
 public:
  // Another hand. One whose geometry isn't known (a pad, another layout) can be laid flat only.
  void setHand(const HandDescription& hand);
  void clear();
  bool hasHand() const noexcept { return hand_.has_value(); }
  bool hasGeometry() const noexcept { return geometry_ != nullptr; }
  const HandDescription& hand() const { return *hand_; }

  // The angles of a frame and what touches there. Angles that are no numbers, or too few, are none.
  void setMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg);
  void setSelection(const TaxelSelection& selection) { selection_ = selection; }
  // Of the moment; empty: not known.
  void setSlip(std::vector<HandSlip> slip) { slip_ = std::move(slip); }
  const std::vector<HandSlip>& slip() const noexcept { return slip_; }
  const HandState& handState() const noexcept { return handState_; }
  bool posed() const noexcept { return !handState_.anglesDeg.empty(); }
  const HandPose& pose() const noexcept { return pose_; }

  // What is drawn: taxels laid flat where the geometry isn't known, whatever the look says.
  HandLook effective(HandLook look) const;
  void fill(HandScene& scene, const HandLook& look, const HandCamera& camera) const;
  // From where it is looked at first; not yet fitted.
  HandCamera usualCamera(const HandLook& look) const;
  // What a camera has to have in its picture [mm].
  std::vector<Eigen::Vector3d> extent(const HandLook& look) const;
  // The place whose taxel is under a ray, in front of everything else.
  std::optional<TaxelPlace> taxelUnder(const Eigen::Vector3d& eyeMm,
                                       const Eigen::Vector3d& ray,
                                       const HandLook& look) const;
  const TaxelPatches& patches(const HandLook& look) const;

 private:
  void addBodies(HandScene& scene, const HandLook& look) const;
  void addTaxels(HandScene& scene, const HandLook& look) const;
  void addSelection(HandScene& scene, const HandLook& look) const;
  void addNormals(HandScene& scene, const HandLook& look) const;
  void addSphere(HandScene& scene, const HandLook& look, const HandCamera& camera) const;
  void addContacts(HandScene& scene, const HandLook& look) const;
  void addAxes(HandScene& scene, const HandLook& look) const;
  void addSlip(HandScene& scene, const HandLook& look) const;
  bool isShown(const HandBody& body, const HandLook& look) const;
  const Sphere* sphereOf(const HandLook& look) const;

  std::optional<HandDescription> hand_;
  std::shared_ptr<const HandGeometry> geometry_;
  std::vector<HandBody> bodies_;
  HandState handState_;
  HandPose pose_;
  TaxelPatches onHand_, flat_;
  TaxelSelection selection_;
  std::vector<HandSlip> slip_;
};

// The geometry of a hand that is known; nothing for others. One for the whole program.
std::shared_ptr<const HandGeometry> geometryOf(const HandDescription& hand);

}  // namespace palpate::gui
