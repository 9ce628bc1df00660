// The panel of the dock Calibrate by itself, and recordings of loads.
#pragma once

#include <QApplication>
#include <QCoreApplication>
#include <QSettings>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include <palpate/model/profile_builder.h>

#include "gui/calibrate/calibrate_panel.h"
#include "gui/testing/fake_ask.h"
#include "gui/widgets/figures_table.h"
#include "testing/testing.h"

namespace palpate::gui {

inline constexpr double kRateHz = 40.0;
inline constexpr double kT1 = 0.5, kT2 = 0.1;  // [s]
inline constexpr double kDrift = 2.0;          // [counts/s]

// a(t) of the study (eq. 3.1), written down anew.
inline double response(double gain, double t) {
  if (t <= 0.0 || gain <= 0.0) return 0.0;
  const double phi = 1.0 - (kT1 * std::exp(-t / kT1) - kT2 * std::exp(-t / kT2)) / (kT1 - kT2);
  return gain * phi + kDrift * t;
}

// Loads on nine taxels of a matrix, one after the other: on from 1 s to 9 s of every ten. A motor's
// temperature where it is told.
inline Profile loads(std::size_t matrix, const std::vector<double>& gains, double degC = 0.0) {
  const HandDescription& hand = sdh2();
  ProfileBuilder builder(hand.layout);
  const int perLoad = static_cast<int>(10.0 * kRateHz);
  for (std::size_t load = 0; load < gains.size(); ++load)
    for (int i = 0; i < perLoad; ++i) {
      TactileFrame frame(hand.layout);
      const double t = i / kRateHz - 1.0;
      const double value = t < 8.0 ? std::round(response(gains[load], t)) : 0.0;
      for (int y = 4; y < 7; ++y)
        for (int x = 1; x < 4; ++x) frame.matrix(matrix)(y, x) = static_cast<float>(value);
      const double at = (static_cast<double>(load) * perLoad + i) / kRateHz;
      builder.addFrame(1'400'000'000'000'000 + static_cast<std::int64_t>(at * 1e6), frame.values);
    }
  if (degC > 0.0)
    builder.addTemperatures(1'400'000'000'000'000,
                            std::vector<double>(hand.temperatureSensors.size(), degC));
  return builder.finish({});
}

class CalibratePanelTest : public ::testing::Test {
 protected:
  CalibratePanelTest() {
    panel_->resize(680, 700);
    applyTheme(*qApp, Theme::kDark);
  }
  OpenedRecordingPtr opened(Profile profile) {
    return makeOpenedRecording(folder_ / "r.dsa", std::move(profile));
  }
  void show(const QString& page, const OpenedRecordingPtr& recording) {
    panel_->show();
    panel_->showPage(page);
    panel_->setSource(recording, false);
    settle();
  }
  void settle() {
    panel_->settle();
    QCoreApplication::processEvents();
  }
  QString why() { return panel_->page().emptyText(); }
  template <class Widget>
  Widget* find(const char* name) {
    return panel_->findChild<Widget*>(name);
  }
  QString cell(const char* table, int row, int column) {
    return find<FiguresTable>(table)->item(row, column)->text();
  }
  testing::TemporaryFolder folder_;
  QSettings settings_{QString::fromStdString((folder_ / "palpate.ini").string()),
                      QSettings::IniFormat};
  FakeAsk ask_;
  std::unique_ptr<CalibratePanel> panel_ = std::make_unique<CalibratePanel>(settings_, ask_);
};

}  // namespace palpate::gui
