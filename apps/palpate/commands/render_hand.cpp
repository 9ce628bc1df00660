#include "commands/render_hand.h"

#include <algorithm>
#include <string>
#include <vector>

#include "palpate/core/error.h"

#include "commands/hand_options.h"
#include "gui/hand3d/hand_frame_painter.h"
#include "gui/hand3d/hand_look.h"
#include "gui/hand3d/hand_picture.h"
#include "gui/hand3d/hand_scene_builder.h"

namespace palpate::commands {
namespace {

constexpr std::size_t kLooks = 12;  // frames that the camera must show completely

constexpr std::array<OptionWord<gui::SphereOf>, 2> kSphereOfWords{
    {{"taxels", gui::SphereOf::kTaxels}, {"centroids", gui::SphereOf::kCentroids}}};

// Names as words of the command line: "flat cells" becomes "flat-cells".
template <class All>
auto lookWords(const All& all) {
  return wordsOf(all, [](auto each) { return nameOf(each).replace(' ', '-').toStdString(); });
}

gui::HandLook lookOf(const CommandLine& given, const Profile& profile) {
  gui::HandLook look;
  look.taxels = given.chosen("taxels", lookWords(gui::kAllTaxelShapes)).value_or(look.taxels);
  look.sphere = given.chosen("sphere", lookWords(gui::kAllSphereLooks)).value_or(look.sphere);
  look.sphereOf = given.chosen("sphere-of", kSphereOfWords).value_or(look.sphereOf);
  look.normals = given.has("normals");
  look.wire = given.has("wire");
  look.axes = given.has("axes");
  look.contacts = !given.has("no-contacts");
  if (const auto matrix = given.integer("matrix", kMatrixOption)) {
    const std::size_t count = profile.layout().numMatrices();
    if (static_cast<std::uint64_t>(*matrix) >= count)
      throw Error("there is no matrix " + std::to_string(*matrix) + ", only 0.." +
                  std::to_string(count - 1));
    look.only = static_cast<std::size_t>(*matrix);
  }
  return look;
}

}  // namespace

std::vector<OptionSpec> handViewOptions() {
  return {{"angles", "A0,A1,..", "hand: joint angles [deg] assumed where none are recorded"},
          worded("taxels", "NAME", "of the hand", lookWords(gui::kAllTaxelShapes), "cells"),
          worded("sphere", "NAME", "of the hand", lookWords(gui::kAllSphereLooks), "glass"),
          worded("sphere-of", "NAME", "of the hand", kSphereOfWords, "taxels"),
          rangedWhole("matrix", "M", "hand: only this matrix", kMatrixOption),
          {"camera", "AZ,EL", "hand: direction of the camera, about z and above the palm [deg]"},
          {"normals", "", "hand: the taxels' normals"},
          {"no-contacts", "", "hand: without centroids and axes of the contacts"},
          {"wire", "", "hand: a wire frame"},
          {"axes", "", "hand: axes of its base"}};
}

void checkHandUsage(const CommandLine& given) {
  const std::string view = given.choice("view", {"matrices", "hand", "both"}).value_or("matrices");
  const bool hand = view != "matrices";
  for (const OptionSpec& option : handViewOptions())
    if (!hand && given.has(option.name))
      throw UsageError("--" + std::string(option.name) + " needs --view hand or both");
  for (const char* name : {"interpolated", "values"})
    if (view == "hand" && given.has(name))
      throw UsageError("--" + std::string(name) + " is for the heat maps, not for --view hand");
  anglesOf(given);
  if (const auto camera = given.text("camera")) {
    const auto numbers = numbersOf(*camera, "camera", 2);
    if (numbers[1] < -89.0 || numbers[1] > 89.0)
      throw UsageError("--camera: the camera must be -89 to 89 degrees above the palm");
  }
}

gui::FramePictures::Paint handPainter(const CommandLine& given,
                                      const Profile& profile,
                                      const gui::FrameSpan& span,
                                      const gui::MatricesPictureOptions& page) {
  // For recordings without joint angles; empty: the hand at rest.
  const auto assumedDeg = anglesOf(given, profile.hand()).value_or(std::vector<double>());
  gui::HandPictureOptions options;
  options.page = page;
  options.look = lookOf(given, profile);
  gui::HandSceneBuilder drawing;
  drawing.setHand(profile.hand(), true);
  std::vector<Eigen::Vector3d> seen;
  for (std::size_t i = 0; i <= std::min(kLooks, span.count() - 1); ++i) {
    const std::size_t frame = span.first + (span.count() - 1) * i / kLooks;
    const auto angles = profile.anglesAtFrame(frame);
    drawing.setMoment(profile.frame(frame), angles ? angles->values : assumedDeg);
    const auto extent = drawing.extent(options.look);
    seen.insert(seen.end(), extent.begin(), extent.end());
  }
  options.camera = drawing.usualCamera(options.look);
  if (const auto camera = given.text("camera")) {
    const auto numbers = numbersOf(*camera, "camera", 2);
    options.camera.azimuthDeg = numbers[0];
    options.camera.elevationDeg = numbers[1];
  }
  options.camera.fit(seen, page.size.width() / page.size.height());
  return gui::handFramePainter(profile, options, assumedDeg);
}

}  // namespace palpate::commands
