#include "gui/inspect/inspect_panel.h"

#include <QBoxLayout>
#include <QLabel>
#include <QResizeEvent>
#include <algorithm>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/recording/recording_losses.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/hand_unit.h"
#include "gui/chart/plotted_curve.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

// From this width [px] the panel has two columns.
constexpr int kTwoColumnsFrom = 430;  // [px]; with large text the width that both columns need
// Least time between two live values that are shown [us].
constexpr std::int64_t kReadableUs = 100'000;

// Frame rate as text; slow rates get more decimals, as a recording may have 30 frames per second,
// or one in three seconds.
QString rate(double hz) {
  constexpr double kSlow = 10.0;
  return figure(hz, hz < kSlow ? 2 : 1);
}

std::vector<Fact> inspectPanelFactsOf(const OpenedRecording& recording,
                                      const QString& calibration) {
  const Profile& profile = recording.profile;
  const ProfileInfo& info = profile.info();
  std::vector<Fact> facts;
  facts.push_back({"file", QString::fromStdString(recording.path.filename().string())});
  const HandDescription& hand = profile.hand();
  const QString type = info.valueType == ValueType::kCounts ? unitOf(hand) : "float values";
  facts.push_back({"format", QString::fromStdString(info.format) + ", " + type});
  facts.push_back({"hand", QString::fromStdString(profile.hand().name)});
  if (!info.serial.empty()) facts.push_back({"serial", QString::fromStdString(info.serial)});
  if (profile.numFrames() > 0) {
    // Times that count from 0 have no date.
    constexpr std::int64_t kYearUs = 365LL * 24 * 3600 * 1'000'000;
    const std::int64_t startUs = profile.frameTimeUs(0);
    facts.push_back({"start (UTC)",
                     startUs < kYearUs ? QString("no date is known")
                                       : QString::fromStdString(utcText(startUs)).left(19)});
  }
  facts.push_back({"frames", QString::number(profile.numFrames())});
  if (const UnreadableSamples& unreadable = recording.unreadableNow(); unreadable.count > 0)
    facts.push_back({"unreadable frames", QString::number(unreadable.count), true});
  facts.push_back({"duration", figure(recording.timingNow().durationS, 2) + " s"});
  facts.push_back({"rate",
                   rate(recording.timingNow().rateHz) + " Hz (mean " +
                       rate(recording.timingNow().meanRateHz) + ")"});
  double longest = 0.0;
  for (const Gap& gap : recording.timingNow().gaps) longest = std::max(longest, gap.seconds);
  const auto gaps = recording.timingNow().gaps.size();
  facts.push_back({"gaps",
                   gaps == 0 ? QString("none")
                             : QString::number(gaps) + ", longest " + figure(longest, 1) + " s",
                   gaps > 0});
  const std::size_t taxels = profile.layout().numTaxels();
  std::size_t enabled = 0;
  for (const MatrixLayout& matrix : profile.layout().matrices()) enabled += matrix.numEnabled();
  facts.push_back({"taxels",
                   enabled == taxels
                       ? QString::number(taxels)
                       : QString::number(enabled) + " of " + QString::number(taxels) + " scanned",
                   enabled != taxels});
  const auto maximum = recording.maximumNow();
  facts.push_back({"largest value",
                   maximum ? figure(*maximum, decimalsOf(hand)) + " " + unitOf(hand)
                           : QString("being counted")});
  const auto saturated = recording.saturatedFramesNow();
  facts.push_back({"saturated frames",
                   saturated ? QString::number(*saturated) : QString("being counted"),
                   saturated.value_or(0) > 0});
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i)
    facts.push_back({"series " + QString::fromStdString(profile.series()[i].name),
                     QString::fromStdString(seriesText(profile, i))});
  facts.push_back({"calibration", calibration});
  for (const char* key : {"operator", "object", "run", "notes"})
    if (const auto said = recording.meta.find(key);
        said != recording.meta.end() && !said->second.empty())
      facts.push_back({key, QString::fromStdString(said->second).simplified()});
  for (const std::string& warning : info.warnings)
    facts.push_back({"warning", QString::fromStdString(warning), true});
  return facts;
}

// One fact per event, up to 200: its time [s] as the name; its kind and text as the value.
std::vector<Fact> inspectPanelEventFacts(const OpenedRecording& recording,
                                         const std::vector<Event>& events) {
  constexpr std::size_t kMaxListed = 200;
  std::vector<Fact> facts;
  const Profile& profile = recording.profile;
  const std::int64_t beginUs = profile.numFrames() > 0 ? profile.frameTimeUs(0) : 0;
  const auto seconds = [&](std::int64_t us) {
    return figure(static_cast<double>(us - beginUs) / kUsPerS, 2);
  };
  for (std::size_t i = 0; i < std::min(events.size(), kMaxListed); ++i) {
    const Event& event = events[i];
    QString when = seconds(event.tUs);
    if (event.t1Us != event.tUs) when += " – " + seconds(event.t1Us);
    const QString text = QString::fromStdString(event.text).simplified();
    const QString kind = QString::fromStdString(event.kind);
    facts.push_back({when + " s", text.isEmpty() ? kind : kind + ": " + text});
  }
  if (events.size() > kMaxListed)
    facts.push_back({"more", QString::number(events.size() - kMaxListed)});
  if (!recording.eventsFailure.empty())
    facts.push_back({"not read", QString::fromStdString(recording.eventsFailure), true});
  return facts;
}

// `sample`: null before the first one.
void addFurther(std::vector<Fact>& to, const SeriesDescription& series, const Sample* sample) {
  for (std::size_t i = 0; i < series.columns.size(); ++i) {
    const PlottedCurve curve = columnCurve(series, i, 0);
    to.push_back(
        {curve.name,
         readingOf(curve,
                   sample ? std::optional(valueIn(*sample, {kHandSeries, i})) : std::nullopt)});
  }
}

std::vector<Fact> noneOf() { return {{"none in this recording", ""}}; }

}  // namespace

InspectPanel::InspectPanel(QWidget* parent) : QScrollArea(parent) {
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);
  auto* content = new QWidget(this);
  model_ = new MatrixTableModel(content);
  matrices_ = new MatrixTable(model_, content);
  facts_ = named(new FactsView(content), "recordingFacts", {}, "Recording");
  events_ = named(new FactsView(content), "eventFacts", {}, "Events");
  eventsHeading_ = sectionHeading("Events", content);
  angles_ = named(new FactsView(content), "angleFacts", {}, "Joint angles");
  temperatures_ = named(new FactsView(content), "temperatureFacts", {}, "Temperatures");
  further_ = named(new FactsView(content), "seriesFacts", {}, "Series");

  heading_ = sectionHeading("Recording", content);
  anglesHeading_ = sectionHeading("Joint angles", content);
  temperaturesHeading_ = sectionHeading("Temperatures", content);
  furtherHeading_ = sectionHeading("Series", content);
  // Not a space of the layout, which would stay where the heading is hidden.
  furtherHeading_->setContentsMargins(0, px(Space::kWide), 0, 0);
  auto* right = inColumn({anglesHeading_,
                          angles_,
                          Space::kWide,
                          temperaturesHeading_,
                          temperatures_,
                          furtherHeading_,
                          further_,
                          Stretch{}},
                         Space::kNarrow);
  showFurther({});
  columns_ = new QBoxLayout(QBoxLayout::LeftToRight);
  columns_->setSpacing(20);
  columns_->addLayout(inColumn({heading_, facts_, Stretch{}}, Space::kNarrow), 6);
  columns_->addLayout(right, 5);

  content->setLayout(inColumn(
      {matrices_, columns_, inColumn({eventsHeading_, events_}, Space::kNarrow), Stretch{}},
      Space::kWide,
      kPageEdges));
  setWidget(content);
  content->installEventFilter(this);
}

void InspectPanel::setRecording(const OpenedRecordingPtr& recording,
                                const OpenedRecordingPtr& asRecorded) {
  latest_.reset();
  recording_ = recording;
  asRecorded_ = asRecorded;
  model_->setRecording(recording);
  // Events follow by showEvents(), as edited.
  showEvents({});
  if (!recording) {
    facts_->setFacts({});
    angles_->setFacts({});
    temperatures_->setFacts({});
    showFurther({});
    return;
  }
  heading_->setText("RECORDING");
  facts_->setFacts(inspectPanelFactsOf(*asRecorded, calibration_));
  listSensors(recording->profile.hand(),
              recording->profile.numAngles() > 0,
              recording->profile.numTemperatures() > 0);
}

void InspectPanel::showFurther(std::vector<Fact> values) {
  const bool same = std::ranges::equal(
      values,
      further_->facts(),
      {},
      [](const Fact& f) { return f.name; },
      [](const Fact& f) { return f.name; });
  for (QWidget* each : std::initializer_list<QWidget*>{furtherHeading_, further_})
    each->setVisible(!values.empty());
  if (!same) return further_->setFacts(std::move(values));
  for (std::size_t i = 0; i < values.size(); ++i) further_->setValue(i, values[i].value);
}

void InspectPanel::showEvents(const std::vector<Event>& events) {
  std::vector<Fact> facts;
  if (recording_) facts = inspectPanelEventFacts(*recording_, events);
  eventsHeading_->setVisible(!facts.empty());
  events_->setVisible(!facts.empty());
  events_->setFacts(std::move(facts));
}

void InspectPanel::setCalibration(const QString& text) {
  if (text == calibration_) return;
  calibration_ = text;
  renewFacts();
}

void InspectPanel::renewFacts() {
  if (asRecorded_) facts_->setFacts(inspectPanelFactsOf(*asRecorded_, calibration_));
}

void InspectPanel::setHand(const HandDescription& hand) {
  latest_.reset();
  shownUs_ = 0;
  recording_.reset();
  asRecorded_.reset();
  showEvents({});
  model_->setHand(hand);
  heading_->setText("LINK");
  facts_->setFacts({});
  listSensors(hand, true, true);
}

void InspectPanel::listSensors(const HandDescription& hand, bool angles, bool temperatures) {
  showFurther({});
  std::vector<Fact> rows;
  axes_ = hand.axes;
  shownAngles_.reset();
  shownTemperatures_.reset();
  for (const AxisDescription& axis : hand.axes)
    if (angles) rows.push_back({QString::fromStdString(axis.name), "–"});
  const bool slides = std::all_of(
      hand.axes.begin(), hand.axes.end(), [](const auto& axis) { return axis.isSliding; });
  anglesHeading_->setText(slides ? "JOINT POSITIONS" : "JOINT ANGLES");
  // What the hand lacks is absent; what the recording lacks is said.
  for (QWidget* each : std::initializer_list<QWidget*>{anglesHeading_, angles_})
    each->setVisible(!hand.axes.empty());
  for (QWidget* each : std::initializer_list<QWidget*>{temperaturesHeading_, temperatures_})
    each->setVisible(!hand.temperatureSensors.empty());
  angles_->setFacts(rows.empty() ? noneOf() : rows);
  rows.clear();
  for (const auto& sensor : hand.temperatureSensors)
    if (temperatures) rows.push_back({QString::fromStdString(sensor.name), "–"});
  temperatures_->setFacts(rows.empty() ? noneOf() : rows);
}

void InspectPanel::setLiveFacts(std::vector<Fact> facts) { facts_->setFacts(std::move(facts)); }

void InspectPanel::showLive(const LiveResults& results) {
  latest_ = std::make_unique<const LiveResults>(results);
  const std::int64_t sinceUs = results.frame->hostUs - shownUs_;
  if (sinceUs < 0 || sinceUs >= kReadableUs) showLatest();
}

void InspectPanel::showLatest() {
  if (!latest_) return;
  const auto results = std::move(latest_);
  shownUs_ = results->frame->hostUs;
  std::vector<CharacteristicSignals> rows = results->matrixSignals;
  rows.push_back(results->wholeSignals);
  model_->showSignals(rows);
  if (results->angles) showAngles(*results->angles);
  if (results->temperatures) showTemperatures(*results->temperatures);
  std::vector<Fact> further;
  for (const FurtherSample& each : results->further)
    addFurther(further, *each.series, &each.sample);
  showFurther(std::move(further));
}

void InspectPanel::showFrame(std::size_t frame,
                             const std::optional<Sample>& angles,
                             const std::optional<Sample>& temperatures) {
  if (!recording_) return;
  model_->showFrame(frame);
  if (angles) showAngles(*angles);
  if (temperatures) showTemperatures(*temperatures);
  std::vector<Fact> further;
  const Profile& profile = recording_->profile;
  for (std::size_t s = kHandSeries; s < profile.series().size(); ++s) {
    std::optional<Sample> sample;
    try {
      sample = profile.sampleAtFrame(s, frame);
    } catch (const Error&) {
      // Damaged there.
    }
    const bool begun = sample && sample->hostUs <= profile.frameTimeUs(frame);
    addFurther(further, profile.series()[s], begun ? &*sample : nullptr);
  }
  showFurther(std::move(further));
}

void InspectPanel::showAngles(const Sample& angles) {
  shownAngles_ = angles;
  const std::size_t rows = std::min({angles.values.size(), angles_->facts().size(), axes_.size()});
  for (std::size_t i = 0; i < rows; ++i)
    angles_->setValue(i, shownUnit(axes_[i], units_).text(angles.values[i], 1));
}

void InspectPanel::showTemperatures(const Sample& temperatures) {
  shownTemperatures_ = temperatures;
  const ShownUnit unit = shownUnit(units_.temperature);
  const std::size_t rows = std::min(temperatures.values.size(), temperatures_->facts().size());
  for (std::size_t i = 0; i < rows; ++i) {
    const double value = temperatures.values[i];
    temperatures_->setValue(i, value == 0.0 ? QString("–") : unit.text(value, 1));
  }
}

void InspectPanel::setUnits(const DisplayUnits& units) {
  units_ = units;
  model_->setUnits(units);
  if (shownAngles_) showAngles(Sample(*shownAngles_));
  if (shownTemperatures_) showTemperatures(Sample(*shownTemperatures_));
}

void InspectPanel::setStale(bool matrices, bool angles) {
  model_->setStale(matrices);
  for (FactsView* facts : {angles_, temperatures_, further_}) facts->setStale(angles);
}

void InspectPanel::arrange() {
  const QMargins around = widget()->layout()->contentsMargins();
  const int needed = around.left() + facts_->minimumSizeHint().width() + columns_->spacing() +
                     std::max({anglesHeading_->minimumSizeHint().width(),
                               temperaturesHeading_->minimumSizeHint().width(),
                               angles_->minimumSizeHint().width(),
                               angles_->wholeWidth(),
                               temperatures_->minimumSizeHint().width(),
                               temperatures_->wholeWidth(),
                               further_->minimumSizeHint().width(),
                               further_->wholeWidth()}) +
                     around.right();
  const bool wide = viewport()->width() >= std::max(kTwoColumnsFrom, needed);
  columns_->setDirection(wide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
  for (FactsView* facts : {angles_, temperatures_, further_})
    facts->setMinimumWidth(wide ? facts->wholeWidth() : 0);
}

void InspectPanel::resizeEvent(QResizeEvent* event) {
  arrange();
  QScrollArea::resizeEvent(event);
}

bool InspectPanel::eventFilter(QObject* watched, QEvent* event) {
  // The columns may need another width now.
  if (watched == widget() && event->type() == QEvent::LayoutRequest) arrange();
  return QScrollArea::eventFilter(watched, event);
}

}  // namespace palpate::gui
