#include "gui/recognise/check_page.h"

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QSplitter>
#include <QStackedWidget>
#include <algorithm>

#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/recognise/confusion_view.h"
#include "gui/widgets/empty_page.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/keep_keys.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

std::vector<FigureColumn> checkPageObjectColumns() {
  return {{"object", {}, 14, true},
          {"precision", "Fraction of answers with this name that are right", 9},
          {"recall", "Fraction of grasps of this object that are found", 7},
          {"F", "Harmonic mean of both", 6},
          {"grasps", "Number of tested grasps", 7}};
}

std::vector<FigureColumn> graspColumns() {
  return {{"recording", {}, 16, true},
          {"frames", {}, 11},
          {"called", {}, 12, true},
          {"p", "Probability of the answer", 6, true}};
}

QString name(const std::vector<std::string>& classes, int index) {
  return QString::fromStdString(classes[static_cast<std::size_t>(index)]);
}

TextTable confusionTable(const std::shared_ptr<const TrainingValidation>& check) {
  const auto& classes = check->samples.classes;
  TextTable table{.header = {"was"}, .numRows = classes.size(), .row = {}};
  table.header.insert(table.header.end(), classes.begin(), classes.end());
  table.row = [check](std::size_t row) {
    const auto& names = check->samples.classes;
    std::vector<std::string> cells{names[row]};
    for (std::size_t x = 0; x < names.size(); ++x)
      cells.push_back(
          std::to_string(check->report->confusion.at(static_cast<int>(row), static_cast<int>(x))));
    return cells;
  };
  return table;
}

TextTable figureTable(const std::shared_ptr<const TrainingValidation>& check) {
  const auto classMetrics = check->report->confusion.classMetrics();
  return {.header = {"object", "precision", "recall", "f", "support"},
          .numRows = classMetrics.size(),
          .row = [classMetrics](std::size_t row) {
            const ClassMetrics& one = classMetrics[row];
            return std::vector<std::string>{one.name,
                                            numberText(one.precision),
                                            numberText(one.recall),
                                            numberText(one.f),
                                            std::to_string(one.support)};
          }};
}

}  // namespace

CheckPage::CheckPage(TrainingController& controller, QWidget* parent)
    : QWidget(parent), controller_(controller) {
  setObjectName("checkPage");
  protocol_ = named(new QComboBox(this), "checkProtocol", {}, "Protocol");
  protocol_->setToolTip(
      "How test grasps are chosen. Neither choice shows the accuracy in another session.");
  protocol_->addItems({"five blocks in time (B)", "ten shuffles (S)"});
  check_ = makePrimary(this, "checkNow", "Check");
  result_ = makeLines(this, "checkResult");
  auto* content = new QWidget(this);
  confusion_ = named(new ConfusionView(content), "confusion");
  caption_ = makeLines(content, "checkCaption", "muted");
  back_ = makeButton(content, "checkBack", "All objects");
  lists_ = new QStackedWidget(content);
  objects_ =
      named(new FiguresTable(checkPageObjectColumns(), lists_), "checkObjects", {}, "Objects");
  objects_->setSingleLine();
  grasps_ = named(new FiguresTable(graspColumns(), lists_), "checkGrasps", {}, "Grasps");
  grasps_->setSingleLine();
  lists_->addWidget(objects_);
  lists_->addWidget(grasps_);
  empty_ = new EmptyPage("check", this);
  pages_ = new QStackedWidget(this);
  pages_->addWidget(empty_);
  pages_->addWidget(content);

  auto* top = inRow({{protocol_, 1}, check_});
  auto* below = makeBox(
      inColumn({inRow({{caption_, 1}, back_}), {lists_, 1}}, {.top = Space::kNarrow}), content);
  // The border between the matrix and the lists can be dragged.
  auto* parts = named(new QSplitter(Qt::Vertical, content), "checkParts");
  parts->setChildrenCollapsible(false);
  parts->addWidget(confusion_);
  parts->addWidget(below);
  parts->setStretchFactor(0, 3);
  parts->setStretchFactor(1, 2);
  content->setLayout(inColumn({parts}));
  setLayout(inColumn({top, result_, {pages_, 1}}, kPageEdges));

  connect(check_, &QPushButton::clicked, this, [this] {
    controller_.check(protocol_->currentIndex() == 0);
  });
  connect(&controller_, &TrainingController::checkedChanged, this, &CheckPage::showCheck);
  connect(&controller_, &TrainingController::folderChanged, this, &CheckPage::showCheck);
  connect(&controller_.job(), &BackgroundJob::started, this, [this] { check_->setEnabled(false); });
  connect(&controller_.job(), &BackgroundJob::finished, this, [this] {
    check_->setEnabled(!controller_.folder().empty());
  });
  connect(confusion_, &ConfusionView::cellChosen, this, &CheckPage::listCell);
  // If the cell has only one grasp, a click opens it.
  connect(confusion_, &ConfusionView::cellClicked, this, [this] {
    if (listed_.size() == 1) openGrasp(0);
  });
  connect(confusion_, &ConfusionView::cellOpened, this, [this](int truth, int called) {
    listCell(truth, called);
    openGrasp(0);
  });
  keepKeys(*confusion_, QKeySequence::Copy, [this] {
    const TextTable table = confusionTable(controller_.checked());
    QApplication::clipboard()->setText(QString::fromStdString(tabbedText(table, table.numRows)));
  });
  connect(back_, &QPushButton::clicked, this, [this] {
    confusion_->choose(std::nullopt);
    listObjects();
  });
  connect(grasps_, &QTableWidget::cellClicked, this, [this](int row, int) {
    openGrasp(static_cast<std::size_t>(row));
  });
  showCheck();
}

void CheckPage::openGrasp(std::size_t row) {
  if (row >= listed_.size()) return;
  const FeatureRow& grasp = controller_.checked()->table->rows.at(listed_[row]);
  emit graspAsked(grasp.file, grasp.begin, grasp.end);
}

bool CheckPage::shown() const { return isVisible() && pages_->currentWidget() != empty_; }

void CheckPage::showCheck() {
  const auto& checked = controller_.checked();
  check_->setEnabled(!controller_.folder().empty() && !controller_.busy());
  if (!checked) {
    result_->clear();
    result_->hide();
    empty_->say(
        controller_.folder().empty()
            ? "Choose a folder of grasps on the page Teach: they are tested here."
            : "Check shows how well the objects of the folder are distinguished. Each grasp "
              "is tested with a model trained without it.");
    pages_->setCurrentWidget(empty_);
    return;
  }
  if (confusion_->matrix() && pages_->currentWidget() != empty_ && sender() == &controller_ &&
      confusion_->matrix()->total() == checked->report->confusion.total() && confusion_->chosen())
    return;
  const ValidationReport& report = *checked->report;
  const auto wrong = report.confusion.total() - report.confusion.right();
  result_->setText("right " + figure(100.0 * report.accuracyMean, 1) + " ± " +
                   figure(100.0 * report.accuracySd, 1) + " % (mean and deviation of " +
                   QString::number(report.accuracies.size()) +
                   (checked->blocks ? " blocks" : " shuffles") + "), among the best three " +
                   figure(100.0 * report.top3, 1) + " %: " + QString::number(wrong) + " of " +
                   QString::number(report.confusion.total()) + " answers wrong; with " +
                   QString::fromStdString(madeWithText(checked->table->set, checked->options)));
  result_->setToolTip(
      "What Teach leaves open (components, C) is chosen on the same grasps, so the result is "
      "slightly too good");
  result_->show();
  confusion_->setMatrix(report.confusion);
  listObjects();
  pages_->setCurrentIndex(1);
}

void CheckPage::listObjects() {
  std::vector<std::vector<FigureCell>> rows;
  for (const ClassMetrics& one : controller_.checked()->report->confusion.classMetrics())
    rows.push_back({{.text = QString::fromStdString(one.name)},
                    {.text = figure(one.precision, 2)},
                    {.text = figure(one.recall, 2), .warning = one.recall < 0.9},
                    {.text = figure(one.f, 2)},
                    {.text = QString::number(one.support)}});
  objects_->setRows(rows);
  caption_->setText(
      "A click on a cell lists its grasps, a double click opens the first. Ctrl and wheel: "
      "larger, smaller.");
  back_->hide();
  listed_.clear();
  lists_->setCurrentWidget(objects_);
}

void CheckPage::listCell(int truth, int called) {
  const TrainingValidation& check = *controller_.checked();
  listed_.clear();
  std::vector<std::vector<FigureCell>> rows;
  for (const TestPrediction& one : check.report->testPredictions) {
    if (check.samples.y[one.sample] != truth || one.called != called) continue;
    if (std::find(listed_.begin(), listed_.end(), one.sample) != listed_.end()) continue;
    listed_.push_back(one.sample);
    const FeatureRow& row = check.table->rows[one.sample];
    rows.push_back(
        {{.text = QString::fromStdString(row.file.filename().string()),
          .tip = QString::fromStdString(row.file.string())},
         {.text = QString::number(row.begin) + "–" + QString::number(row.end)},
         {.text = name(check.samples.classes, one.called), .warning = one.called != truth},
         {.text = figure(one.confidence, 2)}});
  }
  grasps_->setRows(rows);
  grasps_->clearSelection();
  const QString was = name(check.samples.classes, truth);
  caption_->setText(listed_.empty()
                        ? "No " + was + " was called " + name(check.samples.classes, called) + "."
                    : truth == called ? was + ", named correctly. A click on a grasp opens it."
                                      : was + ", called " + name(check.samples.classes, called) +
                                            ". A click on a grasp opens it.");
  back_->show();
  lists_->setCurrentWidget(grasps_);
}

std::vector<ExportedTable> CheckPage::tables() const {
  if (!shown()) return {};
  const auto check = controller_.checked();
  return {{"confusion", [check] { return confusionTable(check); }},
          {"objects", [check] { return figureTable(check); }}};
}

void CheckPage::paint(QPainter& painter, const PictureLook& look) {
  const Theme theme = look.forPrint ? Theme::kLight : shownTheme();
  const QRectF area(QPointF(0, 0), look.size);
  painter.fillRect(area, colorsOf(theme).window);
  QFont plain = font();
  if (look.textUnits > 0) plain.setPixelSize(look.textUnits);
  painter.setFont(plain);
  painter.setPen(colorsOf(theme).text);
  const QRectF room(16, 8, area.width() - 32, area.height() / 2);
  const int wrapped = Qt::AlignTop | Qt::TextWordWrap;
  const double text = painter.boundingRect(room, wrapped, result_->text()).height();
  const double line = text + 0.6 * QFontMetricsF(plain).height();
  painter.drawText(room, wrapped, result_->text());
  paintConfusion(painter,
                 QRectF(16, 12 + line, area.width() - 32, area.height() - line - 28),
                 controller_.checked()->report->confusion,
                 theme);
}

}  // namespace palpate::gui
