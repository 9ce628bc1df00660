#include "gui/timeline/timeline_feature.h"

#include <QInputDialog>
#include <QMenu>
#include <QToolButton>

#include "gui/appearance/captions.h"
#include "gui/appearance/hand_unit.h"
#include "gui/appearance/next_choice.h"
#include "gui/chart/chart_picture.h"
#include "gui/timeline/axis_scale_dialog.h"
#include "gui/timeline/cursor_readout.h"
#include "gui/timeline/curve_statistics.h"
#include "gui/timeline/curve_table.h"
#include "gui/timeline/grasp_export.h"
#include "gui/timeline/label_exchange.h"
#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_header.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

constexpr double kZoomStep = 1.5;
constexpr const char* kDifferencesKey = "timeline/differences";

}  // namespace

TimelineFeature::TimelineFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      groups_(windowState.settings),
      extras_(loadPlottedExtras(windowState.settings)) {
  TimelineActions& actions = actions_;
  header_ = new TimelineHeader(
      {actions.zoomSelection, actions.addLabel, actions.crop, actions.dropSelection}, window);
  signalTree_ = new SignalTree(groups_, window);
  signalTree_->setExtras(extras_);
  charts_ = new FittingPages(window);
  panel_ = new TimelinePanel(charts_);
  chart_ = &panel_->chart();
  liveChart_ = new LiveChart(charts_);
  charts_->addWidget(panel_);
  charts_->addWidget(liveChart_);
  dock_ = new Dock("Timeline", charts_, header_, window);
  crop_ = std::make_unique<CropJob>(windowState, *actions_.crop, window);
  windowState.prompts.text = [window](const QString& title,
                                      const QString& text) -> std::optional<QString> {
    bool good = false;
    const QString answer =
        QInputDialog::getText(window, title, title + ":", QLineEdit::Normal, text, &good);
    return good ? std::optional(answer.simplified()) : std::nullopt;
  };
  connect(&windowState.appearance, &ViewAppearance::timeAxisChanged, this, [this, &windowState] {
    chart_->setRight(windowState.appearance.timeAxisRight());
  });
  connectSubject();
  connectLive();
  connectSelection();
  connectActions();
  connectCurves();
  editing_ = std::make_unique<EventEditing>(windowState, actions_, panel_->rows(), window);
  new LabelExchange(windowState, this);
  graspExport_ = new GraspExport(windowState, window, this);
}

TimelineFeature::~TimelineFeature() { liveChart_->setHistory(nullptr, 0); }

void TimelineFeature::connectSubject() {
  DisplayedSource& displayed = state().displayed;
  connect(&displayed, &DisplayedSource::changed, this, [this, &displayed] {
    charts_->setCurrentIndex(displayed.isLive() ? 1 : 0);
  });
  connect(
      &displayed, &DisplayedSource::filteredRecordingChanged, this, &TimelineFeature::takeSource);
  connect(&displayed, &DisplayedSource::shown, this, [this] {
    showCurves();
    showReading();
    showSelection();
  });
  connect(
      &state().playback, &PlaybackController::positionChanged, chart_, &TimelineChart::setPosition);
  connect(
      chart_, &TimelineChart::seekRequested, &state().playback, &PlaybackController::seekSeconds);
  connect(chart_, &TimelineChart::menuRequested, this, [this](const QPoint& at) {
    state().menus.edit->popup(at);
  });
  connect(&chart_->store(), &SeriesStore::changed, this, &TimelineFeature::showReading);
  ViewAppearance& look = state().appearance;
  followTheme(panel_);
  followTheme(liveChart_);
  connect(&look, &ViewAppearance::changed, this, [this, &look] {
    header_->setSignal(look.view().signal);
    checkChoice(actions_.signalsPlotted, kAllPlottedSignals, look.view().signal);
    liveChart_->setSignal(look.view().signal);
    showCurves();
  });
  const auto useSignal = [&look](PlottedSignal signal) {
    look.change([&](ViewSettings& view) { view.signal = signal; });
  };
  connect(header_, &TimelineHeader::signalChosen, this, useSignal);
  on(actions_.nextSignal, [&look] {
    look.change([](ViewSettings& view) { view.signal = after(kAllPlottedSignals, view.signal); });
  });
  connect(
      actions_.signalsPlotted, &QActionGroup::triggered, this, [useSignal](const QAction* action) {
        useSignal(kAllPlottedSignals.at(action->data().toUInt()));
      });
}

void TimelineFeature::takeSource() {
  const DisplayedSource& displayed = state().displayed;
  const OpenedRecordingPtr& behind = displayed.unfilteredRecording();
  chart_->setRecording(displayed.filteredRecording());
  chart_->setBefore(displayed.filteredRecording() != behind ? behind : nullptr);
  const QCPRange seen = chart_->seen();
  state().selection.setVisibleSpan({seen.lower, seen.upper});
  if (displayed.isRecording())
    signalTree_->setSource(behind->profile.hand(),
                           behind->profile.numAngles() > 0,
                           behind->profile.numTemperatures() > 0);
  if (displayed.isLive()) takeLive();
}

void TimelineFeature::takeLive() {
  const LiveSource* source = state().displayed.source();
  if (!source) return;
  if (source->history.get() != history_) {
    history_ = source->history.get();
    const HandDescription& hand = *state().displayed.hand();
    liveChart_->setHistory(history_, hand.layout->numMatrices(), unitOf(hand));
  }
  liveChart_->setPlotted(state().selection.plotted());
}

void TimelineFeature::connectLive() {
  LiveController& live = state().live;
  CurrentFrame& currentFrame = state().currentFrame;
  connect(&live, &LiveController::leaving, this, [this] {
    liveChart_->setHistory(nullptr, 0);
    history_ = nullptr;
  });
  connect(&live,
          &LiveController::eventsReceived,
          this,
          [this](const std::vector<RecordingEvent>& events) {
            for (const RecordingEvent& event : events) liveChart_->addEvent(event);
          });
  connect(
      &currentFrame, &CurrentFrame::resultsReceived, this, [this] { liveChart_->refresh(0.0); });
  connect(&currentFrame, &CurrentFrame::heldChanged, this, [this, &currentFrame] {
    liveChart_->setHeld(currentFrame.held());
  });
  // Without new frames the chart still scrolls.
  connect(&live, &LiveController::refreshed, this, [this, &live, &currentFrame] {
    const LiveSource* source = state().displayed.source();
    if (source && live.stale() && !currentFrame.held() && live.hasReceivedFrames() &&
        !source->finished())
      liveChart_->refresh(live.silentS());
  });
  QSettings& settings = state().settings;
  liveChart_->setWindowS(settings.value("live/window_s", LiveChart::kUsualS).toDouble());
  connect(liveChart_, &LiveChart::windowChanged, this, [&settings](double seconds) {
    settings.setValue("live/window_s", seconds);
  });
}

void TimelineFeature::connectSelection() {
  Selection& selection = state().selection;
  connect(chart_, &TimelineChart::selectionChanged, this, [this, &selection] {
    selection.setSpan(chart_->selection());
  });
  connect(&selection, &Selection::spanChanged, this, [this, &selection] {
    chart_->setSelection(selection.span());
    showSelection();
  });
  connect(chart_->xAxis,
          qOverload<const QCPRange&>(&QCPAxis::rangeChanged),
          this,
          [&selection](const QCPRange& seen) {
            selection.setVisibleSpan({seen.lower, seen.upper});
          });
  connect(&selection, &Selection::visibleSpanRequested, this, [this](const TimeSpan& span) {
    chart_->setVisibleRange(span.fromS, span.toS);
  });
  connect(&selection, &Selection::spanRequested, chart_, &TimelineChart::showSpan);
  connect(&selection, &Selection::fullRangeRequested, chart_, &TimelineChart::fit);
  connect(&selection, &Selection::zoomRequested, chart_, &TimelineChart::zoomAbout);
  connect(&selection, &Selection::plottedChanged, this, [this, &selection] {
    if (state().displayed.isLive()) liveChart_->setPlotted(selection.plotted());
    showCurves();
  });
  connect(&selection, &Selection::taxelsChanged, this, [this, &selection] {
    signalTree_->setNumChosen(selection.taxels().count());
    if (extras_.chosenTaxels) showCurves();
  });
  state().escapeHandler.add(EscapeHandler::Order::kSpan, [this, &selection] {
    if (!selection.span() || state().displayed.isLive()) return false;
    selection.setSpan(std::nullopt);
    return true;
  });
}

void TimelineFeature::connectActions() {
  TimelineActions& actions = actions_;
  Selection& selection = state().selection;
  on(actions.selectFrom, [this] { selectEnd(true); });
  on(actions.selectTo, [this] { selectEnd(false); });
  on(actions.selectAll, [&selection] { selection.setSpan(TimeSpan{0.0, selection.durationS()}); });
  on(actions.dropSelection, [&selection] { selection.setSpan(std::nullopt); });
  on(actions.zoomSelection, [&selection] {
    if (selection.span()) selection.showWithMargin(*selection.span());
  });
  on(actions.statistics, [this] { showStatistics(); });
  readout_ = new CursorReadout(*chart_);
  const bool differences = state().settings.value(kDifferencesKey, false).toBool();
  actions.differences->setChecked(differences);
  readout_->setOn(differences);
  on(actions.differences, [this](bool shown) {
    readout_->setOn(shown);
    state().settings.setValue(kDifferencesKey, shown);
    if (shown && !state().selection.span())
      state().messages.flash("select a range: drag in the timeline, or press [ and ]");
  });
  chart_->setScales(savedAxisScales(state().settings));
  on(actions.axisScales, [this] { showAxisScales(); });
  connect(&statisticsJob_, &BackgroundJob::failed, &state().messages, &Messages::fail);
  const auto zoom = [this](double factor) {
    if (state().displayed.isLive())
      liveChart_->setWindowS(liveChart_->windowS() / factor);
    else
      chart_->zoom(factor);
  };
  on(actions.zoomIn, [zoom] { zoom(kZoomStep); });
  on(actions.zoomOut, [zoom] { zoom(1.0 / kZoomStep); });
  on(actions.fit, [this] {
    state().displayed.isLive() ? liveChart_->setWindowS(LiveChart::kUsualS) : chart_->fit();
  });
  ActionEnabler& actionEnabler = state().actionEnabler;
  const auto frames = [this] { return state().displayed.hasFrames(); };
  actionEnabler.add({actions.zoomIn, actions.zoomOut, actions.fit},
                    [this, frames] { return frames() || state().displayed.isLive(); });
  actionEnabler.add({actions.selectFrom,
                     actions.selectTo,
                     actions.selectAll,
                     actions.chooseCurves,
                     actions.differences,
                     actions.axisScales},
                    frames);
  actionEnabler.add(
      {actions.crop, actions.zoomSelection, actions.dropSelection, actions.statistics},
      [frames, &selection] { return frames() && selection.span().has_value(); });
}

void TimelineFeature::connectCurves() {
  const auto choose = [this] { signalTree_->openBelow(*header_->curvesButton()); };
  on(actions_.chooseCurves, choose);
  connect(header_, &TimelineHeader::curvesRequested, this, choose);
  connect(signalTree_, &SignalTree::extrasChanged, this, [this] {
    extras_ = signalTree_->extras();
    showCurves();
  });
  connect(signalTree_, &SignalTree::groupRequested, this, &TimelineFeature::nameChosenTaxels);
  on(actions_.nameTaxels, [this] { nameChosenTaxels(); });
  connect(&groups_, &TaxelGroups::changed, this, &TimelineFeature::showCurves);
}

std::vector<PlottedCurve> TimelineFeature::curves() const {
  std::vector<PlottedCurve> curves;
  const HandDescription* hand = state().displayed.hand();
  if (!hand) return curves;
  const Theme theme = state().appearance.theme();
  const std::vector<bool>& plotted = state().selection.plotted();
  for (std::size_t row = 0; row < plotted.size(); ++row)
    if (plotted[row])
      curves.push_back(matrixCurve(*hand, row, state().appearance.view().signal, theme));
  const OpenedRecordingPtr recording = state().displayed.recorded();
  if (!recording) return curves;
  const auto add = [&](PlottedCurve curve) {
    if (hasSeries(recording->profile, curve.choice)) curves.push_back(std::move(curve));
  };
  const TaxelSelection& chosen = state().selection.taxels();
  if (extras_.chosenTaxels && !chosen.empty()) {
    const std::size_t count = chosen.count();
    add(taxelCurve(*hand,
                   chosen,
                   count == 1 ? QString("chosen taxel") : QString::number(count) + " chosen taxels",
                   0,
                   theme));
  }
  std::size_t place = 1;
  for (const TaxelGroups::Group& group : groups_.of(recording->profile.layout()))
    if (extras_.groups.contains(group.name))
      add(taxelCurve(*hand, group.taxels, group.name, place++, theme));
  for (const int axis : extras_.angles)
    if (axis < static_cast<int>(hand->axes.size()))
      add(angleCurve(*hand, static_cast<std::size_t>(axis), theme));
  for (const int sensor : extras_.temperatures)
    if (sensor < static_cast<int>(hand->temperatureSensors.size()))
      add(temperatureCurve(*hand, static_cast<std::size_t>(sensor), theme));
  return curves;
}

void TimelineFeature::showCurves() {
  const bool live = state().displayed.isLive();
  const std::vector<PlottedCurve> now = curves();
  header_->setCurves(now, state().appearance.theme());
  header_->setPlain(live);
  if (!live) chart_->setCurves(now);
}

void TimelineFeature::showReading() {
  const OpenedRecordingPtr recording = state().displayed.recorded();
  if (state().displayed.isLive()) return;
  const double done = chart_->store().progress();
  header_->setReading(
      done < 1.0 ? "reading " + QString::number(static_cast<int>(done * 100.0)) + " %" : QString());
  if (recording && recording->isLong() && done >= 1.0) state().displayed.notifyMoreKnown();
}

void TimelineFeature::showSelection() {
  if (state().displayed.isLive()) return;
  QString words;
  const auto& span = state().selection.span();
  if (span && state().displayed.isRecording()) {
    const auto frames = state().selectedFrames();
    const std::size_t count = frames ? frames->count() : 0;
    words = figure(span->fromS, 2) + " – " + figure(span->toS, 2) + " s · " +
            (count == 0   ? QString("no frame")
             : count == 1 ? QString("1 frame")
                          : QString::number(count) + " frames");
  }
  header_->setSelection(words);
  state().actionEnabler.refresh();
}

void TimelineFeature::selectEnd(bool begin) {
  if (!state().displayed.hasFrames()) return;
  Selection& selection = state().selection;
  const double now = state().playback.positionS();
  const double end = selection.durationS();
  TimeSpan span = selection.span().value_or(begin ? TimeSpan{now, end} : TimeSpan{0.0, now});
  (begin ? span.fromS : span.toS) = now;
  // A begin after the old end extends the selection to the end of the recording; an end before the
  // old begin extends it to the start.
  if (span.fromS > span.toS) (begin ? span.toS : span.fromS) = begin ? end : 0.0;
  selection.setSpan(span);
}

void TimelineFeature::showStatistics() {
  const OpenedRecordingPtr recording = state().displayed.filteredRecording();
  const auto frames = state().selectedFrames();
  const std::vector<PlottedCurve> shown = curves();
  if (!recording || !frames)
    return state().messages.flash("nothing is selected: drag in the timeline, or press [ and ]");
  if (shown.empty()) return state().messages.flash("no curve is shown: choose some (C)");
  auto selected = std::make_shared<SelectedCurves>();
  statisticsJob_.cancel();
  statisticsJob_.start(
      fileNameOf(*recording),
      [recording, shown, frames, selected](const Progress& progress) {
        *selected = selectedCurves(recording, shown, *frames, progress);
      },
      [this, recording, frames, selected] {
        const QString range = fileNameOf(*recording) + state().activeFilters.caption() +
                              ", frames " + QString::number(frames->first) + " to " +
                              QString::number(frames->last) + ", " +
                              figure(recording->timeAt(frames->first), 3) + " to " +
                              figure(recording->timeAt(frames->last), 3) + " s";
        auto* dialog = new StatisticsDialog(*selected, range, state().appearance.theme(), window());
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->show();
      });
}

void TimelineFeature::showAxisScales() {
  const auto ranges = chart_->axisRanges();
  if (ranges.empty()) return state().messages.flash("no curve is shown: choose some (C)");
  QStringList units;
  for (const auto& [unit, range] : ranges) units.append(unit);
  auto* dialog = new AxisScaleDialog(units, chart_->scales(), ranges, window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &AxisScaleDialog::changed, this, [this, dialog] {
    chart_->setScales(dialog->scales());
    saveAxisScales(dialog->scales(), state().settings);
  });
  dialog->show();
}

void TimelineFeature::nameChosenTaxels() {
  const TaxelSelection chosen = state().selection.taxels();
  Messages& messages = state().messages;
  if (chosen.empty())
    return messages.flash("no taxel is chosen: click or drag over some of the matrices");
  const auto name = state().prompts.text("Name of the taxels", "");
  if (!name) return;
  if (name->isEmpty()) return messages.flash("a group of taxels needs a name");
  if (!groups_.keep(*name, chosen))
    return messages.fail("There are too many groups of taxels: forget some (Curves, Del)");
  extras_.groups.insert(*name);
  signalTree_->setExtras(extras_);
  showCurves();
  messages.flash("kept: " + *name + ", " + QString::number(chosen.count()) + " taxels");
}

std::vector<DockSpec> TimelineFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+L"),
           .area = Qt::BottomDockWidgetArea,
           .liveArea = Qt::BottomDockWidgetArea,
           .shown = true,
           .shownLive = true}};
}

std::vector<BannerSpec> TimelineFeature::strips() {
  return {{BannerSpec::Order::kWork, &crop_->strip()},
          {BannerSpec::Order::kWork, &graspExport_->strip()}};
}

void TimelineFeature::remember() { savePlottedExtras(extras_, state().settings); }

void TimelineFeature::settle() {
  chart_->store().waitUntilRead();
  chart_->storeBefore().waitUntilRead();
  while (crop_->busy() || graspExport_->busy() || statisticsJob_.busy())
    QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

std::vector<ExportedView> TimelineFeature::views() {
  WindowState& windowState = state();
  ExportedView view;
  view.name = "Timeline";
  view.widget = charts_;
  view.isThere = [&windowState] { return windowState.currentFrame.hasFrame(); };
  view.fileName = [&windowState] {
    return windowState.recordingStem() + "_" +
           nameOf(windowState.appearance.view().signal).replace(' ', '_');
  };
  view.paint = [this, &windowState](QPainter& painter, const PictureLook& look) {
    ChartPictureOptions options;
    options.title = windowState.pictureTitle();
    for (const PlottedCurve& curve : curves()) options.legend.push_back({curve.name, curve.pen});
    QCustomPlot* plot =
        windowState.displayed.isLive() ? static_cast<QCustomPlot*>(liveChart_) : chart_;
    paintChart(painter, look, *plot, options);
  };
  view.tables = [this, &windowState] {
    std::vector<ExportedTable> tables;
    const OpenedRecordingPtr recording = windowState.displayed.recorded();
    if (!recording) return tables;
    const auto add = [&](const QString& name, const std::optional<FrameSpan>& span) {
      if (!span) return;
      tables.push_back(
          {name, [seen = windowState.displayed.filteredRecording(), now = curves(), span = *span] {
             return curveTable(seen, now, span);
           }});
    };
    add("the selected range", windowState.selectedFrames());
    const QCPRange seen = chart_->seen();
    if (const auto frames = recording->framesWithin(seen.lower, seen.upper))
      add("what is seen", FrameSpan{frames->first, frames->second});
    add("the whole recording", FrameSpan{0, recording->profile.numFrames() - 1});
    if (const auto selected = windowState.selectedFrames())
      tables.push_back(
          {"statistics of the selected range",
           [of = windowState.displayed.filteredRecording(), now = curves(), span = *selected] {
             return statisticsTable(of, now, span);
           }});
    return tables;
  };
  return {view};
}

}  // namespace palpate::gui
