#include "gui/inspect/inspect_feature.h"

#include <algorithm>

#include <palpate/signals/signal_text_table.h>

#include "gui/inspect/inspect_panel.h"
#include "gui/picture/table_picture.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

// What is known of the source besides its frames.
std::vector<Fact> linkFacts(const LiveSource& source, const QString& calibration) {
  const DeviceFacts device = source.session->device().facts();
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

InspectFeature::InspectFeature(Bench& bench, QWidget* window)
    : Feature(bench, window), panel_(new InspectPanel(window)) {
  dock_ = new Dock("Inspect", panel_, nullptr, window);
  panel_->setCalibration(bench.overlays.calibration());
  MatrixTableModel& table = panel_->table();
  Subject& subject = bench.subject;
  connect(&subject, &Subject::seenChanged, this, &InspectFeature::takeSource);
  connect(&subject, &Subject::handChanged, this, [this, &subject] {
    panel_->renewHand(*subject.hand());
  });
  connect(&subject, &Subject::moreKnown, panel_, &InspectPanel::renewFacts);
  connect(&bench.moment, &Moment::frameChanged, this, [this, &bench] {
    if (!bench.subject.isRecording()) return;
    panel_->showFrame(bench.moment.index(), bench.moment.angles(), bench.moment.temperatures());
  });
  connect(&bench.moment, &Moment::resultsCame, panel_, &InspectPanel::showLive);
  connect(&bench.moment, &Moment::oldChanged, this, [&bench, &table] {
    if (bench.subject.isLive()) table.setOld(!bench.moment.old().notice.isEmpty());
  });
  connect(&bench.events, &EventDesk::changed, this, [this, &bench] {
    if (const EventEditor* editor = bench.events.editor()) panel_->showEvents(editor->events());
  });
  connect(&bench.overlays, &Overlays::calibrationChanged, this, [this, &bench] {
    panel_->setCalibration(bench.overlays.calibration());
  });
  connect(&bench.overlays, &Overlays::pressureChanged, this, &InspectFeature::showForces);
  connect(&bench.live, &LiveController::leaving, this, [this] { liveTicks_.clear(); });
  connect(&bench.live, &LiveController::looked, this, &InspectFeature::showLinkFacts);
  followTheme(panel_);
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
  ActionBook& book = bench().actions;
  for (int i = 0; i < ActionBook::kMatricesWithKeys; ++i)
    plots_.append(book.add("plots",
                           "View",
                           "Plot matrix " + QString::number(i),
                           {QKeySequence("Ctrl+" + QString::number(i + 1))},
                           true));
  plots_.append(book.add("plots", "View", "Plot all matrices together", {key("Ctrl+0")}, true));
}

void InspectFeature::takeSource() {
  const Subject& subject = bench().subject;
  if (subject.isLive()) {
    // as they were left, before a recording was looked at
    const std::vector<bool> ticks = liveTicks_;
    panel_->setHand(*subject.hand());
    for (std::size_t row = 0; row < ticks.size(); ++row)
      panel_->table().setPlotted(row, ticks[row]);
  } else {
    panel_->setRecording(subject.seen());
  }
  panel_->table().setOld(subject.isLive() && !bench().moment.old().notice.isEmpty());
  showPlotted();
  showLinkFacts();
}

void InspectFeature::showLinkFacts() {
  if (const LiveSource* source = bench().subject.source())
    panel_->setLiveFacts(linkFacts(*source, bench().overlays.calibration()));
}

void InspectFeature::showForces() {
  const auto& pressure = bench().overlays.pressure();
  std::vector<MatrixTableModel::Force> rows;
  if (pressure) {
    for (const MatrixPressure& matrix : pressure->matrices)
      rows.push_back({matrix.forceN, matrix.sdForceN, matrix.inRange});
    rows.push_back({pressure->forceN, pressure->sdForceN, pressure->inRange});
  }
  panel_->table().showForces(rows, "no calibration: Calibrate, Ctrl+Shift+N");
}

// The keys Ctrl+1 .. Ctrl+9 and the menu follow the ticks of the table.
void InspectFeature::showPlotted() {
  const MatrixTableModel& table = panel_->table();
  const auto& plotted = table.plotted();
  bench().selection.setPlotted(plotted);
  if (bench().subject.isLive()) liveTicks_ = plotted;
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

std::vector<DockOffer> InspectFeature::docks() {
  return {
      {.dock = dock_, .key = QKeySequence("Ctrl+I"), .tab = 0, .shown = true, .shownLive = true}};
}

std::vector<ExportedView> InspectFeature::views() {
  Bench& bench = this->bench();
  ExportedView view;
  view.name = "Inspect";
  view.rank = 1;
  view.widget = panel_;
  view.isThere = [&bench] { return bench.moment.hasFrame(); };
  view.fileName = [&bench] { return bench.frameStem() + "_signals"; };
  view.size = [this] {
    constexpr double kRowHeight = 26.0;  // [px]
    return QSizeF(std::max(panel_->width(), 470), kRowHeight * (panel_->table().rowCount() + 3));
  };
  view.paint = [this, &bench](QPainter& painter, const PictureLook& look) {
    paintTable(painter,
               look,
               shownTable(panel_->table(), bench.pictureTitle(), bench.pictureCaption()),
               panel_->font(),
               bench.look.theme());
  };
  view.tables = [&bench] {
    return std::vector<ExportedTable>{
        {"signals of the frame", [frame = bench.moment.frame(), hand = *bench.subject.hand()] {
           return signalTextTable(frame, hand);
         }}};
  };
  return {view};
}

}  // namespace palpate::gui
