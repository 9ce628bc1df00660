#include "gui/slip/slip_panel.h"

#include <QLabel>
#include <QSignalBlocker>
#include <QSplitter>
#include <algorithm>
#include <cmath>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/text_size.h"
#include "gui/slip/slip_chart.h"
#include "gui/slip/slip_controls.h"
#include "gui/slip/slip_indicator.h"
#include "gui/slip/slip_tables.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/make.h"
#include "gui/widgets/notes_label.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr std::size_t kSlipPanelMostKept = 8;
constexpr std::size_t kMaxLive = 20'000;              // frames of a live chart
constexpr int kListWidth = 380, kDrawingWidth = 240;  // [px] widths in the default dock
// [px] of the first text size; in a narrower list, matrices are "0 distal"
constexpr int kShortNames = 440;
constexpr double kLiveSeenS = 30.0;
constexpr double kPictureDrawing = 0.36;  // of the width of an exported picture

std::vector<FigureColumn> slipPanelColumns() {
  return {{"matrix", {}, 15, true},
          {"", "State of the contact", 10, true},
          {"step", "Motion of the last frame [taxels]", 4},
          {"in all", "Since the reference [taxels]", 5},
          {"turned", "Since the reference [deg], whole turns counted", 7}};
}

bool knowsReference(const SlipSeries& series) {
  for (const auto& samples : series.matrices)
    for (const SlipSample& sample : samples)
      if (sample.refValid) return true;
  return false;
}

// Computes slip; when no contact ever rests, motion is measured from the first contact instead.
SlipSeries seriesOf(const Profile& profile, SlipSeriesOptions options, const Progress& progress) {
  SlipSeries series = slipSeries(profile, options, progress);
  if (options.reference != SlipReference::kWhenAtRest || options.referenceFrame ||
      knowsReference(series))
    return series;
  options.reference = SlipReference::kFirst;
  return slipSeries(profile, options, progress);
}

QString millimetres(float dx, float dy, const TaxelPitch& pitchMm) {
  const auto x = static_cast<double>(dx), y = static_cast<double>(dy);
  return figure(std::hypot(x, y), 3) + " taxels, " + figure(pitchMm.lengthMm(x, y), 2) + " mm";
}

}  // namespace

SlipPanel::SlipPanel(QSettings& settings, QWidget* parent) : ComputedPage("slip", parent) {
  setObjectName("SlipPanel");
  controls_ = new SlipControls(settings, this);
  controls_->setReferenceEnabled(false);
  top().addWidget(controls_);
  auto* all = new QWidget(this);
  auto* left = new QWidget(all);
  list_ = named(new FiguresTable(slipPanelColumns(), left), "slipList", {}, "Slip of every matrix");
  list_->setSingleLine();
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  fitToText(*list_, [this] { showAllRows(); });
  notes_ = notesLabel("slipNotes", left);
  notes_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  // The list gets its height first; the notes scroll in the rest.
  const int threeLines = 3 * notes_->fontMetrics().lineSpacing() + 2 * notes_->margin();
  auto* notes = new ContentScroll(notes_, QSize(0, threeLines), left);
  left->setLayout(inColumn({list_, {notes, 1}}, Space::kNone));
  drawing_ = new SlipView(all);
  chart_ = new SlipChart(all);
  auto* beside = new QSplitter(Qt::Horizontal, all);
  beside->setChildrenCollapsible(false);
  beside->addWidget(left);
  beside->addWidget(drawing_);
  beside->setStretchFactor(0, 5);
  beside->setStretchFactor(1, 4);
  beside->setSizes({kListWidth, kDrawingWidth});
  all->setLayout(inColumn({{beside, 3}, {chart_, 2}}, Space::kNone));
  setContent(all);
  connect(list_, &FiguresTable::rowChosen, this, [this](int row) {
    chosenByUser_ = true;
    choose(static_cast<std::size_t>(row));
  });
  connect(chart_, &SlipChart::seekRequested, this, &SlipPanel::seekRequested);
  connect(controls_, &SlipControls::changed, this, &SlipPanel::changed);
  connect(controls_, &SlipControls::referenceRequested, this, &SlipPanel::setReference);
  // The icons of the rows have colours.
  fitToTheme(*this, [this] {
    if (hand() && found()) showRows();
  });
}

const HandDescription* SlipPanel::hand() const {
  if (live()) return liveHand_ ? &*liveHand_ : nullptr;
  return recording() ? &recording()->profile.hand() : nullptr;
}

const SlipSeries* SlipPanel::found() const noexcept {
  if (live()) return liveSeries_.timeS.empty() ? nullptr : &liveSeries_;
  return found_.get();
}

const SlipSample* SlipPanel::sampleNow(std::size_t matrix) const {
  const SlipSeries* series = found();
  return series && matrix < series->matrices.size() ? series->at(matrix, frame_) : nullptr;
}

QString SlipPanel::nameOfMatrix(std::size_t matrix) const {
  const HandDescription* of = hand();
  return of && matrix < of->matrices.size() ? QString::fromStdString(of->matrixName(matrix))
                                            : QString();
}

void SlipPanel::changed() {
  if (live()) {
    emit liveOptionsChanged();
    return;
  }
  found_.reset();
  renew();
}

void SlipPanel::setReference() {
  if (live()) {
    emit liveReferenceRequested();
    return;
  }
  if (!recording() || recording()->profile.numFrames() == 0) return;
  controls_->setReferenceFrame(frame_);
  changed();
}

QString SlipPanel::emptyReason() const {
  if (live()) return found() ? QString() : "Waiting for frames of what is connected.";
  if (!recording())
    return "Open a recording, or connect a hand (Ctrl+K), to see how its contacts move.";
  return ComputedPage::emptyReason();
}

void SlipPanel::forget() {
  found_.reset();
  liveSeries_ = {};
  values_ = {};
  frame_ = 0;
  chosenByUser_ = false;
  controls_->setLive(live());
  controls_->setReferenceEnabled(live() || recording());
  chart_->setSeries(nullptr, 0, {});
  drawing_->clear();
  emit foundChanged();
}

void SlipPanel::compute() {
  if (live()) return showFrame();
  const SlipSeriesOptions options = controls_->options();
  kept_.remove_if([](const Kept& each) { return each.of.expired(); });
  for (auto at = kept_.begin(); at != kept_.end(); ++at) {
    if (at->of.lock() != recording() || at->asked != options) continue;
    kept_.splice(kept_.begin(), kept_, at);
    return take(at->found);
  }
  const OpenedRecordingPtr of = recording();
  run("slip", [this, of, options](const Progress& progress) -> Take {
    const auto found = std::make_shared<const SlipSeries>(seriesOf(of->profile, options, progress));
    return [this, of, options, found] {
      kept_.push_front({of, options, found});
      if (kept_.size() > kSlipPanelMostKept) kept_.pop_back();
      take(found);
    };
  });
}

void SlipPanel::take(const Found& found) {
  found_ = found;
  const bool touched = std::any_of(found->matrices.begin(),
                                   found->matrices.end(),
                                   [](const auto& samples) { return !samples.empty(); });
  frame_ = found_->frameAt(positionS_);
  emit foundChanged();
  if (!touched) return say("No contact in this recording: nothing can slip.");
  if (!chosenByUser_) chooseBest();
  showContent();
  showChosen();
  showFrame();
}

// Chooses the matrix that slips most; else the one that is touched longest.
void SlipPanel::chooseBest() {
  std::vector<double> paths(found_->matrices.size(), 0.0);
  for (const SlipSegment& slip : found_->slips) paths[slip.matrix] += slip.pathTaxels;
  for (std::size_t m = 0; m < paths.size(); ++m)
    paths[m] += 1e-9 * static_cast<double>(found_->matrices[m].size());
  chosen_ = static_cast<std::size_t>(std::max_element(paths.begin(), paths.end()) - paths.begin());
}

void SlipPanel::chooseBestNow(const std::vector<SlipDetection>& detections) {
  constexpr double kSlipping = 1e12;    // more than any contact
  constexpr double kAboutAsMuch = 1.5;  // another contact has to be so much stronger
  double largest = 0.0;
  std::size_t best = chosen_;
  for (std::size_t m = 0; m < detections.size(); ++m) {
    double strength = static_cast<double>(values_.matrix(m).sum());
    if (detections[m].slipping) strength += kSlipping;
    if (m == chosen_) strength *= kAboutAsMuch;
    if (strength <= largest) continue;
    largest = strength;
    best = m;
  }
  chosen_ = best;
}

void SlipPanel::choose(std::size_t matrix) {
  chosen_ = matrix;
  showChosen();
  showFrame();
}

void SlipPanel::showChosen() {
  chart_->setSeries(found(), chosen_, nameOfMatrix(chosen_));
  chart_->setPosition(positionS_);
}

void SlipPanel::setVisibleRange(double fromS, double toS) {
  if (!live()) chart_->setVisibleRange(fromS, toS);
}

void SlipPanel::setMap(ColorMapName map) { drawing_->setMap(map); }

void SlipPanel::setPosition(double seconds) {
  positionS_ = seconds;
  if (live()) return;
  chart_->setPosition(seconds);
  if (!found_) return;
  frame_ = found_->frameAt(seconds);
  emit frameChanged();
  if (shown()) showFrame();
}

void SlipPanel::showFrame() {
  if (!found() || !hand()) return;
  if (!live()) {
    try {
      recording()->profile.readFrame(frame_, values_);
    } catch (const Error&) {
      // A damaged block: the view of the frame reports it.
      values_ = {};
    }
  }
  showRows();
  showScene();
  showNotes(sampleNow(chosen_));
}

void SlipPanel::showRows() {
  std::vector<std::vector<FigureCell>> rows;
  for (std::size_t m = 0; m < hand()->layout->numMatrices(); ++m) {
    const SlipSample* sample = sampleNow(m);
    const IndicatorLook indicator = indicatorOf(sample);
    const TaxelPitch& pitchMm = hand()->layout->matrix(m).pitchMm;
    const QString name = list_->width() < textScale() * kShortNames
                             ? QString::fromStdString(hand()->matrices.at(m).shortName)
                             : nameOfMatrix(m);
    std::vector<FigureCell> row = {
        {.text = name, .tip = nameOfMatrix(m), .icon = indicatorIcon(indicator)},
        {.text = stateTextOf(sample), .tip = meaningOf(sample)}};
    const auto add = [&](bool known, const QString& text, const QString& tip, bool warning) {
      row.push_back({.text = known ? text : QString("–"),
                     .tip = known ? tip : QString(),
                     .warning = known && warning});
    };
    const double step =
        sample ? std::hypot(static_cast<double>(sample->dx), static_cast<double>(sample->dy)) : 0.0;
    const SlipSeriesOptions& limits = found()->options;
    add(sample && sample->valid,
        figure(step, 2),
        sample ? millimetres(sample->dx, sample->dy, pitchMm) : QString(),
        step > limits.stepTaxels);
    const double whole = sample ? sample->shiftTaxels() : 0.0;
    add(sample && sample->refValid,
        figure(whole, 2),
        sample ? millimetres(sample->refDx, sample->refDy, pitchMm) : QString(),
        whole > limits.referenceTaxels);
    const double turned = sample ? static_cast<double>(sample->refRotationDeg) : 0.0;
    add(sample && sample->refRotationValid,
        figure(turned, 1) + "°",
        "Clockwise on the screen",
        std::abs(turned) > limits.rotationDeg);
    rows.push_back(std::move(row));
  }
  const QSignalBlocker blocker(list_);
  list_->setRows(rows);
  list_->selectRow(static_cast<int>(chosen_));
  showAllRows();
}

void SlipPanel::showAllRows() { list_->setMinimumHeight(list_->sizeHint().height()); }

void SlipPanel::showScene() {
  const SensorLayout& layout = *hand()->layout;
  if (chosen_ >= layout.numMatrices()) return;
  SlipViewData scene;
  scene.layout = layout.matrix(chosen_);
  scene.name = nameOfMatrix(chosen_);
  scene.stepTaxels = found()->options.stepTaxels;
  scene.referenceTaxels = found()->options.referenceTaxels;
  if (values_.layout && *values_.layout == layout) {
    scene.values = values_.matrix(chosen_);
    scene.largestCounts = static_cast<double>(scene.values.maxCoeff());
  }
  if (const SlipSample* now = sampleNow(chosen_)) {
    scene.sample = *now;
    for (const PathPoint& point : found()->pathUntil(chosen_, frame_))
      scene.path.emplace_back(point.x, point.y);
  }
  drawing_->setScene(scene);
}

void SlipPanel::showNotes(const SlipSample* sample) {
  QString text = meaningOf(sample);
  if (sample) {
    QStringList facts;
    if (sample->pMoved >= 0.0F)
      facts.append("motion score " + figure(static_cast<double>(sample->pMoved), 2));
    facts.append("confidence " + figure(static_cast<double>(sample->confidence), 2));
    facts.append("eccentricity " + figure(static_cast<double>(sample->eccentricity), 2));
    facts.append("roundness " + figure(static_cast<double>(sample->roundness), 2));
    text += "\n" + facts.join(" · ");
    if (!hand()->layout->matrix(chosen_).pitchMm.isSquare())
      text += "\nTaxels that aren't square: no rotation is measured.";
    if (!sample->refValid && !found()->options.referenceFrame)
      text += "\nNo reference yet: it is taken when the contact is at rest.";
    if (!live() && found()->options.reference != controls_->options().reference)
      text +=
          "\nNo contact is at rest in this recording: motion is measured from the first contact.";
  }
  if (const std::size_t count = found() ? found()->unreadable.count : 0; count > 0)
    text += "\nThe recording is damaged: " + QString::fromStdString(counted(count, "frame")) +
            " can't be read.";
  if (notes_->text() == text) return;
  notes_->setText(text);
  notes_->setToolTip(text);
}

void SlipPanel::setLiveHand(const HandDescription& hand) {
  liveHand_ = hand;
  liveSeries_ = {};
  liveSlips_.reset();
  liveSeries_.matrices.resize(hand.layout->numMatrices());
}

void SlipPanel::renewLiveHand(const HandDescription& hand) {
  if (!liveHand_) return;
  if (hand.layout->numMatrices() != liveSeries_.matrices.size()) return setLiveHand(hand);
  liveHand_ = hand;
}

void SlipPanel::showLive(const TactileFrame& frame, const std::vector<SlipDetection>& detections) {
  if (!live() || !liveHand_ || detections.size() != liveSeries_.matrices.size()) return;
  if (liveSeries_.timeS.empty()) liveSeries_.firstUs = frame.hostUs;
  if (liveSeries_.timeS.size() >= 2 * kMaxLive) {
    liveSeries_.dropFirst(kMaxLive);
    liveSlips_.reset();
  }
  if (!liveSlips_) liveSlips_.emplace(detections.size());
  liveSeries_.options = controls_->options();
  frame_ = liveSeries_.timeS.size();
  liveSeries_.timeS.push_back(static_cast<double>(frame.hostUs - liveSeries_.firstUs) / kUsPerS);
  for (std::size_t m = 0; m < detections.size(); ++m)
    if (detections[m].motion.active > 0)
      liveSeries_.matrices[m].push_back(sampleOf(detections[m], frame_));
  liveSlips_->add(frame_, frame.hostUs, detections);
  emit frameChanged();
  if (!isVisible()) return;
  liveSeries_.slips = liveSlips_->segments();
  values_ = frame;
  if (!chosenByUser_) chooseBestNow(detections);
  if (!shown()) showContent();
  positionS_ = liveSeries_.timeS.back();
  showChosen();
  chart_->setVisibleRange(std::max(0.0, positionS_ - kLiveSeenS), std::max(positionS_, kLiveSeenS));
  showFrame();
}

std::vector<ExportedTable> SlipPanel::tables() const {
  const SlipSeries* series = found();
  if (!series || !shown()) return {};
  auto held = live() ? std::make_shared<const SlipSeries>(*series) : found_;
  return {{"slip of every frame", [held] { return slipTable(held); }},
          {"slips that were found", [held] { return slipSegmentTable(held); }}};
}

void SlipPanel::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  PictureLook chart = look;
  const double width = look.size.width() * kPictureDrawing;
  chart.size.setWidth(look.size.width() - width);
  painter.save();
  drawing_->paint(painter,
                  QRectF(0.0, 0.0, width, look.size.height()),
                  look.forPrint ? Theme::kLight : shownTheme());
  painter.translate(width, 0.0);
  chart_->paint(painter, chart, title);
  painter.restore();
}

}  // namespace palpate::gui
