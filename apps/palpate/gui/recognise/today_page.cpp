#include "gui/recognise/today_page.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QStringList>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/core/time.h>

#include "gui/appearance/captions.h"
#include "gui/desktop/ask.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"

namespace palpate::gui {
namespace {

constexpr double kFarthestMm = 20.0;
using TodayPageKind = OffsetChoice::Kind;
constexpr std::array kKinds = {
    TodayPageKind::kModel, TodayPageKind::kNone, TodayPageKind::kBatch, TodayPageKind::kGiven};

std::vector<FigureColumn> todayPageColumns() {
  return {{"time", "UTC", 8, true},
          {"recognised as", {}, 14, true},
          {"p", {}, 5},
          {"label", "What it is, as you labelled it", 14, true}};
}

}  // namespace

TodayPage::TodayPage(RecognitionController& controller, Ask& ask, QWidget* parent)
    : QWidget(parent), controller_(controller) {
  setObjectName("todayPage");
  offset_ = makeLines(this, "todayOffset");
  unsure_ = makeLines(this, "todayUnsure", "muted");
  source_ = named(new QComboBox(this), "todaySource", {}, "Where the offset comes from");
  source_->setToolTip(
      "Labelled grasps and the zero of the empty hand come first, except before a typed offset");
  source_->addItems(
      {"as the model says", "nothing is assumed", "from today's grasps, without labels", "typed"});
  typed_ = named(new SecondsField(this), "todayTyped");
  typed_->setRange(-kFarthestMm, kFarthestMm);
  typed_->setDecimals(1);
  typed_->setSuffix(" mm");
  zero_ = makeButton(this, "todayZero", "Zero: close the empty hand");
  aboutZero_ = makeLines(this, "todayAboutZero", "muted");
  grasps_ = named(new FiguresTable(todayPageColumns(), this), "todayGrasps");
  grasps_->setSingleLine();
  forget_ = makeButton(this, "todayForget", "Forget today");
  save_ = makeButton(this, "todaySave", "Save as today's model…");
  setLayout(inColumn({offset_,
                      unsure_,
                      inRow({{source_, 1}, typed_}),
                      zero_,
                      aboutZero_,
                      {grasps_, 1},
                      inRow({Stretch{}, forget_, save_})},
                     kPageEdges));
  connect(source_, &QComboBox::activated, this, &TodayPage::choose);
  connect(typed_, &QDoubleSpinBox::valueChanged, this, &TodayPage::choose);
  connect(zero_, &QPushButton::clicked, this, &TodayPage::zeroRequested);
  connect(forget_, &QPushButton::clicked, this, [this] {
    controller_.changeSession([](RecognitionSession& session) { session.reset(); });
  });
  connect(save_, &QPushButton::clicked, this, [this, &ask] {
    const auto& from = controller_.modelPath();
    const std::filesystem::path path =
        ask.newFile("Save today's model",
                    QString::fromStdString(
                        (from.parent_path() / (from.stem().string() + "_today.json")).string()),
                    "Models (*.json)",
                    ".json")
            .toStdString();
    if (path.empty()) return;
    try {
      // The dialog has asked before it replaces a file.
      saveModel(controller_.session()->adapted(), path, Overwrite::kReplace);
      emit controller_.said("saved " + QString::fromStdString(path.filename().string()));
    } catch (const Error& error) {
      emit controller_.said(error.what());
    }
  });
  connect(&controller_, &RecognitionController::sessionChanged, this, &TodayPage::showDay);
  showDay();
}

void TodayPage::choose() {
  const TodayPageKind kind = kKinds[static_cast<std::size_t>(source_->currentIndex())];
  typed_->setEnabled(kind == TodayPageKind::kGiven);
  controller_.changeSession([&](RecognitionSession& session) {
    session.choose({kind, typed_->value()});
  });
}

void TodayPage::setZeroPossible(const QString& why, bool closing) {
  if (why == why_ && closing == closing_) return;
  why_ = why;
  closing_ = closing;
  showDay();
}

void TodayPage::setMeasuredZero(std::optional<EmptyHandZero> zero) {
  measured_ = std::move(zero);
  showAboutZero();
}

void TodayPage::showAboutZero() {
  const RecognitionSession* session = controller_.session();
  QStringList lines;
  if (measured_)
    lines.append("The empty hand reads " + figure(measured_->mm, 1) + " ± " +
                 figure(measured_->sdMm, 1) + " mm.");
  if (session && session->model().adaptsToSession() && !session->model().trainingZero)
    lines.append(
        "This model holds no zero of the empty hand to compare with: measuring one does not change "
        "its offset. The next training takes it into its model.");
  aboutZero_->setText(lines.join(' '));
  aboutZero_->setVisible(!lines.isEmpty());
}

void TodayPage::showDay() {
  showAboutZero();
  RecognitionSession* session = controller_.session();
  const bool can = session && session->model().adaptsToSession();
  for (QWidget* each : std::initializer_list<QWidget*>{source_, typed_, forget_, save_})
    each->setEnabled(can);
  zero_->setEnabled(can && why_.isEmpty() && !closing_);
  zero_->setText(closing_ ? "Closing until the pads touch …" : "Zero: close the empty hand");
  zero_->setToolTip(why_.isEmpty() ? "Close slowly until the pads touch, and open again (Esc stops)"
                                   : why_);
  if (!session) {
    offset_->setText("No model is chosen.");
    unsure_->clear();
    return grasps_->setRows({});
  }
  if (!can) {
    offset_->setText(
        "This model has no session offset: it is valid only in the session it was trained in.");
    unsure_->clear();
  } else {
    QString text = offsetText(session->offset(), false);
    text[0] = text[0].toUpper();
    offset_->setText(text + ".");
    QString unsure = QString::fromStdString(session->unsure());
    if (!unsure.isEmpty()) unsure[0] = unsure[0].toUpper();
    unsure_->setText(unsure);
    unsure_->setVisible(!unsure.isEmpty());
    const QSignalBlocker first(source_), second(typed_);
    for (std::size_t i = 0; i < kKinds.size(); ++i)
      if (kKinds[i] == session->choice().kind) source_->setCurrentIndex(static_cast<int>(i));
    typed_->setEnabled(session->choice().kind == TodayPageKind::kGiven);
    if (session->choice().kind == TodayPageKind::kGiven) typed_->setValue(session->choice().mm);
  }
  std::vector<std::vector<FigureCell>> rows;
  const auto& grasps = session->grasps();
  for (auto grasp = grasps.rbegin(); grasp != grasps.rend(); ++grasp) {
    const RecognitionAnswer answer =
        answerOf(session->model(), session->predict(grasp->values, grasp->timeUs));
    rows.push_back(
        {{.text = QString::fromStdString(utcText(grasp->timeUs)).mid(11, 8)},
         {.text = answer.known ? answer.name() : answer.confidenceWord(),
          .tip = answer.accessibleText(),
          .warning = !answer.sure},
         {.text = answer.known ? probabilityText(answer.best.front().p) : QString("–")},
         {.text =
              grasp->labelledClass
                  ? QString::fromStdString(
                        session->model().classes[static_cast<std::size_t>(*grasp->labelledClass)])
                  : QString("–")}});
  }
  grasps_->setRows(rows);
}

}  // namespace palpate::gui
