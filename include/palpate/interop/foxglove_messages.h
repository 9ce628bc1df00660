// The channels of a hand for Foxglove, and the messages of a frame on them: JSON objects in
// Foxglove's message schemas (docs.foxglove.dev, "Message schemas": RawImage, PointCloud,
// FrameTransforms, SceneUpdate, JointStates, Log), so that its panels show them without more.
//
// Lengths are in m and angles in rad there, as Foxglove's schemas ask for; signals keep their
// units, which the schema of their channel names. docs/notes/live_streams.md lists the channels.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/capture/link_health.h>
#include <palpate/core/option_check.h>
#include <palpate/interop/foxglove_server.h>
#include <palpate/kinematics/hand_geometry.h>
#include <palpate/live/live_results.h>
#include <palpate/model/event.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/hand_joints.h>

namespace palpate {

// How the values of a matrix become an image.
enum class FoxgloveImage {
  // mono16: the counts, rounded (0..65535). A hand whose unit is not counts gets 32FC1, its values.
  kValues,
  kColored,  // rgb8: a colour by value / full scale; places without a taxel are black
};
inline constexpr std::array<OptionWord<FoxgloveImage>, 2> kFoxgloveImageWords{
    {{"values", FoxgloveImage::kValues}, {"colored", FoxgloveImage::kColored}}};

// Red, green, blue of a value in 0..1: the colour map viridis (S. van der Walt, N. Smith, 2015),
// linear between five of its colours. Values outside of 0..1 have the colours of the ends.
struct FoxgloveColor {
  std::uint8_t red = 0, green = 0, blue = 0;
};
FoxgloveColor foxgloveColor(double value) noexcept;

// RFC 4648, with padding.
void appendBase64(std::string& out, const void* data, std::size_t size);

// Not thread-safe. Channels that a hand can't fill do not exist: no space without a geometry, no
// joints without axes.
class FoxgloveMessages {
 public:
  // Throws std::invalid_argument (a hand without a layout).
  explicit FoxgloveMessages(HandDescription hand, FoxgloveImage image = FoxgloveImage::kValues);

  const std::vector<FoxgloveChannel>& channels() const noexcept { return channels_; }
  // Why the hand is not shown in space though it is described; empty otherwise.
  const std::string& geometryProblem() const noexcept { return geometryProblem_; }
  std::size_t numImages() const noexcept { return hand_.layout->numMatrices(); }

  // Numbers of channels; images have the numbers of their matrices.
  std::size_t signalsChannel() const noexcept { return signals_; }
  std::size_t eventsChannel() const noexcept { return events_; }
  std::optional<std::size_t> jointsChannel() const noexcept { return joints_; }
  std::optional<std::size_t> transformsChannel() const noexcept { return transforms_; }
  std::optional<std::size_t> taxelsChannel() const noexcept { return taxels_; }
  std::optional<std::size_t> shapesChannel() const noexcept { return shapes_; }

  // foxglove.RawImage of one matrix, row 0 (the fingertip) on top. Throws std::out_of_range.
  std::string image(const TactileFrame& frame, std::size_t matrix) const;
  // foxglove.JointStates; position in rad or m.
  std::string joints(const Sample& angles) const;
  // foxglove.Log: a warning for gaps, faults and alarms, information otherwise.
  std::string event(const Event& event) const;

  // Computes the pose for transforms() and taxels(). Returns false where it is not known: no
  // geometry, no angles yet, another number of angles, or angles that are not finite.
  bool setPose(const LiveResults& results);
  // foxglove.FrameTransforms: from the root link to each link of the URDF (from its parent), by the
  // URDF's names, and to each matrix, "tactile/NAME". Without a URDF the root is "hand".
  std::string transforms(std::int64_t timeUs) const;
  // foxglove.PointCloud in the frame of the root: x, y, z [m], value, and its colour, for each
  // taxel.
  std::string taxels(const TactileFrame& frame) const;
  // foxglove.SceneUpdate with the visible shapes of the links, each fixed to its link.
  std::string shapes(std::int64_t timeUs) const;

 private:
  // A link, in the frame of its place.
  struct Frame {
    std::string name;
    std::string text;                   // its name as a JSON text
    std::optional<std::size_t> parent;  // empty: the root
    LinkPlace place;
    Eigen::Isometry3d placeFromFrame = Eigen::Isometry3d::Identity();
  };

  std::size_t addChannel(FoxgloveChannel channel);
  void makeFrames();
  const Frame& frameAt(const LinkPlace& place) const;
  FoxgloveColor colorOf(float value) const noexcept;

  const HandDescription hand_;
  const FoxgloveImage image_;
  const bool countsOnly_;
  std::unique_ptr<const HandGeometry> geometry_;
  std::string geometryProblem_;
  HandPose pose_;
  std::vector<FoxgloveChannel> channels_;
  std::vector<std::string> frameIds_;  // of the matrices, as JSON texts
  std::vector<Frame> frames_;          // the root first
  std::vector<HandJoint> handJoints_;
  std::vector<std::string> jointNames_;  // of them, as JSON texts
  std::size_t signals_ = 0, events_ = 0;
  std::optional<std::size_t> joints_, transforms_, taxels_, shapes_;
};

}  // namespace palpate
