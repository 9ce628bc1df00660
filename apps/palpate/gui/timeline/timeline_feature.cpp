#include "gui/timeline/timeline_feature.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QMenu>
#include <QPainter>
#include <QPicture>
#include <QToolButton>
#include <algorithm>

#include <palpate/signals/signal_name.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/hand_unit.h"
#include "gui/chart/chart_picture.h"
#include "gui/picture/picture_export.h"
#include "gui/timeline/axis_editor.h"
#include "gui/timeline/cursor_readout.h"
#include "gui/timeline/curve_statistics.h"
#include "gui/timeline/curve_table.h"
#include "gui/timeline/formula_dialog.h"
#include "gui/timeline/grasp_export.h"
#include "gui/timeline/label_exchange.h"
#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_header.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/offer_strip.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

constexpr double kZoomStep = 1.5;
// Share of the visible duration by which a key scrolls the live chart.
constexpr double kScrollStep = 0.5;
// Margin beside the cursors when they are zoomed to, as a share of their distance.
constexpr double kCursorAir = 0.1;
// Settings of the ranges of axes that were set by hand.
constexpr const char* kAxesSetting = "plotted/axes";
constexpr const char* kLiveAxesSetting = "live/axes";

// In the unit of the axis.
constexpr double kLargestAxisValue = 1e12;

// "finger 0 distal, x 3, y 5": of one taxel.
QString placeOfTaxel(const HandDescription& hand, const TaxelSelection& one) {
  for (std::size_t m = 0; m < one.numMatrices(); ++m) {
    const Mask& mask = one.mask(m);
    const auto at = std::ranges::find_if(mask, [](auto chosen) { return chosen != 0; });
    if (at == mask.end()) continue;
    const auto place = static_cast<int>(at - mask.begin());
    const int columns = hand.layout->matrix(m).columns;
    return QString::fromStdString(hand.matrixName(m)) + ", x " + QString::number(place % columns) +
           ", y " + QString::number(place / columns);
  }
  return {};
}

// Each range is a text "begin end unit".
RangesByHand loadRanges(const QSettings& settings, const char* name) {
  RangesByHand ranges;
  for (const QString& text : settings.value(name).toStringList()) {
    bool fromGood = false;
    bool toGood = false;
    const double from = text.section(' ', 0, 0).toDouble(&fromGood);
    const double to = text.section(' ', 1, 1).toDouble(&toGood);
    const QString unit = text.section(' ', 2);
    if (fromGood && toGood && from < to && from >= -kLargestAxisValue && to <= kLargestAxisValue &&
        !unit.isEmpty())
      ranges[unit] = {from, to};
  }
  return ranges;
}

void saveRanges(const RangesByHand& ranges, QSettings& settings, const char* name) {
  constexpr int kDigits = 10;
  QStringList texts;
  for (const auto& [unit, range] : ranges)
    texts.append(QString::number(range.from, 'g', kDigits) + " " +
                 QString::number(range.to, 'g', kDigits) + " " + unit);
  settings.setValue(name, texts);
}
constexpr const char* kDifferencesKey = "timeline/differences";
constexpr const char* kLanesKey = "timeline/lanes";

}  // namespace

TimelineFeature::TimelineFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      groups_(windowState.settings),
      extras_(loadPlottedExtras(windowState.settings)) {
  TimelineActions& actions = actions_;
  header_ = new TimelineHeader({.ofSelection = {actions.zoomSelection,
                                                actions.addLabel,
                                                actions.crop,
                                                actions.statistics,
                                                actions.dropSelection},
                                .ofCursors = {actions.zoomSelection, actions.dropSelection},
                                .ofLive = {actions.takeBaseline, actions.freeze}},
                               window);
  signalTree_ = new SignalTree(groups_, windowState.formulas, window);
  signalTree_->setExtras(extras_);
  charts_ = new FittingPages(window);
  panel_ = new TimelinePanel(charts_);
  chart_ = &panel_->chart();
  liveChart_ = new LiveChart(charts_);
  axisEditor_ = new AxisEditor(window);
  charts_->addWidget(panel_);
  charts_->addWidget(liveChart_);
  dock_ = new Dock("Timeline", charts_, header_, window);
  crop_ = std::make_unique<CropJob>(windowState, *actions_.crop, *actions_.saveAs, window);
  connect(&windowState.appearance, &ViewAppearance::timeAxisChanged, this, [this, &windowState] {
    chart_->setRight(windowState.appearance.timeAxisRight());
  });
  connectSubject();
  connectLive();
  connectLiveChart();
  connectSelection();
  connectActions();
  connectCurves();
  editing_ = std::make_unique<EventEditing>(windowState, actions_, panel_->rows());
  baselines_ = std::make_unique<BaselineControls>(windowState, actions_);
  new LabelExchange(windowState, this);
  graspExport_ = new GraspExport(windowState, window, this);
}

TimelineFeature::~TimelineFeature() { liveChart_->setHistory(nullptr); }

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
  connect(
      chart_,
      &TimelineChart::rangeDropped,
      this,
      [this](const QString& name, const AxisRange& range) {
        state().messages.flash("the axis " + name + " was reset to automatic: no value of this " +
                               "recording is in the range set by hand, " +
                               QString::number(range.from) + " to " + QString::number(range.to));
      });
  ViewAppearance& look = state().appearance;
  followUnits(signalTree_);
  connect(&look, &ViewAppearance::changed, this, [this, &look] { showCurves(); });
  const auto useSignal = [&look](PlottedSignal signal) {
    look.change([&](ViewSettings& view) { view.signal = signal; });
  };
  connect(header_, &TimelineHeader::signalChosen, this, useSignal);
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
  renewComputed();
  if (displayed.isLive()) takeLive();
}

void TimelineFeature::renewComputed() {
  const DisplayedSource& displayed = state().displayed;
  const OpenedRecordingPtr& behind = displayed.unfilteredRecording();
  const OpenedRecordingPtr& seen = displayed.filteredRecording();
  computed_.clear();
  profile_.reset();
  reasons_.clear();
  if (!seen || !behind || displayed.isLive()) return;
  // Results of another feature may change before this one has taken the new recording.
  if (chart_->recording() != seen) return;
  if (seen->profile.numFrames() > 0) {
    ComputedOptions options;
    if (const auto forces = state().derivedResults.forcesOf(behind.get())) options = *forces;
    options.counts = behind->profile;
    computed_ = computedSeries(seen->profile, options);
    profile_ = withComputedSeries(seen->profile, options);
    chart_->setProfile(*profile_);
  }
  signalTree_->setSource(behind->profile.hand(),
                         {.hasAngles = behind->profile.numAngles() > 0,
                          .hasTemperatures = behind->profile.numTemperatures() > 0,
                          .series = furtherSeries(),
                          .computed = computed_});
}

bool TimelineFeature::cancelComputing() {
  if (!chart_->store().computing() || !profile_) return false;
  for (const ComputedSeries& series : computed_)
    for (const Column& column : series.description.columns)
      if (!isReady(*profile_,
                   {.kind = SeriesChoice::Kind::kColumn,
                    .series = series.description.name,
                    .column = column.name}))
        extras_.columns.erase(nameOf(series.description, column));
  for (const FormulaCurve& each : state().formulas.all())
    if (!isReady(*profile_, each.choice())) extras_.formulas.erase(each.name);
  extras_.calibrated = false;
  signalTree_->setExtras(extras_);
  showCurves();
  return true;
}

void TimelineFeature::takeLive() {
  const LiveSource* source = state().displayed.source();
  if (!source) return;
  if (source->history.get() != history_) {
    history_ = source->history.get();
    liveSeries_.clear();
    liveChart_->setHistory(history_, state().displayed.hand());
  }
  offerLiveCurves();
}

void TimelineFeature::offerLiveCurves() {
  const HandDescription* hand = state().displayed.isLive() ? state().displayed.hand() : nullptr;
  if (!hand) return;
  signalTree_->setSource(*hand,
                         {.hasAngles = !hand->axes.empty(),
                          .hasTemperatures = !hand->temperatureSensors.empty(),
                          .series = furtherSeries(),
                          .hasForces = hasForces_});
  showCurves();
}

void TimelineFeature::takeLiveSeries(const LiveResults& results) {
  if (std::ranges::equal(liveSeries_, results.further, {}, {}, [](const FurtherSample& each) {
        return each.series;
      }))
    return;
  liveSeries_.clear();
  for (const FurtherSample& each : results.further) liveSeries_.push_back(each.series);
  offerLiveCurves();
}

std::vector<SeriesDescription> TimelineFeature::furtherSeries() const {
  std::vector<SeriesDescription> further;
  if (state().displayed.isLive())
    for (const auto& each : liveSeries_) further.push_back(*each);
  else if (const OpenedRecordingPtr recording = state().displayed.recorded())
    further = furtherSeriesOf(recording->profile);
  return further;
}

void TimelineFeature::connectLive() {
  LiveController& live = state().live;
  CurrentFrame& currentFrame = state().currentFrame;
  connect(&live, &LiveController::leaving, this, [this] {
    liveChart_->setHistory(nullptr);
    history_ = nullptr;
  });
  connect(&state().displayed, &DisplayedSource::handChanged, this, [this] { offerLiveCurves(); });
  connect(&currentFrame, &CurrentFrame::resultsReceived, this, &TimelineFeature::takeLiveSeries);
  const DerivedResults& derived = state().derivedResults;
  connect(&derived, &DerivedResults::forcesChanged, this, [this] {
    if (state().displayed.isLive()) return;
    renewComputed();
    showCurves();
  });
  connect(&derived, &DerivedResults::pressureChanged, this, [this, &derived] {
    const bool has = derived.pressure() != nullptr;
    const bool areLimits = has && !derived.pressure()->areaKnown;
    if (has == hasForces_ && areLimits == forcesAreLimits_) return;
    hasForces_ = has;
    forcesAreLimits_ = areLimits;
    offerLiveCurves();
  });
  connect(&live, &LiveController::eventsReceived, this, [this](const std::vector<Event>& events) {
    for (const Event& event : events) liveChart_->addEvent(event);
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
  // The health of the link tells which frames are being recorded.
  connect(&live, &LiveController::refreshed, this, [this, &live] {
    const RecorderStatus& recorder = live.health().recorder;
    if (recorder.state != RecorderStatus::State::kRecording || recorder.firstFrameUs == 0) return;
    liveChart_->showRecording(recorder.firstFrameUs, recorder.lastFrameUs, true);
  });
  connect(&live, &LiveController::recordingEnded, this, [this](const RecordingReport& report) {
    liveChart_->showRecording(report.firstFrameUs, report.lastFrameUs, false);
  });
  QSettings& settings = state().settings;
  liveChart_->setWindowS(settings.value("live/window_s", LiveChart::kUsualS).toDouble());
  connect(liveChart_, &LiveChart::windowChanged, this, [&settings](double seconds) {
    settings.setValue("live/window_s", seconds);
  });
}

void TimelineFeature::connectLiveChart() {
  TimelineActions& actions = actions_;
  const auto showFrozen = [this] {
    const bool frozen = !liveChart_->following();
    actions_.freeze->setChecked(frozen);
    actions_.freeze->setIconText(frozen ? "To the newest" : "Freeze");
    actions_.freeze->setToolTip(frozen ? "Follow the newest frame again (End)"
                                       : "Freeze the chart; data keep arriving");
  };
  showFrozen();
  connect(liveChart_, &LiveChart::followingChanged, this, showFrozen);
  connect(liveChart_, &LiveChart::cursorsChanged, this, &TimelineFeature::showSelection);
  connect(liveChart_, &LiveChart::menuRequested, this, [this, &actions](const QPoint& at) {
    QMenu menu(window());
    menu.addActions({actions.freeze, actions.lanes, actions.newest, actions.oldest});
    menu.addSeparator();
    menu.addActions({actions.selectFrom, actions.selectTo});
    menu.addActions({actions.zoomSelection, actions.dropSelection});
    menu.addSeparator();
    menu.addActions({actions.chooseCurves, actions.axes});
    menu.exec(at);
  });
  on(actions.freeze, [this](bool frozen) { liveChart_->setFollowing(!frozen); });
  const bool lanes = state().settings.value(kLanesKey, false).toBool();
  actions.lanes->setChecked(lanes);
  liveChart_->setLanes(lanes);
  on(actions.lanes, [this](bool on) {
    liveChart_->setLanes(on);
    state().settings.setValue(kLanesKey, on);
  });
  on(actions.newest, [this] { liveChart_->setFollowing(true); });
  on(actions.oldest, [this] { liveChart_->showOldest(); });
  on(actions.earlier, [this] { liveChart_->scroll(-kScrollStep); });
  on(actions.later, [this] { liveChart_->scroll(kScrollStep); });
  on(actions.cursorBack, [this] { liveChart_->moveTimeCursor(-1); });
  on(actions.cursorForward, [this] { liveChart_->moveTimeCursor(1); });
  on(actions.axes, [this] {
    axisEditor_->openBeside(*header_->curvesButton(),
                            state().displayed.isLive() ? liveChart_->axes() : chart_->axes());
  });
  for (UnitAxes* axes : {&liveChart_->axes(), &chart_->axes()}) {
    const char* name = axes == &chart_->axes() ? kAxesSetting : kLiveAxesSetting;
    const QString logName = QString(name) + "_logarithmic";
    axes->setByHand(loadRanges(state().settings, name));
    const QStringList logs = state().settings.value(logName).toStringList();
    axes->setLogarithmic(std::set<QString>(logs.begin(), logs.end()));
    connect(axes, &UnitAxes::logarithmicChanged, this, [this, axes, logName] {
      const std::set<QString>& units = axes->logarithmic();
      state().settings.setValue(logName, QStringList(units.begin(), units.end()));
    });
    connect(axes, &UnitAxes::byHandChanged, this, [this, axes, name] {
      saveRanges(axes->byHand(), state().settings, name);
    });
  }
  state().actionEnabler.add({actions.freeze,
                             actions.lanes,
                             actions.newest,
                             actions.oldest,
                             actions.earlier,
                             actions.later},
                            [this] { return state().displayed.isLive(); });
  state().actionEnabler.add({actions.cursorBack, actions.cursorForward}, [this] {
    return state().displayed.isLive() && !liveChart_->cursorWords().isEmpty();
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
  connect(&selection, &Selection::plottedChanged, this, [this, &selection] { showCurves(); });
  connect(&selection, &Selection::taxelsChanged, this, [this, &selection] {
    signalTree_->setNumChosen(selection.taxels().count());
    if (extras_.chosenTaxels) showCurves();
  });
  state().escapeHandler.add(EscapeHandler::Order::kComputation,
                            [this] { return cancelComputing(); });
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
  on(actions.dropSelection, [this, &selection] {
    if (state().displayed.isLive()) return liveChart_->clearTimeCursors();
    selection.setSpan(std::nullopt);
  });
  on(actions.zoomSelection, [this, &selection] {
    const LiveChart::Cursors& cursors = liveChart_->cursors();
    if (state().displayed.isLive()) {
      if (!cursors[0] || !cursors[1]) return;
      const auto [fromS, toS] = std::minmax(*cursors[0], *cursors[1]);
      const double air = kCursorAir * (toS - fromS);
      return liveChart_->showSpan(fromS - air, toS + air);
    }
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
    if (!state().displayed.isLive()) return chart_->fit();
    liveChart_->setWindowS(LiveChart::kUsualS);
    liveChart_->setFollowing(true);
  });
  ActionEnabler& actionEnabler = state().actionEnabler;
  const auto frames = [this] { return state().displayed.hasFrames(); };
  actionEnabler.add({actions.zoomIn,
                     actions.zoomOut,
                     actions.fit,
                     actions.chooseCurves,
                     actions.axes,
                     actions.selectFrom,
                     actions.selectTo},
                    [this, frames] { return frames() || state().displayed.isLive(); });
  // Without a selection, cropping says so.
  actionEnabler.add({actions.selectAll, actions.saveAs, actions.differences, actions.crop}, frames);
  const auto selected = [frames, &selection] { return frames() && selection.span().has_value(); };
  actionEnabler.add({actions.statistics},
                    selected,
                    "Nothing is selected: drag over the timeline of a recording first");
  actionEnabler.add({actions.zoomSelection, actions.dropSelection}, [this, selected] {
    return state().displayed.isLive() ? !liveChart_->cursorWords().isEmpty() : selected();
  });
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
  connect(signalTree_, &SignalTree::formulaRequested, this, &TimelineFeature::askForFormula);
  on(actions_.newFormula, [this] { askForFormula({}); });
  state().actionEnabler.add({actions_.newFormula},
                            [this] { return state().displayed.hasFrames(); });
  state().actionEnabler.add({actions_.nameTaxels},
                            [this] { return state().displayed.hand() != nullptr; });
  connect(&state().formulas, &FormulaCurves::changed, this, &TimelineFeature::showCurves);
}

void TimelineFeature::askForFormula(const QString& name) {
  const OpenedRecordingPtr recording = state().displayed.filteredRecording();
  if (!recording || recording->profile.numFrames() == 0)
    return state().messages.flash("a formula needs a recording with frames");
  const FormulaCurve before = state().formulas.named(name).value_or(FormulaCurve{});
  const Profile profile = profile_.value_or(recording->profile);
  std::vector<FormulaSignal> from =
      formulaSignals(profile, plottedSignal(), state().selection.taxels());
  // What is plotted comes first.
  const std::vector<PlottedCurve> shown = curves();
  std::stable_partition(from.begin(), from.end(), [&](const FormulaSignal& each) {
    return std::any_of(shown.begin(), shown.end(), [&](const PlottedCurve& curve) {
      return palpate::nameOf(curve.choice, recording->profile.layout()) == each.name.toStdString();
    });
  });
  auto* dialog = new FormulaDialog(std::move(from), profile, before, window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, [this, dialog, before] {
    const FormulaCurve made = dialog->curve();
    FormulaCurves& formulas = state().formulas;
    // Renamed: the old name goes, unless the new one can't be kept.
    if (!formulas.keep(made))
      return state().messages.fail("There are too many formulas: delete some (Curves, Del)");
    extras_.formulas.insert(made.name);
    if (!before.name.isEmpty() && before.name != made.name) {
      extras_.formulas.erase(before.name);
      formulas.forget(before.name);
    }
    signalTree_->setExtras(extras_);
    showCurves();
  });
  dialog->open();
}

PlottedCurve TimelineFeature::matrixCurveOf(const HandDescription& hand, std::size_t row) const {
  const DisplayUnits& units = state().appearance.view().units;
  const PlottedSignal signal = plottedSignal();
  PlottedCurve made = matrixCurve(hand, row, signal, units);
  if (!extras_.calibrated || state().displayed.isLive()) return made;
  const bool isForce = signal == SignalKind::kSum;
  const bool isPressure = signal == SignalKind::kMean || signal == SignalKind::kFilteredMean ||
                          signal == SignalKind::kMaximum;
  if (!isForce && !isPressure) return made;
  for (const ComputedSeries& series : computed_) {
    if (series.kind != (isForce ? ComputedKind::kForce : ComputedKind::kPressure) ||
        series.matrix != row || !series.missing.empty())
      continue;
    PlottedCurve calibrated =
        computedCurve(hand, series, signal == SignalKind::kMaximum ? 1 : 0, units);
    calibrated.pen = made.pen;
    return calibrated;
  }
  return made;
}

PlottedSignal TimelineFeature::plottedSignal() const {
  return plottable(state().appearance.view().signal, state().displayed.givesReadings());
}

void TimelineFeature::showSignal() {
  const bool components = state().displayed.givesReadings();
  header_->setComponents(components);
  header_->setSignal(plottedSignal());
  const QList<QAction*> actions = actions_.signalsPlotted->actions();
  for (qsizetype i = static_cast<qsizetype>(kAllSignalKinds.size()); i < actions.size(); ++i)
    actions[i]->setVisible(components);
  checkChoice(actions_.signalsPlotted, kAllPlottedSignals, plottedSignal());
}

std::vector<PlottedCurve> TimelineFeature::curves() const {
  std::vector<PlottedCurve> curves;
  const HandDescription* hand = state().displayed.hand();
  if (!hand) return curves;
  const DisplayUnits& units = state().appearance.view().units;
  const std::vector<bool>& plotted = state().selection.plotted();
  for (std::size_t row = 0; row < plotted.size(); ++row)
    // The whole hand has no components.
    if (plotted[row] && (row < hand->layout->numMatrices() || !isComponent(plottedSignal())))
      curves.push_back(matrixCurveOf(*hand, row));
  const bool live = state().displayed.isLive();
  const OpenedRecordingPtr recording = state().displayed.recorded();
  if (!recording && !live) return curves;
  const auto add = [&](PlottedCurve curve) {
    if (live || hasSeries(profile_.value_or(recording->profile), curve.choice))
      curves.push_back(std::move(curve));
  };
  const TaxelSelection& chosen = state().selection.taxels();
  if (extras_.chosenTaxels && !chosen.empty()) {
    const std::size_t count = chosen.count();
    add(taxelCurve(*hand,
                   chosen,
                   count == 1 ? "chosen taxel: " + placeOfTaxel(*hand, chosen)
                              : QString::number(count) + " chosen taxels",
                   0));
  }
  // Places count curves that aren't shown, too: a curve keeps its colour when others come or go.
  std::size_t place = 0;
  for (const TaxelGroups::Group& group :
       groups_.of(live ? *hand->layout : recording->profile.layout()))
    if (++place; extras_.groups.contains(group.name))
      add(taxelCurve(*hand, group.taxels, group.name, place));
  place = 0;
  for (const FormulaCurve& each : state().formulas.all()) {
    if (recording && !live && extras_.formulas.contains(each.name) &&
        reasonAgainst(each).isEmpty()) {
      PlottedCurve curve = formulaCurve(each.choice(), each.name, each.unit, place);
      distinguish(curve, place, curves);
      add(std::move(curve));
    }
    ++place;
  }
  for (const int axis : extras_.angles)
    if (axis < static_cast<int>(hand->axes.size()))
      add(angleCurve(*hand, static_cast<std::size_t>(axis), units));
  for (const int sensor : extras_.temperatures)
    if (sensor < static_cast<int>(hand->temperatureSensors.size()))
      add(temperatureCurve(*hand, static_cast<std::size_t>(sensor), units));
  place = 0;
  for (const SeriesDescription& series : furtherSeries())
    for (std::size_t column = 0; column < series.columns.size(); ++column, ++place)
      if (extras_.columns.contains(nameOf(series, series.columns[column])))
        add(columnCurve(series, column, place));
  for (const ComputedSeries& series : computed_)
    for (std::size_t i = 0; i < series.description.columns.size(); ++i)
      if (extras_.columns.contains(nameOf(series.description, series.description.columns[i])))
        add(computedCurve(*hand, series, i, units));
  for (const int row : extras_.forces)
    if (live && hasForces_ && row <= static_cast<int>(hand->layout->numMatrices())) {
      PlottedCurve curve = forceCurve(*hand, static_cast<std::size_t>(row));
      if (forcesAreLimits_) curve.name += ", upper limit";
      add(std::move(curve));
    }
  return curves;
}

void TimelineFeature::showCurves() {
  showSignal();
  const bool live = state().displayed.isLive();
  const std::vector<PlottedCurve> now = curves();
  header_->setCurves(now);
  header_->setLive(live);
  if (live)
    liveChart_->setCurves(now);
  else
    chart_->setCurves(now);
  QStringList notes;
  for (const FormulaCurve& each : state().formulas.all()) {
    if (live || !extras_.formulas.contains(each.name)) continue;
    if (const QString reason = reasonAgainst(each); !reason.isEmpty())
      notes.append(each.name + " can't be computed: " + reason);
  }
  if (const QString reason = reasonOfGaps(now); !reason.isEmpty()) notes.append(reason);
  chart_->setNotes(notes);
}

QString TimelineFeature::reasonOfGaps(const std::vector<PlottedCurve>& curves) const {
  const auto forces =
      state().derivedResults.forcesOf(state().displayed.unfilteredRecording().get());
  if (!forces || !forces->calibration || forces->calibration->pressure.knowsArea()) return {};
  const auto isForce = [this](const PlottedCurve& curve) {
    if (curve.choice.kind == SeriesChoice::Kind::kFormula)
      return curve.choice.formula.find("_force_n") != std::string::npos;
    return std::ranges::any_of(computed_, [&](const ComputedSeries& series) {
      return series.kind == ComputedKind::kForce && curve.choice.series == series.description.name;
    });
  };
  if (state().displayed.isLive() || !std::ranges::any_of(curves, isForce)) return {};
  return "Forces have gaps at contacts: the calibration has no area of its indenter. Give it in "
         "the dock Calibrate, page Pressure (Indenter in mm²)";
}

QString TimelineFeature::reasonAgainst(const FormulaCurve& formula) const {
  const OpenedRecordingPtr recording = state().displayed.recorded();
  if (!recording || recording->profile.numFrames() == 0) return {};
  if (reasonsFor_.lock() != recording) reasons_.clear();
  reasonsFor_ = recording;
  const auto known = reasons_.find(formula.formula);
  if (known != reasons_.end()) return known->second;
  const Profile& profile = profile_ ? *profile_ : recording->profile;
  return reasons_[formula.formula] = problemOf(formula.formula, &profile);
}

void TimelineFeature::showReading() {
  const OpenedRecordingPtr recording = state().displayed.recorded();
  if (state().displayed.isLive()) return;
  const double done = chart_->store().progress();
  const auto computing = chart_->store().computing();
  header_->setReading(
      computing    ? "computing " + QString::number(static_cast<int>(*computing * 100.0)) + " %"
      : done < 1.0 ? "reading " + QString::number(static_cast<int>(done * 100.0)) + " %"
                   : QString());
  if (recording && recording->isLong() && done >= 1.0) state().displayed.notifyMoreKnown();
}

void TimelineFeature::showSelection() {
  if (state().displayed.isLive()) {
    header_->setSelection(liveChart_->cursorWords());
    return state().actionEnabler.refresh();
  }
  QString words;
  const auto& span = state().selection.span();
  if (span && state().displayed.isRecording()) {
    const auto frames = state().selectedFrames();
    const std::size_t count = frames ? frames->count() : 0;
    words = figure(span->fromS, 2) + " – " + figure(span->toS, 2) + " s · " +
            (count == 0 ? QString("no frame") : numberOf(count, "frame"));
  }
  header_->setSelection(words);
  state().actionEnabler.refresh();
}

void TimelineFeature::selectEnd(bool begin) {
  if (state().displayed.isLive()) return liveChart_->setTimeCursorHere(begin ? 0 : 1);
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
  if (shown.empty()) return state().messages.flash("no curve is shown: choose some with Curves");
  auto selected = std::make_shared<SelectedCurves>();
  statisticsJob_.cancel();
  statisticsJob_.start(
      fileNameOf(*recording),
      [recording, shown, frames, selected, profile = profile_](const Progress& progress) {
        *selected = selectedCurves(recording, shown, *frames, progress, profile);
      },
      [this, recording, frames, selected] {
        const QString range = fileNameOf(*recording) + state().activeFilters.caption() +
                              ", frames " + QString::number(frames->first) + " to " +
                              QString::number(frames->last) + ", " +
                              figure(recording->timeAt(frames->first), 3) + " to " +
                              figure(recording->timeAt(frames->last), 3) + " s";
        auto* dialog = new StatisticsDialog(*selected, range, window());
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->show();
      });
}

void TimelineFeature::nameChosenTaxels() {
  const TaxelSelection chosen = state().selection.taxels();
  Messages& messages = state().messages;
  if (chosen.empty())
    return messages.flash("no taxel is chosen: click or drag over some of the matrices");
  const auto name = state().ask.text("Name of the taxels", "Name of the taxels:", "");
  if (!name) return;
  if (name->isEmpty()) return messages.flash("a group of taxels needs a name");
  if (!groups_.keep(*name, chosen))
    return messages.fail("There are too many groups of taxels: forget some (Curves, Del)");
  extras_.groups.insert(*name);
  signalTree_->setExtras(extras_);
  showCurves();
  messages.flash("kept: " + *name + ", " + numberOf(chosen.count(), "taxel"));
}

std::vector<DockSpec> TimelineFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+L"),
           .area = Qt::BottomDockWidgetArea,
           .liveArea = Qt::BottomDockWidgetArea,
           .shownIn = {kAllPresets.begin(), kAllPresets.end()}}};
}

std::vector<BannerSpec> TimelineFeature::strips() {
  return {{BannerSpec::Order::kWork, &crop_->strip()},
          {BannerSpec::Order::kWork, &crop_->offer()},
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
  view.minHeightShare = kChartHeight;
  view.isThere = [&windowState] { return windowState.currentFrame.hasFrame(); };
  view.fileName = [this, &windowState] {
    return windowState.recordingStem() + "_" + nameOf(plottedSignal()).replace(' ', '_');
  };
  view.paint = [this, &windowState](QPainter& painter, const PictureLook& look) {
    ChartPictureOptions options;
    options.title = windowState.pictureTitle();
    for (const PlottedCurve& curve : curves()) options.legend.push_back({curve.name, curve.pen});
    QCustomPlot* plot =
        windowState.displayed.isLive() ? static_cast<QCustomPlot*>(liveChart_) : chart_;
    paintChart(painter, look, *plot, options);
  };
  // The chart with a cursor that moves from frame to frame.
  view.framePart = [this, &windowState]() -> std::optional<FramePictures> {
    std::optional<FramePictures> pictures = windowState.framePictures("_timeline");
    if (!pictures) return pictures;
    pictures->painter =
        [this, recording = windowState.displayed.filteredRecording()](const PictureLook& look) {
          ChartPictureOptions options;
          for (const PlottedCurve& curve : curves())
            options.legend.push_back({curve.name, curve.pen});
          auto chart = std::make_shared<QPicture>();
          QPainter onPicture(chart.get());
          const QRectF axes = paintChart(onPicture, look, *chart_, options);
          onPicture.end();
          const Theme theme = look.forPrint ? Theme::kLight : shownTheme();
          const QPen pen(colorsOf(theme).accent, 2.0);
          return FramePictures::Paint([chart, axes, pen, recording, seen = chart_->seen()](
                                          QPainter& painter, std::size_t frame) {
            replay(painter, *chart);
            const double share = (recording->timeAt(frame) - seen.lower) / seen.size();
            if (share < 0.0 || share > 1.0) return;
            const double x = axes.left() + share * axes.width();
            painter.setPen(pen);
            painter.drawLine(QPointF(x, axes.top()), QPointF(x, axes.bottom()));
          });
        };
    return pictures;
  };
  view.tables = [this, &windowState] {
    std::vector<ExportedTable> tables;
    const LiveChart::Cursors& cursors = liveChart_->cursors();
    if (windowState.displayed.isLive() && cursors[0] && cursors[1])
      tables.push_back({"the two cursors", [made = liveChart_->cursorTable()] { return made; }});
    const OpenedRecordingPtr recording = windowState.displayed.recorded();
    if (!recording) return tables;
    const auto add = [&](const QString& name, const std::optional<FrameSpan>& span) {
      if (!span) return;
      tables.push_back({name,
                        [seen = windowState.displayed.filteredRecording(),
                         now = curves(),
                         span = *span,
                         profile = profile_] { return curveTable(seen, now, span, profile); }});
    };
    add("the selected range", windowState.selectedFrames());
    const QCPRange seen = chart_->seen();
    if (const auto frames = recording->framesWithin(seen.lower, seen.upper))
      add("what is seen", FrameSpan{frames->first, frames->second});
    add("the whole recording", FrameSpan{0, recording->profile.numFrames() - 1});
    if (const auto selected = windowState.selectedFrames())
      tables.push_back(
          {"statistics of the selected range",
           [of = windowState.displayed.filteredRecording(),
            now = curves(),
            span = *selected,
            profile = profile_] { return statisticsTable(of, now, span, {}, profile); }});
    return tables;
  };
  return {view};
}

}  // namespace palpate::gui
