// Two open recordings side by side on one axis of time: heat maps of A, of B and of A - B at the
// same moment, their curves on top of each other, one cursor.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/core/text_table.h>
#include <palpate/signals/frame_difference.h>

#include "gui/appearance/window_settings.h"
#include "gui/compare/compare_painter.h"
#include "gui/compare/compare_worker.h"
#include "gui/picture/exported_view.h"
#include "gui/source/opened_recording.h"

class QAction;
class QComboBox;
class QLabel;
class QPushButton;
class QStackedWidget;

namespace palpate::gui {

class CompareChart;
class CompareHeader;
class CompareStrip;
class CompareView;

class ComparePanel : public QWidget {
  Q_OBJECT
 public:
  ComparePanel(QAction* leave, QAction* interpolated, QAction* values, QWidget* parent = nullptr);
  ~ComparePanel() override;

  // What is open, and which of it is A; null: none. B stays while it is open; else it is the first
  // other one, or what was opened because the panel asked for it.
  void setRecordings(const std::vector<OpenedRecordingPtr>& recordings,
                     const OpenedRecordingPtr& a);
  void setB(const OpenedRecordingPtr& b);  // may be A, too
  // Look, range, signal.
  void setSettings(const ViewSettings& settings, Theme theme);
  // Work is done only while somebody looks.
  void setActive(bool on);

  void setAlignment(Alignment alignment);
  Alignment alignment() const noexcept { return alignment_; }
  // Seconds from A's first frame to B's; nothing while it isn't known.
  std::optional<double> offsetS() const;
  void setOffset(double offsetS);  // by hand
  // The moment that is shown, from A's first frame [s].
  void setTime(double seconds);
  double timeS() const noexcept { return timeS_; }

  const OpenedRecordingPtr& a() const noexcept { return a_; }
  const OpenedRecordingPtr& b() const noexcept { return b_; }
  std::optional<TimeSpan> common() const;  // nothing: not known, or there is none
  bool hasPair() const;
  // What has to be said of these two; empty: nothing.
  QString notice() const;
  // "correlation 0.931 · ..", once it is known.
  QString figures() const;
  bool complete() const noexcept { return answer_.complete; }
  CompareView& view() noexcept { return *view_; }
  CompareChart& chart() noexcept { return *chart_; }
  CompareStrip& strip() noexcept { return *strip_; }
  CompareWorker& worker() noexcept { return worker_; }

  // Of what is shown: a picture of heat maps and curves; figures per matrix; the curves.
  void paint(QPainter& painter, const PictureLook& look) const;
  TextTable differenceTable() const;
  TextTable curveTable() const;

 signals:
  void aChosen(const palpate::gui::OpenedRecordingPtr& recording);
  // What was B is to be A, and the moment that is shown is this one of it [s].
  void swapRequested(const palpate::gui::OpenedRecordingPtr& recording, double timeS);
  void seekRequested(double seconds);  // from A's first frame
  void signalChosen(palpate::gui::PlottedSignal signal);
  void alignmentChanged();
  void openRequested();
  void hovered(const QString& text);

 private:
  // compare_panel.cpp: parts, what is compared
  void build(QAction* leave, QAction* interpolated, QAction* values);
  QWidget* makeEmpty();
  QWidget* makeCurveHeader();
  void connectParts();
  void pairChanged();
  void fillMatrices();
  void ask();
  void take(const CompareAnswer& answer);
  void moveTo(double offsetS, bool keepSeen);
  void swap();
  void askForAnother();
  // What is seen of it.
  void showEmpty();
  void showCurves();
  void showFrames();
  void showLook();
  void showNotice();
  ComparePictureOptions pictureOptions() const;
  QString captionOf(bool ofB, const std::optional<std::size_t>& frame) const;
  QString absenceOf(bool ofB) const;

  std::vector<OpenedRecordingPtr> recordings_;
  OpenedRecordingPtr a_;
  OpenedRecordingPtr b_;
  std::optional<FrameComparison> comparison_;
  CompareAnswer answer_;
  Alignment alignment_ = Alignment::kContact;
  double handOffsetS_ = 0.0;
  double timeS_ = 0.0;
  bool active_ = false;
  bool asked_ = false;       // the worker has the newest question
  bool wantsNew_ = false;    // B is to be what is opened next
  bool withItself_ = false;  // B is A because somebody wants it so
  ViewSettings settings_;
  Theme theme_ = Theme::kDark;

  CompareHeader* header_ = nullptr;
  QStackedWidget* stack_ = nullptr;
  QLabel* emptyText_ = nullptr;
  QPushButton* emptyOpen_ = nullptr;
  QPushButton* emptyItself_ = nullptr;
  QLabel* notice_ = nullptr;
  CompareView* view_ = nullptr;
  QComboBox* signal_ = nullptr;
  QComboBox* matrix_ = nullptr;
  QLabel* figures_ = nullptr;
  CompareStrip* strip_ = nullptr;
  CompareChart* chart_ = nullptr;
  CompareWorker worker_;  // last: ends first
};

}  // namespace palpate::gui
