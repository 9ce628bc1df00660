#include "gui/inspect/inspect_feature.h"

#include <algorithm>

#include <palpate/signals/characteristic_signals.h>

#include "gui/inspect/inspect_panel.h"
#include "gui/picture/table_picture.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

// Facts about the live source besides its frames.
std::vector<Fact> linkFacts(const LiveSource& source, const QString& calibration) {
  const DeviceInfo device = source.session->device().info();
  const QString hand = QString::fromStdString(source.session->device().hand().name);
  std::vector<Fact> facts{{"source", describe(source.connection)}, {"hand", hand}};
  const auto add = [&](const QString& name, const std::string& value) {
    if (!value.empty()) facts.push_back({name, QString::fromStdString(value)});
  };
  add("serial", device.serial);
  add("tactile firmware", device.firmware);
  add("motion firmware", device.motionFirmware);
  facts.push_back({"calibration", calibration});
  return facts;
}

TablePicture shownTable(const MatrixTableModel& model,
                        const QString& title,
                        const QString& caption) {
  TablePicture table{.title = title, .caption = caption};
  const auto text = [](const QVariant& value) { return value.toString().replace('\n', ' '); };
  for (int column = 0; column < model.columnCount(); ++column)
    table.header << text(model.headerData(column, Qt::Horizontal, Qt::DisplayRole));
  for (int row = 0; row < model.rowCount(); ++row) {
    QStringList cells;
    for (int column = 0; column < model.columnCount(); ++column)
      cells << text(model.data(model.index(row, column), Qt::DisplayRole));
    table.rows.push_back(cells);
  }
  return table;
}

}  // namespace

InspectFeature::InspectFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window), panel_(new InspectPanel(window)) {
  dock_ = new Dock("Inspect", panel_, nullptr, window);
  panel_->setCalibration(windowState.derivedResults.calibration());
  MatrixTableModel& table = panel_->table();
  DisplayedSource& displayed = windowState.displayed;
  connect(
      &displayed, &DisplayedSource::filteredRecordingChanged, this, &InspectFeature::takeSource);
  connect(&displayed, &DisplayedSource::handChanged, this, [this, &displayed] {
    panel_->renewHand(*displayed.hand());
  });
  connect(&displayed, &DisplayedSource::moreKnown, panel_, &InspectPanel::renewFacts);
  connect(&windowState.currentFrame, &CurrentFrame::frameChanged, this, [this, &windowState] {
    if (!windowState.displayed.isRecording()) return;
    panel_->showFrame(windowState.currentFrame.index(),
                      windowState.currentFrame.angles(),
                      windowState.currentFrame.temperatures());
  });
  connect(
      &windowState.currentFrame, &CurrentFrame::resultsReceived, panel_, &InspectPanel::showLive);
  connect(&windowState.currentFrame, &CurrentFrame::staleNoticeChanged, this, [this, &windowState] {
    if (!windowState.displayed.isLive()) return;
    panel_->showLatest();
    showStale();
  });
  connect(&windowState.events, &EventController::changed, this, [this, &windowState] {
    if (const EventEditor* editor = windowState.events.editor())
      panel_->showEvents(editor->events());
  });
  connect(
      &windowState.derivedResults, &DerivedResults::calibrationChanged, this, [this, &windowState] {
        panel_->setCalibration(windowState.derivedResults.calibration());
      });
  connect(&windowState.derivedResults,
          &DerivedResults::pressureChanged,
          this,
          &InspectFeature::showForces);
  connect(&windowState.live, &LiveController::leaving, this, [this] { liveTicks_.clear(); });
  connect(&windowState.live, &LiveController::refreshed, this, [this] {
    showLinkFacts();
    showStale();
  });
  followUnits(panel_);
  connect(&table, &MatrixTableModel::plottedChanged, this, &InspectFeature::showPlotted);
  makeActions();
  const auto last = plots_.size() - 1;
  for (qsizetype i = 0; i <= last; ++i)
    on(plots_[i], [&table, i, last](bool checked) {
      if (table.numMatrices() == 0) return;
      table.setPlotted(i == last ? table.numMatrices() : static_cast<std::size_t>(i), checked);
    });
}

void InspectFeature::makeActions() {
  ActionRegistry& book = state().actions;
  for (int i = 0; i < ActionRegistry::kListedMatrices; ++i)
    plots_.append(book.add("plots", "View", "Plot matrix " + QString::number(i), {}, true));
  plots_.append(book.add("plots", "View", "Plot all matrices together", {}, true));
}

void InspectFeature::takeSource() {
  const DisplayedSource& displayed = state().displayed;
  if (displayed.isLive()) {
    // Restores the ticks from before a recording was shown.
    const std::vector<bool> ticks = liveTicks_;
    panel_->setHand(*displayed.hand());
    for (std::size_t row = 0; row < ticks.size(); ++row)
      panel_->table().setPlotted(row, ticks[row]);
  } else {
    panel_->setRecording(displayed.filteredRecording(), displayed.unfilteredRecording());
  }
  showStale();
  showPlotted();
  showLinkFacts();
}

void InspectFeature::showStale() {
  const bool live = state().displayed.isLive();
  const bool old = live && !state().currentFrame.old().notice.isEmpty();
  panel_->setStale(old, old || (live && state().live.motionGone()));
}

void InspectFeature::showLinkFacts() {
  if (const LiveSource* source = state().displayed.source())
    panel_->setLiveFacts(linkFacts(*source, state().derivedResults.calibration()));
}

void InspectFeature::showForces() {
  const auto& pressure = state().derivedResults.pressure();
  std::vector<MatrixTableModel::Force> rows;
  if (pressure) {
    for (const MatrixPressure& matrix : pressure->matrices)
      rows.push_back({matrix.forceN, matrix.sdForceN, matrix.inRange, pressure->areaKnown});
    rows.push_back({pressure->forceN, pressure->sdForceN, pressure->inRange, pressure->areaKnown});
  }
  panel_->table().showForces(rows, "no calibration: Calibrate, Ctrl+Shift+N");
}

// The actions of the keys Ctrl+1 .. Ctrl+9 and of the menu follow the ticks of the table.
void InspectFeature::showPlotted() {
  const MatrixTableModel& table = panel_->table();
  const auto& plotted = table.plotted();
  state().selection.setPlotted(plotted);
  if (state().displayed.isLive()) liveTicks_ = plotted;
  const auto last = plots_.size() - 1;
  for (qsizetype i = 0; i < last; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const bool there = row < table.numMatrices();
    plots_[i]->setVisible(there);
    plots_[i]->setEnabled(there);
    if (!there) continue;
    plots_[i]->setText("Plot " + QString::fromStdString(table.hand().matrixName(row)));
    plots_[i]->setChecked(plotted[row]);
  }
  plots_[last]->setEnabled(table.numMatrices() > 0);
  plots_[last]->setChecked(!plotted.empty() && plotted.back());
}

std::vector<DockSpec> InspectFeature::docks() {
  return {{.dock = dock_, .key = QKeySequence("Ctrl+I"), .tab = 0, .shownIn = {Preset::kAnalyse}}};
}

std::vector<ExportedView> InspectFeature::views() {
  WindowState& windowState = state();
  ExportedView view;
  view.name = "Inspect";
  view.rank = 1;
  view.widget = panel_;
  view.isThere = [&windowState] { return windowState.currentFrame.hasFrame(); };
  view.fileName = [&windowState] { return windowState.frameStem() + "_signals"; };
  view.size = [this] {
    constexpr double kRowHeight = 26.0;  // [px]
    return QSizeF(std::max(panel_->width(), 470), kRowHeight * (panel_->table().rowCount() + 3));
  };
  view.paint = [this, &windowState](QPainter& painter, const PictureLook& look) {
    paintTable(
        painter,
        look,
        shownTable(panel_->table(), windowState.pictureTitle(), windowState.pictureCaption()),
        panel_->font(),
        shownTheme());
  };
  view.tables = [&windowState] {
    return std::vector<ExportedTable>{
        {"signals of the frame",
         [frame = windowState.currentFrame.frame(), hand = *windowState.displayed.hand()] {
           return signalTextTable(frame, hand);
         }}};
  };
  return {view};
}

}  // namespace palpate::gui
