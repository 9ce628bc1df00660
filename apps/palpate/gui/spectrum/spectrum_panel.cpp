#include "gui/spectrum/spectrum_panel.h"

#include <QStackedWidget>
#include <algorithm>
#include <limits>

#include <palpate/core/number_text.h>
#include <palpate/signals/signal_name.h>

#include "gui/appearance/settings_table.h"
#include "gui/chart/plotted_curve.h"
#include "gui/spectrum/spectrum_line_page.h"
#include "gui/widgets/empty_page.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/make.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

// [ms] time without changes before a long recording is computed again
constexpr int kSpectrumPanelCalmMs = 120;

void settingFields(SettingsTable& table, SpectrumSetting& setting) {
  using Any = std::numeric_limits<int>;  // the header brings them into their ranges
  table.number("spectrum/window", setting.window, Any::min(), Any::max());
  table.number("spectrum/overlap", setting.overlap, Any::min(), Any::max());
  table.choice("spectrum/scale", setting.scale, kAllSpectrumScales);
  table.choice("spectrum/view", setting.view, kAllSpectrumViews);
  table.flag("spectrum/sender_clock", setting.fitsTimes);
}

bool sameWork(const SpectrumQuestion& a, const SpectrumQuestion& b) {
  const SpectrumOptions &one = a.options.spectrum, &other = b.options.spectrum;
  if (a.recording != b.recording || a.taxels != b.taxels || one.window != other.window ||
      one.overlap != other.overlap || a.work != b.work || a.formula != b.formula ||
      a.times != b.times)
    return false;
  if (b.work != SpectrumWork::kOverTime)
    return a.span == b.span && (b.work == SpectrumWork::kMean || a.other == b.other);
  return fitsWhole(b) || (a.fromS == b.fromS && a.toS == b.toS);
}

// As `palpate spectrum` prints it.
TextTable segmentTable(const SpectrumAnswer& answer) {
  const auto spectrogram = answer.spectrogram;
  return {.header = {"segment", "time_s", "frequency_hz", "psd", "magnitude"},
          .numRows = spectrogram->report.segments * spectrogram->numBins,
          .row = [spectrogram](std::size_t row) {
            const std::size_t segment = row / spectrogram->numBins,
                              bin = row % spectrogram->numBins;
            std::size_t before = 0;
            const SpectrogramPart* part = spectrogram->parts.data();
            for (; segment - before >= part->segments; ++part) before += part->segments;
            const std::size_t index = segment - before;
            const std::size_t cell = index * spectrogram->numBins + bin;
            return std::vector<std::string>{
                std::to_string(segment),
                numberText(part->firstS + static_cast<double>(index) * part->stepS),
                numberText(static_cast<double>(bin) * part->binHz),
                numberText(part->psd[cell]),
                numberText(part->magnitude[cell])};
          }};
}

TextTable meanTable(const SpectrumAnswer& answer) {
  const std::string unit = answer.unit.toStdString();
  return {.header = {"frequency_hz", "psd [" + unit + "^2/Hz]", "magnitude [" + unit + "]"},
          .numRows = answer.spectrogram->mean.psd.size(),
          .row = [mean = answer.spectrogram->mean](std::size_t row) {
            return std::vector<std::string>{numberText(static_cast<double>(row) * mean.binHz),
                                            numberText(mean.psd[row]),
                                            numberText(mean.magnitude[row])};
          }};
}

}  // namespace

SpectrumPanel::SpectrumPanel(QSettings& settings, QWidget* parent)
    : QWidget(parent), settings_(settings) {
  setObjectName("SpectrumPanel");
  header_ = new SpectrumHeader(this);
  header_->setSetting(loadFields<SpectrumSetting>(settings, settingFields));
  strip_ = new OpeningStrip(this, "Computing", "spectrum");
  pages_ = new FittingPages(this);
  empty_ = new EmptyPage("spectrum", pages_);
  chart_ = new SpectrumChart(pages_);
  chart_->setScale(header_->setting().scale);
  pages_->addWidget(empty_);
  linePage_ = new SpectrumLinePage(pages_);
  linePage_->chart().setScale(header_->setting().scale);
  pages_->addWidget(chart_);
  pages_->addWidget(linePage_);
  setLayout(inColumn({strip_, {pages_, 1}}, Space::kNone));
  later_.setSingleShot(true);
  later_.setInterval(kSpectrumPanelCalmMs);
  connect(&later_, &QTimer::timeout, this, &SpectrumPanel::ask);
  connect(header_, &SpectrumHeader::changed, this, [this] {
    const SpectrumSetting& setting = header_->setting();
    saveFields(settings_, setting, settingFields);
    chart_->setScale(setting.scale);
    linePage_->chart().setScale(setting.scale);
    ask();
  });
  connect(linePage_, &SpectrumLinePage::otherChanged, this, &SpectrumPanel::ask);
  connect(&worker_, &SpectrumWorker::started, strip_, [this] { strip_->begin("spectra"); });
  connect(&worker_, &SpectrumWorker::progressed, strip_, &OpeningStrip::setProgress);
  connect(&worker_, &SpectrumWorker::finished, strip_, &OpeningStrip::end);
  connect(&worker_, &SpectrumWorker::answered, this, &SpectrumPanel::take);
  connect(strip_, &OpeningStrip::cancelRequested, this, &SpectrumPanel::cancel);
  connect(empty_, &EmptyPage::buttonClicked, this, [this] {
    asked_.reset();
    ask();
  });
  setSource(nullptr, false);
}

void SpectrumPanel::setSource(const OpenedRecordingPtr& recording, bool live) {
  const OpenedRecordingPtr source = live ? nullptr : recording;
  if (source == recording_ && live == live_ && recording_) return;
  recording_ = source;
  live_ = live;
  taxels_ = {};
  asked_.reset();
  worker_.abandon();
  name_.clear();
  linePage_->setRecording(recording_);
  listSignals();
  header_->setName({});
  if (live)
    say("Spectra need a recording. Record the connected hand (Ctrl+R), and open the recording.");
  else if (!recording_)
    say("Open a recording to see the spectra of its taxels.");
  else if (recording_->profile.numFrames() == 0)
    say("This recording has no frames.");
  else
    say("");
  ask();
}

void SpectrumPanel::setTaxels(const TaxelSelection& taxels) {
  taxels_ = taxels;
  linePage_->setTaxels(taxels);
  ask();
}

void SpectrumPanel::setFormulas(const std::vector<FormulaCurve>& formulas) {
  formulas_ = formulas;
  listSignals();
  linePage_->setFormulas(formulas_);
  ask();
}

// A column is the formula of its name, which the worker reads at the times of its series. A name
// that means something else, or that a formula has, is left out.
void SpectrumPanel::listSignals() {
  signals_ = formulas_;
  if (recording_)
    for (const SeriesDescription& series : furtherSeriesOf(recording_->profile))
      for (std::size_t i = 0; i < series.columns.size(); ++i) {
        const PlottedCurve column = columnCurve(series, i, 0);
        const std::string name = palpate::nameOf(column.choice, recording_->profile.layout());
        const bool isTaken =
            std::ranges::find(signals_, column.name, &FormulaCurve::name) != signals_.end();
        if (!isTaken && signalNamed(name, recording_->profile) == column.choice)
          signals_.push_back({column.name, QString::fromStdString(name), column.unit});
      }
  QStringList names;
  for (const FormulaCurve& each : signals_) names.append(each.name);
  header_->setFormulas(names);
}

void SpectrumPanel::setVisibleRange(double fromS, double toS) {
  if (fromS == fromS_ && toS == toS_) return;
  fromS_ = fromS;
  toS_ = toS;
  chart_->setVisibleRange(fromS, toS);
  if (recording_ && isVisible()) later_.start();
}

void SpectrumPanel::setSpan(const std::optional<TimeSpan>& span) {
  if (span == span_) return;
  span_ = span;
  if (recording_ && isVisible()) later_.start();
}

TimeSpan SpectrumPanel::lineSpan() const { return span_.value_or(TimeSpan{fromS_, toS_}); }

void SpectrumPanel::setPosition(double seconds) { chart_->setPosition(seconds); }

void SpectrumPanel::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  if (pages_->currentWidget() == linePage_)
    linePage_->chart().paint(painter, look, title, name_);
  else
    chart_->paint(painter, look, title, name_);
}

QSizeF SpectrumPanel::chartSize() const {
  return pages_->currentWidget() == linePage_ ? linePage_->chart().size() : chart_->size();
}

void SpectrumPanel::ask() {
  later_.stop();
  if (!recording_ || recording_->profile.numFrames() == 0 || !isVisible()) return;
  SpectrumQuestion question{.recording = recording_, .fromS = fromS_, .toS = toS_};
  // Taxels of another sensor were chosen before this recording was opened, and are ignored.
  if (TaxelSelection(recording_->profile.layout()).sameSensor(taxels_)) question.taxels = taxels_;
  for (const FormulaCurve& each : signals_)
    if (each.name == header_->formula()) question.formula = each;
  question.options.spectrum.window = header_->setting().window;
  question.options.spectrum.overlap = header_->setting().overlap;
  if (header_->setting().fitsTimes) question.times = TimeChoice::kFitted;
  const SpectrumView view = header_->setting().view;
  if (view != SpectrumView::kMap) {
    question.work = view == SpectrumView::kLine ? SpectrumWork::kMean : SpectrumWork::kCoherence;
    question.span = lineSpan();
    question.other = linePage_->other();
  }
  linePage_->setChoosing(view == SpectrumView::kCoherence);
  if (asked_ && sameWork(*asked_, question)) return;
  asked_ = question;
  worker_.ask(question);
}

bool SpectrumPanel::cancel() {
  if (!worker_.busy()) return false;
  worker_.abandon();
  say("Cancelled.", "Compute the spectra");
  emit said("computing spectra was cancelled");
  return true;
}

QString SpectrumPanel::nameOf(const SpectrumAnswer& answer) const {
  const std::size_t count = answer.taxels.count();
  if (count > 1) return "mean of " + QString::number(count) + " taxels";
  const HandDescription& hand = recording_->profile.hand();
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m) {
    const MatrixLayout& matrix = hand.layout->matrix(m);
    for (int y = 0; y < matrix.rows; ++y)
      for (int x = 0; x < matrix.columns; ++x)
        if (answer.taxels.contains(m, y, x))
          return QString::fromStdString(hand.matrixName(m)) + " · x " + QString::number(x) +
                 ", y " + QString::number(y);
  }
  return {};
}

void SpectrumPanel::take(const SpectrumAnswer& answer) {
  header_->setClock(answer.clock);
  if (!answer.failure.isEmpty()) return say(answer.failure, "Try again");
  if (!answer.formula.isEmpty() && !answer.series) {
    header_->setName({});
    return say("\"" + answer.formula + "\" can't be computed of this recording.");
  }
  if (answer.formula.isEmpty() && (answer.taxels.empty() || !answer.series)) {
    header_->setName({});
    return say(
        "No taxel of this recording is active. Choose one in the matrices: click or "
        "drag.");
  }
  name_ = answer.formula.isEmpty() ? nameOf(answer) : answer.formula;
  header_->setName(answer.strongest ? name_ + "   (the strongest; choose others in the matrices)"
                                    : name_);
  if (answer.work != SpectrumWork::kOverTime) return takeLine(answer);
  if (answer.spectrogram->parts.empty()) {
    std::size_t longest = 0;
    for (const GapFreeSpan& stretch : answer.spectrogram->report.stretches)
      longest = std::max(longest, stretch.gridSamples);
    return say("Too short: " +
               QString(answer.whole ? "the longest span without a gap" : "the visible part") +
               " without a gap has " + QString::number(longest) + " samples, but a window needs " +
               QString::number(answer.options.window) + ".\nMake the window smaller" +
               (answer.whole ? "." : ", or zoom out."));
  }
  chart_->setAnswer(answer);
  chart_->setVisibleRange(fromS_, toS_);
  pages_->setCurrentWidget(chart_);
}

void SpectrumPanel::takeLine(const SpectrumAnswer& answer) {
  const QString range = (span_ ? "selected " : "visible ") +
                        QString::number(answer.span.fromS, 'f', 2) + " to " +
                        QString::number(answer.span.toS, 'f', 2) + " s";
  const bool two = answer.work == SpectrumWork::kCoherence;
  const SpectrumReport& report = two ? answer.coherence->report : answer.mean->report;
  if (two ? answer.coherence->coherence.empty() : answer.mean->mean.psd.empty()) {
    std::size_t longest = 0;
    for (const GapFreeSpan& stretch : report.stretches)
      longest = std::max(longest, stretch.gridSamples);
    return say(QString("Too short: the ") + (span_ ? "selected range" : "visible part") +
               " without a gap has " + QString::number(longest) + " samples, but a window needs " +
               QString::number(answer.options.window) +
               (two ? " and coherence needs two windows" : "") +
               ".\nMake the window smaller, or the range longer.");
  }
  if (two) name_ += " with " + linePage_->otherName();
  header_->setName(name_ + " · " + range);
  linePage_->setAnswer(answer);
  pages_->setCurrentWidget(linePage_);
}

void SpectrumPanel::say(const QString& text, const QString& button) {
  empty_->say(text, button);
  pages_->setCurrentWidget(empty_);
}

QString SpectrumPanel::emptyText() const {
  return pages_->currentWidget() == empty_ ? empty_->text() : QString();
}

bool SpectrumPanel::shown() const { return isVisible() && pages_->currentWidget() != empty_; }

void SpectrumPanel::settle() {
  ask();
  worker_.settle();
}

std::vector<ExportedTable> SpectrumPanel::tables() const {
  std::vector<ExportedTable> tables;
  if (pages_->currentWidget() == linePage_) return linePage_->tables();
  if (pages_->currentWidget() != chart_) return tables;
  tables.push_back({"spectra", [answer = chart_->answer()] { return segmentTable(answer); }});
  tables.push_back({"mean spectrum", [answer = chart_->answer()] { return meanTable(answer); }});
  return tables;
}

void SpectrumPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ask();
}

}  // namespace palpate::gui
