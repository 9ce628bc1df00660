// The main window's views as they can be taken away: pictures, tables, a picture of each frame.
#include <QFileInfo>
#include <algorithm>

#include <palpate/core/number_text.h>
#include <palpate/core/time.h>
#include <palpate/filter/characteristic_signals.h>

#include "gui/chart/chart_picture.h"
#include "gui/chart/chart_style.h"
#include "gui/export/take_away.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/picture/table_picture.h"
#include "gui/shell/main_window_calibrate.h"
#include "gui/shell/main_window_recognise.h"
#include "gui/shell/main_window_slip.h"
#include "gui/space/frame_painters.h"
#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/message_banner.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

// Every taxel that is scanned, at rest or not.
TextTable taxelTable(const TactileFrame& frame, const std::string& index) {
  struct Place {
    std::size_t matrix;
    int y;
    int x;
    float value;
  };
  std::vector<Place> places;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const MatrixLayout& layout = frame.layout->matrix(m);
    const auto values = frame.matrix(m);
    for (int y = 0; y < layout.rows; ++y)
      for (int x = 0; x < layout.columns; ++x)
        if (layout.enabled(y, x)) places.push_back({m, y, x, values(y, x)});
  }
  const std::size_t numPlaces = places.size();
  return {.header = {"frame", "time_ms", "matrix", "y", "x", "value"},
          .numRows = numPlaces,
          .row = [places = std::move(places),
                  index,
                  timeMs = std::to_string(frame.hostUs / kUsPerMs)](std::size_t row) {
            const Place& place = places[row];
            return std::vector<std::string>{index,
                                            timeMs,
                                            std::to_string(place.matrix),
                                            std::to_string(place.y),
                                            std::to_string(place.x),
                                            numberText(place.value)};
          }};
}

// A row per matrix, the whole hand last.
TextTable signalTable(const TactileFrame& frame, const HandDescription& hand) {
  std::vector<CharacteristicSignals> rows = characteristicSignals(frame);
  rows.push_back(wholeFrameSignals(frame));
  std::vector<std::string> names;
  for (std::size_t m = 0; m + 1 < rows.size(); ++m) names.push_back(hand.matrixName(m));
  names.emplace_back("all");
  const std::size_t numRows = rows.size();
  return {.header = {"matrix",
                     "active",
                     "mean [counts]",
                     "filtered mean [counts]",
                     "max [counts]",
                     "min [counts]",
                     "sum [counts]",
                     "area [mm^2]"},
          .numRows = numRows,
          .row = [rows = std::move(rows), names = std::move(names)](std::size_t row) {
            const CharacteristicSignals& values = rows[row];
            return std::vector<std::string>{names[row],
                                            std::to_string(values.active),
                                            numberText(values.mean),
                                            numberText(values.filteredMean),
                                            numberText(values.maximum),
                                            numberText(values.minimum),
                                            numberText(values.sum),
                                            numberText(values.areaMm2)};
          }};
}

// The value of a curve at a frame; joint angles and temperatures are the last ones before it.
std::string mainWindowTakeawayCellOf(const OpenedRecording& recording,
                                     const SeriesChoice& choice,
                                     std::size_t frame) {
  const auto of = [](const std::vector<double>& values, std::size_t index) {
    return index < values.size() ? numberText(values[index]) : std::string();
  };
  switch (choice.kind) {
    case SeriesChoice::Kind::kMatrix:
      return numberText(valueOf(recording.at(frame, choice.index), choice.signal));
    case SeriesChoice::Kind::kTaxels:
      return numberText(meanOf(recording.profile.frame(frame), choice.taxels));
    case SeriesChoice::Kind::kAngle: {
      const auto angles = recording.profile.anglesAtFrame(frame);
      return angles ? of(angles->deg, choice.index) : std::string();
    }
    case SeriesChoice::Kind::kTemperature: {
      const auto temperatures = recording.profile.temperaturesAtFrame(frame);
      return temperatures ? of(temperatures->degC, choice.index) : std::string();
    }
  }
  return {};
}

// What is plotted, a row per frame.
TextTable curveTable(const OpenedRecordingPtr& recording,
                     const std::vector<PlottedCurve>& curves,
                     const FrameSpan& span) {
  TextTable table{.header = {"frame", "time_ms", "time_s"}, .numRows = span.count()};
  std::vector<SeriesChoice> choices;
  for (const PlottedCurve& curve : curves) {
    choices.push_back(curve.choice);
    const bool ofMatrix = curve.choice.kind == SeriesChoice::Kind::kMatrix;
    table.header.push_back(
        (curve.name + (ofMatrix ? " " + nameOf(curve.choice.signal) : "") + " [" + curve.unit + "]")
            .toStdString());
  }
  table.row = [recording, choices, first = span.first](std::size_t row) {
    const std::size_t frame = first + row;
    std::vector<std::string> cells = {
        std::to_string(frame),
        std::to_string(recording->profile.frameTimeUs(frame) / kUsPerMs),
        numberText(recording->timeAt(frame))};
    for (const SeriesChoice& choice : choices)
      cells.push_back(mainWindowTakeawayCellOf(*recording, choice, frame));
    return cells;
  };
  return table;
}

// Frames within a span of seconds; none may be in it.
std::optional<FrameSpan> framesWithin(const OpenedRecording& recording, double from, double to) {
  const auto frames = recording.framesWithin(from, to);
  if (!frames) return std::nullopt;
  return FrameSpan{frames->first, frames->second};
}

TablePicture shownTable(const MatrixTableModel& model, const MatricesPictureOptions& named) {
  TablePicture table{.title = named.title, .caption = named.caption};
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

void MainWindow::connectTakeAway() {
  takeAway_ = std::make_unique<TakeAway>(settings_, this);
  takeAway_->add(matricesExport());
  takeAway_->add(handExport());
  takeAway_->add(timelineExport());
  takeAway_->add(spectrumExport());
  takeAway_->add(calibrate_->exported());
  takeAway_->add(slip_->exported());
  takeAway_->add(inspectExport());
  takeAway_->add(recognise_->exported());
  connect(actions_.exportPicture, &QAction::triggered, takeAway_.get(), &TakeAway::exportNow);
  connect(actions_.exportAgain, &QAction::triggered, takeAway_.get(), &TakeAway::repeatLast);
  connect(actions_.copyPicture, &QAction::triggered, takeAway_.get(), &TakeAway::copyPicture);
  connect(actions_.copyTable, &QAction::triggered, takeAway_.get(), &TakeAway::copyTable);
  connect(takeAway_.get(), &TakeAway::started, exporting_, &OpeningStrip::begin);
  connect(takeAway_.get(), &TakeAway::progressed, exporting_, &OpeningStrip::setProgress);
  connect(takeAway_.get(), &TakeAway::finished, exporting_, &OpeningStrip::end);
  connect(exporting_, &OpeningStrip::cancelRequested, takeAway_.get(), &TakeAway::cancel);
  connect(takeAway_.get(), &TakeAway::said, this, &MainWindow::flash);
  connect(takeAway_.get(), &TakeAway::written, this, &MainWindow::pictureWritten);
  connect(takeAway_.get(), &TakeAway::failed, this, [this](const QString& message) {
    banner_->showMessage(message);
  });
}

void MainWindow::waitForExports() { takeAway_->waitForDone(); }

ExportedView MainWindow::matricesExport() {
  ExportedView view;
  view.name = "Matrices";
  view.widget = matrices_;
  view.isThere = [this] { return somethingIsShown() && !compareShown(); };
  view.fileName = [this] { return pictureName(); };
  view.size = [this] { return QSizeF(matricesView().size()); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    paintMatricesPicture(painter,
                         QRectF(QPointF(), look.size),
                         matrices_->frame(),
                         *matrices_->hand(),
                         fitted(exportOptions(), look));
  };
  view.tables = [this] {
    const std::string frame = liveShown_ ? std::string() : std::to_string(playback_.frame());
    return std::vector<ExportedTable>{{"taxels of the frame", [shown = matrices_->frame(), frame] {
                                         return taxelTable(shown, frame);
                                       }}};
  };
  view.framePictures = [this]() -> std::optional<FramePictures> {
    if (liveShown_ || !current_) return std::nullopt;
    FramePictures pictures;
    pictures.fileName = recordingStem();
    pictures.numFrames = current_->profile.numFrames();
    if (takeAway_->selectedFrames) pictures.selected = takeAway_->selectedFrames();
    pictures.timeUs = [recording = shown_](std::size_t frame) {
      return recording->profile.frameTimeUs(frame);
    };
    MatricesPictureOptions options = exportOptions();
    if (view_.range == RangeMode::kFrame) options.rangeMax = options.rangeMin = 0.0;  // of each
    pictures.painter = [recording = shown_, options](const PictureLook& look) {
      return matricesFramePainter(recording, fitted(options, look));
    };
    return pictures;
  };
  return view;
}

ExportedView MainWindow::timelineExport() {
  ExportedView view;
  view.name = "Timeline";
  view.widget = charts_;
  view.isThere = [this] { return somethingIsShown(); };
  view.fileName = [this] { return recordingStem() + "_" + nameOf(view_.signal).replace(' ', '_'); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    ChartPictureOptions options;
    options.title = exportOptions().title;
    for (const PlottedCurve& curve : curvesNow()) options.legend.push_back({curve.name, curve.pen});
    QCustomPlot* plot = liveShown_ ? static_cast<QCustomPlot*>(liveChart_) : timeline_;
    paintChart(painter, look, *plot, options);
  };
  view.tables = [this] {
    std::vector<ExportedTable> tables;
    if (liveShown_ || !current_) return tables;
    const auto add = [&](const QString& name, const std::optional<FrameSpan>& span) {
      if (!span) return;
      tables.push_back({name, [recording = shown_, curves = curvesNow(), span = *span] {
                          return curveTable(recording, curves, span);
                        }});
    };
    const QCPRange seen = timeline_->xAxis->range();
    if (takeAway_->selectedFrames) add("the selected range", takeAway_->selectedFrames());
    add("what is seen", framesWithin(*current_, seen.lower, seen.upper));
    add("the whole recording", FrameSpan{0, current_->profile.numFrames() - 1});
    return tables;
  };
  return view;
}

ExportedView MainWindow::inspectExport() {
  ExportedView view;
  view.name = "Inspect";
  view.widget = inspect_;
  view.isThere = [this] { return somethingIsShown(); };
  view.fileName = [this] { return pictureName() + "_signals"; };
  view.size = [this] {
    constexpr double kRowHeight = 26.0;  // [px]
    return QSizeF(std::max(inspect_->width(), 470),
                  kRowHeight * (inspect_->table().rowCount() + 3));
  };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    paintTable(painter,
               look,
               shownTable(inspect_->table(), exportOptions()),
               inspect_->font(),
               resolved(view_.theme));
  };
  view.tables = [this] {
    return std::vector<ExportedTable>{
        {"signals of the frame", [frame = matrices_->frame(), hand = *matrices_->hand()] {
           return signalTable(frame, hand);
         }}};
  };
  return view;
}

QString MainWindow::recordingStem() const {
  if (liveShown_ || !current_) return pictureName();
  return QFileInfo(QString::fromStdString(current_->path.filename().string())).completeBaseName();
}

}  // namespace palpate::gui
