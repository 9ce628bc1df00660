#include "gui/calibrate/tare_page.h"

#include <QLabel>
#include <QPushButton>
#include <algorithm>

#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

#include "gui/appearance/captions.h"
#include "gui/calibrate/measure_row.h"
#include "gui/picture/table_picture.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/make.h"
#include "gui/widgets/notes_label.h"

namespace palpate::gui {
namespace {

constexpr int kTareMeasureS = 5;

std::vector<FigureColumn> tarePageColumns() {
  return {{"matrix", {}, 16, true},
          {"unloaded", "Time in which nothing touches it; below: windows", 10},
          {"largest tare", "Largest tare of its taxels [counts]", 10},
          {"taxels", "With a tare above 0", 8},
          {"", "Why there is no tare", 16, true}};
}

double tarePageSecondsOf(const UnloadedWindow& window, const OpenedRecording& of) {
  return of.timeAt(window.end) - of.timeAt(window.begin);
}

double tarePageSecondsOf(const MatrixTare& tare, const OpenedRecording& of) {
  double sum = 0.0;
  for (const UnloadedWindow& window : tare.windows) sum += tarePageSecondsOf(window, of);
  return sum;
}

QString tarePageNameOf(std::size_t matrix, const OpenedRecording& of) {
  return QString::fromStdString(of.profile.hand().matrixName(matrix));
}

std::vector<FigureCell> tarePageRowOf(std::size_t m,
                                      const MatrixTare& tare,
                                      const OpenedRecording& of) {
  const auto count = static_cast<int>(tare.windows.size());
  if (!tare.valid)
    return {{.text = tarePageNameOf(m, of)},
            {.text = "–"},
            {.text = "–"},
            {.text = "–"},
            {.text = "never unloaded",
             .detail = QString::fromStdString(tare.note),
             .tip = QString::fromStdString(tare.note),
             .warning = true}};
  return {{.text = tarePageNameOf(m, of)},
          {.text = figure(tarePageSecondsOf(tare, of), 1) + " s",
           .detail = QString::number(count) + (count == 1 ? " window" : " windows")},
          {.text = figure(tare.largestZero, 1)},
          {.text = QString::number(tare.raisedTaxels)},
          {.text = tare.raisedTaxels == 0 ? "0 (median)" : "",
           .tip = tare.raisedTaxels == 0
                      ? QString("The median of the readings of every taxel is 0 in these windows: "
                                "there is nothing to subtract")
                      : QString::fromStdString(tare.note)}};
}

TextTable matrixTable(const std::shared_ptr<const Tare>& tare, const OpenedRecordingPtr& of) {
  return {.header = {"matrix",
                     "valid",
                     "windows",
                     "unloaded_s",
                     "largest_tare [counts]",
                     "raised_taxels",
                     "note"},
          .numRows = tare->matrices.size(),
          .row = [tare, of](std::size_t row) {
            const MatrixTare& matrix = tare->matrices[row];
            return std::vector<std::string>{std::to_string(row),
                                            matrix.valid ? "1" : "0",
                                            std::to_string(matrix.windows.size()),
                                            numberText(tarePageSecondsOf(matrix, *of)),
                                            numberText(matrix.largestZero),
                                            std::to_string(matrix.raisedTaxels),
                                            matrix.note};
          }};
}

// The tare of every place of the layout, as the event stores it.
TextTable zeroTable(const std::shared_ptr<const Tare>& tare, const OpenedRecordingPtr& of) {
  struct Place {
    std::size_t matrix;
    int y, x;
  };
  std::vector<Place> places;
  const SensorLayout& layout = of->profile.layout();
  for (std::size_t m = 0; m < layout.numMatrices(); ++m)
    for (int y = 0; y < layout.matrix(m).rows; ++y)
      for (int x = 0; x < layout.matrix(m).columns; ++x) places.push_back({m, y, x});
  const std::size_t count = std::min(places.size(), tare->zero.size());
  return {.header = {"matrix", "y", "x", "tare [counts]"},
          .numRows = count,
          .row = [tare, places = std::move(places)](std::size_t row) {
            const Place& place = places[row];
            return std::vector<std::string>{std::to_string(place.matrix),
                                            std::to_string(place.y),
                                            std::to_string(place.x),
                                            numberText(tare->zero[row])};
          }};
}

}  // namespace

Event tareEvent(const Tare& tare, const Profile& profile) {
  std::size_t raised = 0;
  for (const MatrixTare& matrix : tare.matrices) raised += matrix.raisedTaxels;
  Event event;
  event.tUs = profile.frameTimeUs(0);
  event.t1Us = profile.frameTimeUs(profile.numFrames() - 1);
  event.kind = "tare";
  event.text = "tare of " + counted(raised, "taxel");
  event.json = jsonOf(tare, profile.layout()).text(-1);
  return event;
}

Event liveTareEvent(Tare tare, const Profile& measured, std::int64_t atUs) {
  for (MatrixTare& matrix : tare.matrices) matrix.windows.clear();
  Event event = tareEvent(tare, measured);
  event.tUs = event.t1Us = atUs;
  event.text +=
      ", measured for " + fixedText(static_cast<double>(measured.durationUs()) / kUsPerS, 1) + " s";
  return event;
}

TarePage::TarePage(QSettings& settings, QWidget* parent) : ComputedPage("tare", parent) {
  measure_ = new MeasureRow(settings,
                            {.part = "tare",
                             .usualSeconds = kTareMeasureS,
                             .needsThreshold0 = false,
                             .tip = "Readings of the connected hand, which nothing may touch"},
                            this);
  top().addWidget(measure_);
  state_ = makeLines(this, "tareState");
  state_->hide();
  remove_ =
      makeButton(this, "tareRemove", "Remove", "Use the recorded values without a tare again");
  keep_ = makePrimary(this,
                      "tareKeep",
                      "Add to the recording",
                      "Add it as an event: forces use it, values never change (undo: Ctrl+Z)");
  top().addWidget(state_);
  top().addLayout(inRow({Stretch{}, remove_, keep_}));
  auto* content = new QWidget(this);
  table_ = named(new FiguresTable(tarePageColumns(), content), "tareTable", {}, "Readings at rest");
  notes_ = notesLabel("tareNotes", content);
  notes_->setText(
      "The tare of a taxel is the median of its mean readings in these windows. Only forces (page "
      "Force, newtons in Inspect) use it: without it a taxel that reads something at rest adds to "
      "the force. Heat maps, contacts and grasps show the readings as they were recorded.");
  content->setLayout(inColumn({{table_, 1}, notes_}, Space::kNone));
  setContent(content);
  connect(measure_, &MeasureRow::measured, this, &TarePage::setMeasured);
  connect(measure_, &MeasureRow::said, this, &TarePage::said);
  connect(keep_, &QPushButton::clicked, this, &TarePage::keepRequested);
  connect(remove_, &QPushButton::clicked, this, &TarePage::removeRequested);
  connect(table_, &FiguresTable::rowChosen, this, [this](int chosen) {
    const auto& windows = found_->matrices[static_cast<std::size_t>(chosen)].windows;
    // The windows of a measurement are in no recording that could be shown.
    if (windows.empty() || live()) return;
    const auto longest = std::max_element(windows.begin(), windows.end(), [&](auto& a, auto& b) {
      return tarePageSecondsOf(a, *recording()) < tarePageSecondsOf(b, *recording());
    });
    emit spanChosen(recording()->timeAt(longest->begin), recording()->timeAt(longest->end));
  });
  showState();
}

void TarePage::forget() {
  found_.reset();
  added_ = false;
  showState();
}

void TarePage::compute() {
  const OpenedRecordingPtr of = recording();
  run("unloaded windows", [this, of](const Progress& progress) -> Take {
    auto found = std::make_shared<const Tare>(findTare(of->profile, {}, progress));
    // In a recording the other matrices are of use; the connected hand can be measured again.
    if (isMeasured(*of))
      if (const auto why = notAtRest(*found, of->profile, 0.0); !why.empty())
        return [this, why] { say(refusal(why)); };
    return [this, found] { take(found); };
  });
}

QString TarePage::liveReason() const {
  return "\"Measure now\" reads the taxels of the connected hand while nothing touches it.\n\nOr "
         "record it (Ctrl+R), then open the recording.";
}

void TarePage::take(const std::shared_ptr<const Tare>& found) {
  found_ = found;
  showState();
  const auto& all = found->matrices;
  if (std::none_of(all.begin(), all.end(), [](const MatrixTare& each) { return each.valid; })) {
    const QString why = all.empty() ? QString() : QString::fromStdString(all.front().note);
    return say("No unloaded window was found: " + why +
               "\n\nA tare needs a second in which nothing touches a matrix.");
  }
  std::vector<std::vector<FigureCell>> rows;
  for (std::size_t m = 0; m < all.size(); ++m)
    rows.push_back(tarePageRowOf(m, all[m], *recording()));
  table_->setRows(rows);
  showContent();
}

void TarePage::setRecordingRuns(bool runs) {
  if (runs == recordingRuns_) return;
  recordingRuns_ = runs;
  added_ = false;
  showState();
}

void TarePage::setAdded() {
  added_ = true;
  showState();
}

void TarePage::setKept(bool kept) {
  kept_ = kept;
  showState();
}

void TarePage::showState() {
  const bool unloaded = found_ && std::any_of(found_->matrices.begin(),
                                              found_->matrices.end(),
                                              [](const MatrixTare& each) { return each.valid; });
  const bool kept = kept_ && !live();
  const bool any = found_ && found_->any();
  state_->setText(kept               ? "This recording has a tare."
                  : unloaded && !any ? "The tare of every taxel is 0 (median): nothing to subtract."
                  : live() && added_ ? "Added to the recording that is running."
                  : live() && any && !recordingRuns_ ? "Record (Ctrl+R) to add this tare."
                                                     : "");
  state_->setVisible(!state_->text().isEmpty());
  keep_->setEnabled(any && (!live() || recordingRuns_));
  remove_->setVisible(kept);
}

std::vector<ExportedTable> TarePage::tables() const {
  if (!shown()) return {};
  return {
      {"unloaded windows", [tare = found_, of = recording()] { return matrixTable(tare, of); }},
      {"tare of each taxel", [tare = found_, of = recording()] { return zeroTable(tare, of); }}};
}

void TarePage::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  TablePicture picture{
      .title = title,
      .caption = "tare",
      .header = {"matrix", "unloaded in s", "windows", "largest tare in counts", "taxels"}};
  for (std::size_t m = 0; m < found_->matrices.size(); ++m) {
    const MatrixTare& tare = found_->matrices[m];
    picture.rows.push_back({tarePageNameOf(m, *recording()),
                            tare.valid ? figure(tarePageSecondsOf(tare, *recording()), 1) : "–",
                            QString::number(tare.windows.size()),
                            tare.valid ? figure(tare.largestZero, 1) : "–",
                            QString::number(tare.raisedTaxels)});
  }
  paintTable(painter, look, picture, font(), shownTheme());
}

}  // namespace palpate::gui
