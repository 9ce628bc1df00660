#include "commands/demo_pictures.h"

#include "palpate/core/error.h"

#include "commands/commands.h"
#include "commands/render_hand.h"
#include "gui/desktop/application.h"
#include "gui/picture/picture_export.h"
#include "gui/shell/run_window.h"

namespace palpate::commands {
namespace {

constexpr QSizeF kHandPictureSize{420, 400};

}  // namespace

DemoPictures::DemoPictures() {
  drawWithoutDisplay();
  application_ = gui::makeApplication(count_, arguments_);
}

void DemoPictures::drawWindow(const std::filesystem::path& recording,
                              std::optional<std::size_t> frame,
                              const std::vector<std::string>& docks,
                              const std::filesystem::path& out) const {
  gui::ScreenshotOptions options;
  options.out = out;
  options.file = recording;
  options.frame = frame;
  options.docks = docks;
  options.dataFolder = dataFolder();
  int count = count_;
  char* arguments[] = {arguments_[0], nullptr};
  if (gui::takeScreenshot(count, arguments, options) != kDone) throw Error("no picture");
}

std::string DemoPictures::handPng(const Profile& profile, std::size_t frame) const {
  gui::MatricesPictureOptions page;
  page.size = kHandPictureSize;
  page.font = QGuiApplication::font();
  page.colorBar = false;
  gui::PicturePaper paper;
  paper.size = page.size;
  page.pixelRatio = paper.scale();
  paper.background = gui::colorsOf(page.theme).window;
  const auto paint = handPainter(HandRendering(), profile, {frame, frame}, page);
  return gui::pictureBytes(
             gui::ImageFormat::kPng,
             [&](QPainter& painter) { paint(painter, frame); },
             paper,
             "picture.png")
      .toStdString();
}

}  // namespace palpate::commands
