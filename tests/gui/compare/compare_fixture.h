// A window with recordings that can be compared: "early" and "late" are grasps whose contacts are a
// second apart.
#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>
#include <algorithm>

#include "palpate/device/sdh2.h"
#include <palpate/model/profile_builder.h>

#include "gui/compare/compare_chart.h"
#include "gui/compare/compare_feature.h"
#include "gui/compare/compare_panel.h"
#include "gui/compare/compare_strip.h"
#include "gui/compare/compare_view.h"
#include "gui/export/export_controller.h"
#include "gui/matrices/matrices_view.h"
#include "gui/testing/sample_profiles.h"
#include "gui/testing/window_fixture.h"
#include "testing/wrist_profile.h"

namespace palpate::gui {

// `count` frames 50 ms apart from `beginMs` on, at rest until `touched`, then `counts` on twelve
// taxels.
inline Profile grasped(std::size_t count,
                       std::size_t touched,
                       float counts,
                       std::int64_t beginMs = 0) {
  ProfileBuilder builder(sdh2().layout);
  for (std::size_t i = 0; i < count; ++i) {
    TactileFrame frame = emptyFrame();
    if (i >= touched)
      frame.matrix(1).block(5, 1, 3, 4).setConstant(counts + static_cast<float>(i - touched));
    builder.addFrame(1'400'000'000'000'000 + (beginMs + static_cast<std::int64_t>(i) * 50) * 1000,
                     frame.values);
  }
  return builder.finish({});
}

// Grasps of 25 frames with two fingers, each after 10 frames at rest, 50 ms apart: `counts` of each
// grasp, one more per frame.
inline Profile manyGrasps(const std::vector<float>& counts) {
  ProfileBuilder builder(sdh2().layout);
  std::int64_t frame = 0;
  for (const float of : counts)
    for (int i = 0; i < 35; ++i, ++frame) {
      TactileFrame tactile = emptyFrame();
      if (i >= 10)
        for (const std::size_t matrix : {1u, 3u, 5u})
          tactile.matrix(matrix).block(5, 1, 3, 4).setConstant(of + static_cast<float>(i - 10));
      builder.addFrame(1'400'000'000'000'000 + frame * 50'000, tactile.values);
    }
  return builder.finish({});
}

inline Profile pad() {
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(4, 4, 2.0)});
  ProfileBuilder builder(layout);
  for (int i = 0; i < 10; ++i)
    builder.addFrame(1'400'000'000'000'000 + i * 50'000, std::vector<float>(16, 30.0F));
  return builder.finish({});
}

class CompareWindowFixture : public WindowTest {
 protected:
  CompareWindowFixture() {
    environment_.read = asRecording([](const std::filesystem::path& path, const Progress&) {
      const std::string name = path.stem().string();
      if (name == "wrist" || name == "other_wrist")
        return testing::withWrist(grasped(60, 10, 500.0F));
      if (name == "early") return grasped(60, 10, 500.0F);
      if (name == "late") return grasped(80, 30, 300.0F, 3'600'000);
      if (name == "third") return grasped(40, 5, 100.0F);
      if (name == "untouched") return grasped(20, 20, 0.0F);
      if (name == "one") return grasped(1, 0, 50.0F);
      if (name == "three") return manyGrasps({500.0F, 600.0F, 700.0F});
      if (name == "two") return manyGrasps({300.0F, 400.0F});
      if (name == "pad") return pad();
      if (name == "empty") return profileWithStamps({});
      return twentyFrames();
    });
    // The figures below are of means.
    WindowTest::choose("signalsPlotted", 0);
  }
  ComparePanel& compare() { return window().feature<CompareFeature>().panel(); }
  void compareNow() {
    press(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
    settle();
  }
  void settle() {
    QElapsedTimer clock;
    clock.start();
    do {
      QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
    } while (compare().hasPair() && window().state().comparison.on() && !compare().complete() &&
             clock.elapsed() < 10'000);
    QCoreApplication::processEvents();
  }
  void choose(const char* name, const QString& text) {
    auto* box = find<QComboBox>(name);
    const int index = box->findText(text);
    ASSERT_GE(index, 0) << name << " " << text.toStdString();
    box->setCurrentIndex(index);
    emit box->activated(index);
    settle();
  }
  QString name(const OpenedRecordingPtr& recording) {
    return recording ? QString::fromStdString(recording->path.stem().string()) : QString();
  }
  float valueIn(CompareGroup group, int y = 6, int x = 2) {
    const auto& frame = compare().view().frames()[static_cast<std::size_t>(group)].frame;
    return frame.values.empty() ? -1.0F : frame.matrix(1)(y, x);
  }
  void drag(QWidget& widget,
            const QPointF& from,
            const QPointF& to,
            Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    const auto send = [&](QEvent::Type type, const QPointF& at, Qt::MouseButtons held) {
      QMouseEvent event(type, at, widget.mapToGlobal(at), Qt::LeftButton, held, modifiers);
      QApplication::sendEvent(&widget, &event);
    };
    send(QEvent::MouseButtonPress, from, Qt::LeftButton);
    send(QEvent::MouseMove, (from + to) / 2, Qt::LeftButton);
    send(QEvent::MouseMove, to, Qt::LeftButton);
    send(QEvent::MouseButtonRelease, to, Qt::NoButton);
    settle();
  }
  QDockWidget* dock(const char* name) { return window().findChild<QDockWidget*>(name); }
};

}  // namespace palpate::gui
