// The content of the dock Hand: moving it, what its matrices are set to, its joints and
// temperatures. A Stop that is always there, whatever is scrolled or folded away, and by Escape
// from everywhere.
#pragma once

#include <QSettings>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/control/grasp_control.h>

#include "gui/appearance/theme.h"

class QAction;
class QLabel;
class QPushButton;
class QScrollArea;

namespace palpate::gui {

struct HandActions;
class FactsView;
class GraspPanel;
class SensitivityModes;
class StopKey;
class TactileSettingsPanel;

class HandDock : public QWidget {
  Q_OBJECT
 public:
  // Remembers choices and named settings in `settings`, which must outlive it.
  explicit HandDock(QSettings& settings, QWidget* parent = nullptr);
  ~HandDock() override;
  // The hand that is connected, null: none. Both must outlive this, or be taken away by null before
  // they end.
  void setHand(CaptureSession* session, GraspControl* control);
  // Menu entries and keys do what the buttons do, and can be chosen when those can. Once.
  void bind(const HandActions& actions);
  void setTheme(Theme theme);
  TactileSettingsPanel& tactileSettings() noexcept { return *tactile_; }
  const std::vector<QString>& unmeasurable() const noexcept {
    return unmeasurable_;
  }  // as unmeasurableChanged()
  SensitivityModes& sensitivity() noexcept { return *sensitivity_; }
  // What the timer does while a hand is connected.
  void refresh();
  QSize sizeHint() const override { return {455, 640}; }

 signals:
  void stopPressed();
  void asked();  // a motion was begun by it, or refused
  // Why matrices can't tell the limit that is chosen: one text per matrix, empty: it can; none: all
  // can.
  void unmeasurableChanged(const std::vector<QString>& why);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeHead();
  QWidget* makeBody(QSettings& settings);
  void say(const QString& text, bool bad);
  void showState(const GraspStatus& status);
  void showBound();
  void showUnmeasurable(const std::vector<MatrixSettings>& settings);
  QString phaseText(const GraspStatus& status) const;
  QString motionBlockedReason(const GraspStatus& status) const;
  std::optional<QString> lastGraspText(const GraspReport& report, const GraspStatus& status) const;
  void showSamples();
  void showTemperatures(const Temperatures& temperatures);

  QScrollArea* body_ = nullptr;
  CaptureSession* session_ = nullptr;
  GraspControl* control_ = nullptr;
  std::shared_ptr<CaptureQueue> queue_;
  std::vector<CaptureItem> items_;
  QLabel* state_;
  QLabel* heat_;
  QPushButton* stop_;
  GraspPanel* grasp_;
  SensitivityModes* sensitivity_;
  TactileSettingsPanel* tactile_;
  FactsView* angles_;
  FactsView* temperatures_;
  StopKey* stopKey_;
  QTimer timer_;
  std::optional<std::int64_t> goneUs_;  // when the hand could not be moved last [us since 1970]
  QString said_;                        // a refusal, until something else is asked for
  std::vector<std::pair<QAction*, QPushButton*>> bound_;
  std::vector<QString> unmeasurable_;
  // What unmeasurable_ was judged by.
  struct Judged {
    std::vector<MatrixSettings> settings;
    std::shared_ptr<const SensorLayout> layout;
    std::string preshape;
    int limitCounts = 0;
    bool operator==(const Judged&) const = default;
  };
  std::optional<Judged> judged_;
  std::shared_ptr<const SensorLayout> layout_;  // of the newest frame, its masks; null: none came
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui
