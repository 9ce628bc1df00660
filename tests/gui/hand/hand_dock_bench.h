// Test bench: the dock Hand on an emulated hand.
#pragma once

#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QTest>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "control/emulated_bench.h"
#include "gui/hand/hand_dock.h"
#include "gui/hand/hand_feature.h"
#include "gui/testing/fake_ask.h"
#include "gui/widgets/value_slider.h"
#include "testing/testing.h"

namespace palpate::gui {

class HandDockBench : public ::testing::Test {
 protected:
  HandDockBench()
      : settings_(QString::fromStdString((folder_ / "palpate.ini").string()), QSettings::IniFormat),
        dock_(newDock()) {
    dock_->resize(455, 800);
    dock_->show();
  }
  ~HandDockBench() override { dock_->setHand(nullptr, nullptr); }

  void connectTo(std::unique_ptr<HandModel> model, EmulatedHandOptions options = {}) {
    bench_ = std::make_unique<testing::EmulatedBench>(std::move(model), std::move(options));
    bench_->connect();
    dock_->setHand(bench_->session.get(), bench_->control.get());
  }
  // As the next session makes it.
  std::unique_ptr<HandDock> newDock() {
    return std::make_unique<HandDock>(settings_, ask_, actions_);
  }
  template <class Widget>
  Widget* find(const char* name) {
    auto* found = dock_->findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("no ") + name);
    return found;
  }
  void click(const char* name) { QTest::mouseClick(find<QPushButton>(name), Qt::LeftButton); }
  QString state() { return find<QLabel>("handState")->text(); }
  bool isEnabled(const char* name) { return find<QPushButton>(name)->isEnabled(); }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  void type(const char* slider, const QString& text) {
    QDoubleSpinBox* field = find<ValueSlider>(slider)->field();
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
    field->clearFocus();
  }
  std::vector<MatrixSetting> onTheHand() {
    std::vector<MatrixSetting> settings;
    bench_->hand->withModel([&](HandModel& model) { settings = model.settings(); });
    return settings;
  }

  const testing::TemporaryFolder folder_;
  QSettings settings_;
  FakeAsk ask_;
  QWidget window_;
  ActionRegistry registry_{&window_};
  const HandActions actions_{registry_};
  std::unique_ptr<testing::EmulatedBench> bench_;
  std::unique_ptr<HandDock> dock_;
};

}  // namespace palpate::gui
