// The comparison of two open recordings on one time axis: heat maps of A, B and A - B at the same
// moment, their curves in one chart, and one cursor.
#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/core/text_table.h>
#include <palpate/signals/frame_difference.h>

#include "gui/appearance/window_settings.h"
#include "gui/chart/plotted_curve.h"
#include "gui/compare/compare_painter.h"
#include "gui/compare/compare_worker.h"
#include "gui/picture/exported_view.h"
#include "gui/source/opened_recording.h"

class QAction;
class QComboBox;
class QGridLayout;
class QBoxLayout;
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

  // Sets the open recordings, and which of them is A (null: none). B is kept while it is open; else
  // B is the first other recording, or the one that was opened because the panel asked for it.
  void setRecordings(const std::vector<OpenedRecordingPtr>& recordings,
                     const OpenedRecordingPtr& a);
  // Sets B; it may be the same recording as A.
  void setB(const OpenedRecordingPtr& b);
  // Sets appearance, colour range and plotted signal.
  void setSettings(const ViewSettings& settings);
  // Switches computing on or off; the panel computes only while it is visible.
  void setActive(bool on);

  void setAlignment(Alignment alignment);
  Alignment alignment() const noexcept { return alignment_; }
  // Time from A's first frame to B's first frame [s]; nothing while it is unknown.
  std::optional<double> offsetS() const;
  // Sets the offset manually [s].
  void setOffset(double offsetS);
  // Chooses the grasps that kGrasp aligns, by their indices.
  void setGrasps(std::size_t ofA, std::size_t ofB);
  // What the chart shows besides A and B.
  void setOverlay(CompareOverlay overlay);
  CompareOverlay overlay() const noexcept { return overlay_; }
  void setBand(CompareBand band);
  CompareBand band() const noexcept { return band_; }
  // Tells the events of a recording as they are now; by default those of its file.
  using Events = std::function<std::vector<Event>(const OpenedRecordingPtr&)>;
  void setEvents(Events events) { events_ = std::move(events); }
  // Sets the shown moment: time since A's first frame [s].
  void setTime(double seconds);
  double timeS() const noexcept { return timeS_; }

  const OpenedRecordingPtr& a() const noexcept { return a_; }
  const OpenedRecordingPtr& b() const noexcept { return b_; }
  // The time span that both recordings share; nothing when it is unknown or empty.
  std::optional<TimeSpan> common() const;
  bool hasPair() const;
  // What the user must know about these two recordings; empty when there is nothing to say.
  QString notice() const;
  // "correlation 0.931 · ..", once the figures are computed.
  QString figures() const;
  bool complete() const noexcept { return answer_.complete; }
  CompareView& view() noexcept { return *view_; }
  CompareChart& chart() noexcept { return *chart_; }
  CompareStrip& strip() noexcept { return *strip_; }

  // Exports: a picture of the heat maps and curves, a table of figures for each matrix, and a table
  // of the curves.
  void paint(QPainter& painter, const PictureLook& look) const;
  TextTable differenceTable() const;
  TextTable curveTable() const;
  bool hasAverage() const noexcept { return !answer_.overlaid.averages.empty(); }
  TextTable averageTable() const;

 signals:
  void aChosen(const palpate::gui::OpenedRecordingPtr& recording);
  // B is to become A; the shown moment is then at `timeS` since its first frame [s].
  void swapRequested(const palpate::gui::OpenedRecordingPtr& recording, double timeS);
  // [s] since A's first frame
  void seekRequested(double seconds);
  void signalChosen(palpate::gui::PlottedSignal signal);
  void alignmentChanged();
  // The overlay or the band was chosen.
  void overlayChanged();
  void openRequested();
  void hovered(const QString& text);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  // Building the panel, and which recordings it compares (compare_panel.cpp).
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
  // Showing the results.
  void showEmpty();
  // Goes to the common contact when the comparison is at its begin.
  void openAtContact();
  QString overlaidText() const;
  void showCurves();
  // Unit of the values of A.
  QString handUnit() const;
  // What is compared of a matrix: of A, which may have readings.
  bool givesReadings() const;
  PlottedSignal plottedSignal() const;
  void showSignal();
  // The column of a further series that is compared instead of a matrix; null: none.
  const PlottedCurve* column() const;
  // What tables have of it.
  QString baseUnit() const;
  void showFrames();
  void showLook();
  void showNotice();
  void placeFigures();
  ComparePictureOptions pictureOptions() const;
  QString captionOf(bool ofB, const std::optional<std::size_t>& frame) const;
  QString absenceOf(bool ofB) const;

  std::vector<OpenedRecordingPtr> recordings_;
  OpenedRecordingPtr a_;
  OpenedRecordingPtr b_;
  // Columns of A's further series that can be chosen, behind the matrices.
  std::vector<PlottedCurve> columns_;
  std::optional<FrameComparison> comparison_;
  CompareAnswer answer_;
  Alignment alignment_ = Alignment::kContact;
  double handOffsetS_ = 0.0;
  std::size_t graspA_ = 0;
  std::size_t graspB_ = 0;
  CompareOverlay overlay_ = CompareOverlay::kPair;
  CompareBand band_ = CompareBand::kNone;
  Events events_;
  double timeS_ = 0.0;
  bool active_ = false;
  // The worker has the newest question.
  bool asked_ = false;
  // The next recording that is opened becomes B.
  bool wantsNew_ = false;
  // B is the same as A because the user chose so.
  bool withItself_ = false;
  ViewSettings settings_;

  CompareHeader* header_ = nullptr;
  QStackedWidget* stack_ = nullptr;
  QLabel* emptyText_ = nullptr;
  QPushButton* emptyOpen_ = nullptr;
  QPushButton* emptyItself_ = nullptr;
  QLabel* notice_ = nullptr;
  CompareView* view_ = nullptr;
  QComboBox* signal_ = nullptr;
  QComboBox* matrix_ = nullptr;
  QComboBox* overlayBox_ = nullptr;
  QComboBox* bandBox_ = nullptr;
  QBoxLayout* boxes_ = nullptr;
  QGridLayout* curveHeader_ = nullptr;
  QLabel* figures_ = nullptr;
  bool figuresBelow_ = false;
  CompareStrip* strip_ = nullptr;
  CompareChart* chart_ = nullptr;
  // Declared last, so that its thread ends before the other members are destroyed.
  CompareWorker worker_;
};

}  // namespace palpate::gui
