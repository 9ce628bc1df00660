#include "gui/shell/start_scene.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <palpate/recording/recording.h>

#include "gui/hand3d/hand_frame_painter.h"
#include "gui/matrices/matrices_frame_painter.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {

struct StartScene::Film {
  std::mutex mutex;
  std::vector<QImage> pictures;
};

namespace {

constexpr int kPictureMs = 100;   // of the film and of the recording
constexpr double kBeforeS = 1.0;  // of the recording, before the first contact
constexpr std::size_t kMaxPictures = 60;
constexpr std::size_t kPausePictures = 10;  // at the end
constexpr int kHeightLines = 15;
constexpr double kHandShare = 0.45;   // of the width
constexpr double kStartNearer = 0.8;  // than the usual camera
constexpr double kRoundedPx = 8.0;
// The thread that paints leaves most of the processor to others.
constexpr auto kBetweenPictures = std::chrono::milliseconds(60);

// From just before the first contact until the hand has let go.
std::vector<std::size_t> framesOf(const OpenedRecording& recording) {
  std::vector<std::size_t> frames;
  const std::vector<CharacteristicSignals>& whole = recording.whole;
  const auto touches = [](const CharacteristicSignals& all) { return all.active > 0; };
  const auto first = std::find_if(whole.begin(), whole.end(), touches);
  const auto end = std::find_if_not(first, whole.end(), touches);
  if (first == whole.end()) return frames;
  double nextS = recording.timeS[static_cast<std::size_t>(first - whole.begin())] - kBeforeS;
  for (std::size_t i = 0; i < static_cast<std::size_t>(end - whole.begin()); ++i) {
    if (recording.timeS[i] < nextS || frames.size() == kMaxPictures) continue;
    frames.push_back(i);
    nextS = std::max(nextS, recording.timeS[i] - kPictureMs / 2e3) + kPictureMs / 1e3;
  }
  return frames;
}

}  // namespace

StartScene::StartScene(std::filesystem::path recording, QWidget* parent)
    : QWidget(parent),
      recording_(std::move(recording)),
      film_(std::make_shared<Film>()),
      painting_(BackgroundJob::Leaving::kAtOnce) {
  setAccessibleName("A recorded grasp of the emulated hand");
  setToolTip("A recorded grasp of the emulated hand. Click to move it yourself.");
  setCursor(Qt::PointingHandCursor);
  fitToText(*this, [this] { setFixedHeight(kHeightLines * fontMetrics().height()); });
  connect(&timer_, &QTimer::timeout, this, [this] {
    const std::size_t count = numPictures();
    if (count == 0 || window()->isMinimized()) return;
    at_ = (at_ + 1) % (count + (painting_.busy() ? 0 : kPausePictures));
    if (at_ < count) update();
  });
}

std::size_t StartScene::numPictures() const {
  const std::lock_guard lock(film_->mutex);
  return film_->pictures.size();
}

void StartScene::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  timer_.start(kPictureMs);
  if (numPictures() > 0 || painting_.busy()) return;
  // Once the page has its size, and has been seen.
  QTimer::singleShot(kPictureMs, this, [this] {
    const auto paint = [path = recording_,
                        size = QSizeF(QWidget::size()),
                        ratio = devicePixelRatioF(),
                        font = this->font(),
                        film = film_](const Progress& progress) {
      const OpenedRecordingPtr recording = makeOpenedRecording(path, readRecording(path), progress);
      HandPictureOptions options;
      MatricesPictureOptions& page = options.page;
      page.size = {size.width() * (1.0 - kHandShare), size.height()};
      page.rangeMax = recording->maximum;
      page.theme = Theme::kDark;
      page.colorBar = false;
      page.pixelRatio = ratio;
      page.font = font;
      options.look.sphere = SphereLook::kNone;
      options.camera.distanceMm *= kStartNearer;
      const FramePictures::Paint matrices = matricesFramePainter(recording, page);
      page.size.setWidth(size.width() * kHandShare);
      const FramePictures::Paint hand = handFramePainter(recording->profile, options, {});
      const std::vector<std::size_t> frames = framesOf(*recording);
      for (std::size_t i = 0; i < frames.size(); ++i) {
        reportProgress(progress, i, frames.size());
        QImage picture((size * ratio).toSize(), QImage::Format_RGB32);
        picture.setDevicePixelRatio(ratio);
        QPainter painter(&picture);
        hand(painter, frames[i]);
        painter.translate(page.size.width(), 0.0);
        matrices(painter, frames[i]);
        painter.end();
        {
          const std::lock_guard lock(film->mutex);
          film->pictures.push_back(std::move(picture));
        }
        std::this_thread::sleep_for(kBetweenPictures);
      }
    };
    painting_.start({}, paint);
  });
}

void StartScene::hideEvent(QHideEvent* event) {
  timer_.stop();
  QWidget::hideEvent(event);
}

void StartScene::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath rounded;
  rounded.addRoundedRect(rect(), kRoundedPx, kRoundedPx);
  painter.setClipPath(rounded);
  painter.fillRect(rect(), colorsOf(Theme::kDark).window);
  const std::lock_guard lock(film_->mutex);
  if (!film_->pictures.empty())
    painter.drawImage(QPoint(), film_->pictures[std::min(at_, film_->pictures.size() - 1)]);
}

void StartScene::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && rect().contains(event->pos())) emit clicked();
}

}  // namespace palpate::gui
