// What is seen of a comparison: frames, curves, figures; and how it is taken away.
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QStackedWidget>
#include <algorithm>
#include <cmath>

#include <palpate/core/number_text.h>

#include "gui/chart/chart_picture.h"
#include "gui/compare/compare_chart.h"
#include "gui/compare/compare_panel.h"
#include "gui/compare/compare_view.h"
#include "gui/look/difference_map.h"

namespace palpate::gui {
namespace {

constexpr double kLeastRange = 1.0;     // [counts]
constexpr double kHeatMapShare = 0.62;  // of an exported picture's height

QString figure(double value, int decimals) {
  return QString::fromStdString(fixedText(value, decimals));
}

double comparePanelViewLargestOf(const TactileFrame& frame) {
  double largest = 0.0;
  for (const float value : frame.values)
    largest = std::max(largest, std::abs(static_cast<double>(value)));
  return largest;
}

QString durationText(double seconds) {
  constexpr double kMinuteS = 60.0, kHourS = 3600.0, kDayS = 86'400.0;
  if (seconds < 2 * kMinuteS) return figure(seconds, 2) + " s";
  if (seconds < 2 * kHourS) return figure(seconds / kMinuteS, 1) + " min";
  if (seconds < 2 * kDayS) return figure(seconds / kHourS, 1) + " h";
  return figure(seconds / kDayS, 1) + " days";
}

const TimedProfile& sideOf(const CompareAnswer& answer, bool ofB) {
  return ofB ? *answer.b : *answer.a;
}

}  // namespace

void ComparePanel::showEmpty() {
  stack_->setCurrentIndex(hasPair() ? 1 : 0);
  if (hasPair()) return;
  emptyItself_->setVisible(a_ != nullptr);
  emptyOpen_->setText(a_ ? "Open another…" : "Open recordings…");
  emptyText_->setText(a_ ? "Only " + fileNameOf(*a_) +
                               " is open. Open a second recording to compare it with."
                         : QString("Open two recordings to compare them."));
}

void ComparePanel::showCurves() {
  chart_->setCurves({.a = answer_.a,
                     .b = answer_.b,
                     .curveA = answer_.curveA,
                     .curveB = answer_.curveB,
                     .offsetS = answer_.offsetS,
                     .signal = settings_.signal});
}

QString ComparePanel::captionOf(bool ofB, const std::optional<std::size_t>& frame) const {
  if (!frame) return "no frame";
  return "frame " + QString::number(*frame) + " · " +
         figure(sideOf(answer_, ofB).timeS(*frame), 2) + " s";
}

QString ComparePanel::absenceOf(bool ofB) const {
  const TimedProfile& timed = sideOf(answer_, ofB);
  const QString name = ofB ? "B" : "A";
  if (timed.profile.numFrames() == 0) return name + " holds no frame";
  const double offsetS = ofB ? answer_.offsetS : 0.0;
  const double at = timeS_ - offsetS;
  if (at < 0.0) return name + " begins " + durationText(-at) + " later";
  const double durationS = timed.timing.durationS;
  if (at > durationS) return name + " ended " + durationText(at - durationS) + " ago";
  return name + " has a gap here: nothing was recorded";
}

void ComparePanel::showFrames() {
  if (!hasPair() || !active_) return;
  ComparedFrames frames;
  auto& [inA, inB, between] = frames;
  inA.name = fileNameOf(*a_);
  inB.name = fileNameOf(*b_);
  between.name = "A − B";
  if (!answer_.a || !answer_.b) {
    inA.notice = inB.notice = answer_.failure.isEmpty() ? "reading …" : answer_.failure;
    view_->setFrames(std::move(frames));
    showLook();
    return showNotice();
  }
  for (const bool ofB : {false, true}) {
    CompareGroupContent& content = ofB ? inB : inA;
    const TimedProfile& timed = sideOf(answer_, ofB);
    const auto frame = timed.frameAt(timeS_ - (ofB ? answer_.offsetS : 0.0));
    content.caption = captionOf(ofB, frame);
    if (frame)
      timed.profile.readFrame(*frame, content.frame);
    else
      content.notice = absenceOf(ofB);
  }
  const bool both = !inA.frame.values.empty() && !inB.frame.values.empty();
  if (both) {
    comparison_->difference(inA.frame, inB.frame, between.frame);
    const DifferenceStatistics whole = comparison_->statistics(inA.frame, inB.frame).back();
    between.caption = "both at rest";
    if (whole.touched > 0)
      between.caption = "mean " + signedText(whole.mean, 1) + " · rms " + figure(whole.rms, 1) +
                        " · largest " + signedText(whole.largest, 0) + " at " +
                        QString::fromStdString(a_->profile.hand().matrixName(whole.matrix)) +
                        ", x " + QString::number(whole.x) + ", y " + QString::number(whole.y);
  } else {
    between.notice = "needs a frame of A and of B";
  }
  bool any = false;
  for (std::size_t m = 0; m < a_->numMatrices(); ++m) any = any || comparison_->compared(m);
  if (!any) {
    between.caption.clear();
    between.notice = "nothing to compare: other matrices";
  }
  view_->setFrames(std::move(frames));
  showLook();
  showNotice();
}

ComparePictureOptions ComparePanel::pictureOptions() const {
  ComparePictureOptions options;
  options.look.map = settings_.map;
  options.look.interpolated = settings_.interpolated;
  options.look.values = settings_.values;
  options.look.theme = theme_;
  options.look.font = font();
  const auto& [inA, inB, between] = view_->frames();
  double& maximum = options.look.rangeMax;
  switch (settings_.range) {
    case RangeMode::kManual:
      options.look.rangeMin = settings_.manualMin;
      maximum = settings_.manualMax;
      options.largestDifference = settings_.manualMax;
      break;
    case RangeMode::kFullScale:
      for (const OpenedRecordingPtr& side : {a_, b_})
        if (side)
          maximum = std::max(maximum, static_cast<double>(side->profile.hand().maximumCounts));
      options.largestDifference = maximum;
      break;
    case RangeMode::kFrame:
      maximum =
          std::max(comparePanelViewLargestOf(inA.frame), comparePanelViewLargestOf(inB.frame));
      options.largestDifference = comparePanelViewLargestOf(between.frame);
      break;
    case RangeMode::kRecording:
      // Of a long recording the largest value isn't known before all of it has been read.
      maximum = std::max({answer_.largestValue,
                          comparePanelViewLargestOf(inA.frame),
                          comparePanelViewLargestOf(inB.frame)});
      for (const OpenedRecordingPtr& side : {a_, b_})
        if (side) maximum = std::max(maximum, side->maximumNow().value_or(0.0));
      options.largestDifference = answer_.largestDifference.value_or(maximum);
      break;
  }
  maximum = std::max(maximum, options.look.rangeMin + kLeastRange);
  options.largestDifference = std::max(options.largestDifference, kLeastRange);
  return options;
}

void ComparePanel::showLook() { view_->setOptions(pictureOptions()); }

QString ComparePanel::notice() const {
  if (!hasPair()) return {};
  if (!answer_.failure.isEmpty()) return answer_.failure;
  QStringList lines;
  if (comparison_ && !comparison_->allCompared()) {
    QStringList others;
    for (std::size_t m = 0; m < a_->numMatrices(); ++m)
      if (!comparison_->compared(m))
        others.append(QString::fromStdString(a_->profile.hand().matrixName(m)));
    const std::size_t inA = a_->numMatrices(), inB = b_->numMatrices();
    if (!others.isEmpty())
      lines.append("Not compared, because they have other rows and columns in B: " +
                   others.join(", "));
    if (inB > inA) lines.append("B has " + QString::number(inB - inA) + " matrices more than A");
  }
  if (!answer_.a || !answer_.b) return lines.join(". ");
  const TimedProfile &inA = *answer_.a, &inB = *answer_.b;
  if (alignment_ == Alignment::kContact && answer_.alignment != Alignment::kContact) {
    QStringList without;
    if (!inA.contact) without.append("A");
    if (!inB.contact && a_ != b_) without.append("B");
    lines.append("No lasting contact (3 taxels in 3 frames) in " + without.join(" and ") +
                 ": aligned by their starts");
  }
  const bool frames = inA.profile.numFrames() > 0 && inB.profile.numFrames() > 0;
  if (frames && !commonSpan(inA, inB, answer_.offsetS)) {
    const double laterS = answer_.offsetS - inA.timing.durationS;
    lines.append(laterS > 0.0
                     ? "Nothing in common: B begins " + durationText(laterS) + " after A ended"
                     : "Nothing in common: B ended " +
                           durationText(-(answer_.offsetS + inB.timing.durationS)) +
                           " before A begins");
  } else if (frames && a_ == b_ && answer_.offsetS == 0.0) {
    lines.append("The same recording twice: drag B's bar to lay another of its grasps on A");
  }
  return lines.join(". ");
}

QString ComparePanel::figures() const {
  if (!answer_.a || !answer_.b || !hasPair()) return {};
  if (!answer_.figures) {
    if (!answer_.complete) return "computing … " + figure(100.0 * answer_.done, 0) + " %";
    return "the other recording has no such matrix";
  }
  const CurveComparison& found = *answer_.figures;
  if (found.samples == 0) return "no common span";
  const QString unit = " " + unitOf(settings_.signal);
  return "correlation " +
         (found.correlation ? figure(*found.correlation, 3) : QString("not defined")) +
         " · A − B: mean " + signedText(found.meanDifference, 1) + ", rms " +
         figure(found.rmsDifference, 1) + ", largest " + signedText(found.largestDifference, 1) +
         unit + " at " + figure(found.largestAtS, 2) + " s · over " +
         figure(found.toS - found.fromS, 2) + " s in common";
}

void ComparePanel::showNotice() {
  const QString text = notice();
  notice_->setVisible(!text.isEmpty());
  if (notice_->text() != text) notice_->setText(text);
  const ThemeColors& colors = colorsOf(theme_);
  const QString style =
      "color: " + colors.warning.name() + "; background: " + colors.panel.name() + ";";
  if (notice_->styleSheet() != style) notice_->setStyleSheet(style);
  const QString line = figures();
  if (figures_->text() != line) figures_->setText(line);
  figures_->setToolTip(line);
}

void ComparePanel::paint(QPainter& painter, const PictureLook& look) const {
  if (!view_->hands()) return;
  ComparePictureOptions options = pictureOptions();
  if (look.forPrint) options.look.theme = Theme::kLight;
  if (look.textUnits > 0) options.look.font.setPixelSize(look.textUnits);
  options.look.pixelRatio = look.pixelRatio;
  const double split = std::floor(look.size.height() * kHeatMapShare);
  paintComparison(
      painter, QRectF(0, 0, look.size.width(), split), *view_->hands(), view_->frames(), options);
  PictureLook below = look;
  below.size.setHeight(look.size.height() - split);
  below.titled = false;
  painter.save();
  painter.translate(0.0, split);
  paintChart(painter,
             below,
             *chart_,
             {.legend = {{"A  " + fileNameOf(*a_), chart_->graph(0)->pen()},
                         {"B  " + fileNameOf(*b_), chart_->graph(1)->pen()}}});
  painter.restore();
}

TextTable ComparePanel::differenceTable() const {
  const auto& [inA, inB, between] = view_->frames();
  std::vector<std::string> names;
  std::vector<DifferenceStatistics> rows;
  if (comparison_ && !between.frame.values.empty()) {
    rows = comparison_->statistics(inA.frame, inB.frame);
    for (std::size_t m = 0; m + 1 < rows.size(); ++m)
      names.push_back(a_->profile.hand().matrixName(m));
    names.emplace_back("all");
  }
  const std::size_t numRows = rows.size();
  return {.header = {"matrix",
                     "touched",
                     "difference_mean [counts]",
                     "difference_rms [counts]",
                     "difference_largest [counts]",
                     "y",
                     "x"},
          .numRows = numRows,
          .row = [rows = std::move(rows), names = std::move(names)](std::size_t i) {
            const DifferenceStatistics& row = rows[i];
            const bool any = row.touched > 0;
            return std::vector<std::string>{names[i],
                                            std::to_string(row.touched),
                                            numberText(row.mean),
                                            numberText(row.rms),
                                            numberText(row.largest),
                                            any ? std::to_string(row.y) : std::string(),
                                            any ? std::to_string(row.x) : std::string()};
          }};
}

// A row per frame of A; B where it has one beside it.
TextTable ComparePanel::curveTable() const {
  TextTable table{.header = {"time_s", "frame_a", "a", "frame_b", "b"}};
  if (!answer_.curveA || !answer_.a || !answer_.b) return table;
  const std::string unit = " " + gui::nameOf(settings_.signal).toStdString() + " [" +
                           unitOf(settings_.signal).toStdString() + "]";
  table.header[2] += unit;
  table.header[4] += unit;
  table.numRows = answer_.curveA->timeS.size();
  table.row = [answer = answer_](std::size_t i) {
    const double at = answer.curveA->timeS[i];
    std::vector<std::string> cells = {
        numberText(at), std::to_string(i), numberText(answer.curveA->values[i])};
    const auto beside = answer.b->frameAt(at - answer.offsetS);
    cells.push_back(beside ? std::to_string(*beside) : std::string());
    cells.push_back(beside && answer.curveB && *beside < answer.curveB->values.size()
                        ? numberText(answer.curveB->values[*beside])
                        : std::string());
    return cells;
  };
  return table;
}

}  // namespace palpate::gui
