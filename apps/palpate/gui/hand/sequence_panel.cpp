#include "gui/hand/sequence_panel.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/core/output_file.h>
#include <palpate/core/text_file.h>

#include "gui/desktop/ask.h"
#include "gui/hand/motion_button.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"
#include "gui/widgets/status_lines.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

using StepKind = SequenceStep::Kind;

constexpr const char* kStoredSequence = "sequence/last";
constexpr const char* kSequenceFilter = "Sequences (*.json)";
constexpr std::uint64_t kLargestSequenceFile = 10'000'000;
constexpr int kSequenceLines = 6;

}  // namespace

SequencePanel::SequencePanel(QSettings& settings, Ask& ask, QWidget* parent)
    : QWidget(parent), settings_(settings), ask_(ask) {
  graspRequest = [](GraspMode) { return GraspRequest{}; };
  poses = [] { return std::vector<SavedPose>(); };
  poseVelocity = [] { return GraspRequest{}.velocityDegPerS; };
  sequence_.hand = movableHand().name;
  steps_ = named(new QListWidget(this), "sequenceSteps", {}, "Steps of the sequence");
  fitToText(*steps_, [steps = steps_] {
    steps->setFixedHeight(kSequenceLines * (steps->fontMetrics().lineSpacing() + 6) + 8);
  });
  steps_->setTextElideMode(Qt::ElideRight);
  makeButtons();
  const QString stored = settings.value(kStoredSequence).toString();
  if (!stored.isEmpty()) try {
      sequence_ = parseSequence(stored.toStdString(), "settings");
    } catch (const Error&) {
      // A table that can't be read any more is left out.
    }
  times_->setValue(sequence_.repetitions);
  list(0);
  refresh({});
}

void SequencePanel::makeButtons() {
  add_ = motionButton(
      "Add", "addStep", "Add a step with the values of the pages Grasp and Joints", false, this);
  addMenu_ = new QMenu(add_);
  connect(addMenu_, &QMenu::aboutToShow, this, &SequencePanel::fillAddMenu);
  add_->setMenu(addMenu_);
  seconds_ = named(new SecondsField(this),
                   "stepSeconds",
                   "Seconds of the next step that holds or waits",
                   "Seconds of a step that holds or waits");
  seconds_->setDecimals(1);
  seconds_->setRange(0.0, 86'400.0);
  seconds_->setValue(2.0);
  seconds_->setFocusPolicy(Qt::StrongFocus);
  remove_ = motionButton("Remove", "removeStep", "Remove the chosen step", false, this);
  up_ = motionButton("Up", "stepUp", "Move the chosen step earlier", false, this);
  down_ = motionButton("Down", "stepDown", "Move the chosen step later", false, this);
  times_ =
      named(new QSpinBox(this), "sequenceTimes", "Number of times the table is run", "Repetitions");
  times_->setRange(1, MotionSequence::kMaxRepetitions);
  times_->setFocusPolicy(Qt::StrongFocus);
  start_ = motionButton("Start", "startSequence", {}, true, this);
  file_ =
      motionButton("File", "sequenceFile", "Open the table from a file, or save it", false, this);
  auto* menu = new QMenu(file_);
  menu->addAction("Open…", this, &SequencePanel::openFile)->setObjectName("openSequence");
  menu->addAction("Save…", this, &SequencePanel::saveFile)->setObjectName("saveSequence");
  file_->setMenu(menu);
  state_ = new StatusLines(3, "sequenceState", this);
  state_->label().setProperty("role", "muted");
  // What is left of the height is below: no button moves when another page is higher.
  setLayout(inColumn({steps_,
                      inRow({add_, seconds_, "s", Stretch{}, remove_, up_, down_}),
                      inRow({times_, "times", Stretch{}, start_, file_}),
                      state_,
                      Stretch{}}));
  connect(remove_, &QPushButton::clicked, this, [this] {
    const int row = steps_->currentRow();
    if (row < 0) return;
    sequence_.steps.erase(sequence_.steps.begin() + row);
    changed(row);
  });
  connect(up_, &QPushButton::clicked, this, [this] { moveStep(-1); });
  connect(down_, &QPushButton::clicked, this, [this] { moveStep(1); });
  connect(times_, &QSpinBox::valueChanged, this, [this](int value) {
    sequence_.repetitions = value;
    settings_.setValue(kStoredSequence, QString::fromStdString(sequenceText(sequence_)));
  });
  connect(start_, &QPushButton::clicked, this, &SequencePanel::start);
  connect(&reading_, &FileReading::finished, this, [this] {
    refresh(control_ ? control_->status() : GraspStatus{});
  });
  connect(steps_, &QListWidget::currentRowChanged, this, [this] {
    refresh(control_ ? control_->status() : GraspStatus{});
  });
}

void SequencePanel::fillAddMenu() {
  addMenu_->clear();
  const auto grasp = [this](const QString& title, GraspMode mode, const char* name) {
    QAction* action = addMenu_->addAction(title, this, [this, mode] {
      SequenceStep step;
      step.kind = StepKind::kGrasp;
      step.request = graspRequest(mode);
      add(std::move(step));
    });
    action->setObjectName(name);
  };
  addMenu_
      ->addAction("Open",
                  this,
                  [this] {
                    SequenceStep step;
                    step.kind = StepKind::kOpen;
                    const GraspRequest now = graspRequest(GraspMode::kPlain);
                    step.request.preshape = now.preshape;
                    step.request.velocityDegPerS = now.velocityDegPerS;
                    step.request.closeRatio = 0.0;
                    add(std::move(step));
                  })
      ->setObjectName("addOpen");
  grasp("Grasp", GraspMode::kPlain, "addGrasp");
  grasp("Reactive grasp", GraspMode::kReactive, "addReactive");
  grasp("Slip-aware grasp", GraspMode::kSlip, "addSlipAware");
  QMenu* own = addMenu_->addMenu("Pose");
  for (const SavedPose& pose : poses())
    own->addAction(QString::fromStdString(pose.name).replace("&", "&&"), this, [this, pose] {
      SequenceStep step;
      step.kind = StepKind::kPose;
      step.pose = pose;
      step.request.velocityDegPerS = poseVelocity();
      add(std::move(step));
    });
  own->setEnabled(!own->isEmpty());
  const auto still = [this](const QString& title, StepKind kind, const char* name) {
    QAction* action = addMenu_->addAction(title, this, [this, kind] {
      SequenceStep step;
      step.kind = kind;
      step.seconds = seconds_->value();
      add(std::move(step));
    });
    action->setObjectName(name);
  };
  still("Hold", StepKind::kHold, "addHold");
  still("Wait", StepKind::kWait, "addWait");
}

// Behind the chosen step, if it can be done by this hand.
void SequencePanel::add(SequenceStep step) {
  // The time beside Add is that of a step Hold or Wait.
  if (step.kind == StepKind::kGrasp && step.request.mode == GraspMode::kSlip &&
      step.request.holding.holdS <= 0.0)
    return emit refused(
        "a slip-aware grasp in a sequence needs a time to hold: set it on the page Grasp, More > "
        "Hold");
  MotionSequence alone;
  alone.hand = movableHand().name;
  alone.steps = {step};
  try {
    alone.validate(movableHand());
  } catch (const std::invalid_argument& error) {
    return emit refused(QString(error.what()).remove("step 1: "));
  }
  if (sequence_.steps.size() >= MotionSequence::kMaxSteps)
    return emit refused("the sequence has as many steps as it can have");
  const int at = sequence_.steps.empty() ? 0 : steps_->currentRow() + 1;
  sequence_.steps.insert(sequence_.steps.begin() + at, std::move(step));
  changed(at);
}

void SequencePanel::changed(int current) {
  settings_.setValue(kStoredSequence, QString::fromStdString(sequenceText(sequence_)));
  list(current);
}

void SequencePanel::list(int current) {
  steps_->clear();
  for (std::size_t i = 0; i < sequence_.steps.size(); ++i) {
    const QString text =
        QString::number(i + 1) + "  " + QString::fromStdString(describe(sequence_.steps[i]));
    auto* item = new QListWidgetItem(text, steps_);
    item->setToolTip(text);
  }
  const int last = static_cast<int>(sequence_.steps.size()) - 1;
  steps_->setCurrentRow(std::min(current, last));
  refresh(control_ ? control_->status() : GraspStatus{});
}

void SequencePanel::moveStep(int by) {
  const int row = steps_->currentRow();
  const int to = row + by;
  if (row < 0 || to < 0 || to >= static_cast<int>(sequence_.steps.size())) return;
  std::swap(sequence_.steps[static_cast<std::size_t>(row)],
            sequence_.steps[static_cast<std::size_t>(to)]);
  changed(to);
}

void SequencePanel::start() {
  if (!run_) return;
  emit begins();
  try {
    run_->begin(sequence_, session_->device().hand(), session_->nowUs());
  } catch (const std::exception& error) {
    emit refused(error.what());
  }
  emit asked();
}

void SequencePanel::openFile() {
  const QString path = ask_.file("Open a sequence", {}, kSequenceFilter);
  if (path.isEmpty()) return;
  reading_.start(
      [this, file = std::filesystem::path(path.toStdString())]() -> FileReading::Take {
        MotionSequence read = parseSequence(readTextFile(file, kLargestSequenceFile), file);
        try {
          read.validate(movableHand());
        } catch (const std::invalid_argument& error) {
          throw FormatError(file, error.what());
        }
        return [this, file, read = std::move(read)] {
          if (running())
            return emit refused(QString::fromStdString(file.filename().string()) +
                                ": not opened: a sequence runs");
          sequence_ = read;
          times_->setValue(sequence_.repetitions);
          changed(0);
        };
      },
      [this](const QString& why) { emit refused(why); });
  refresh(control_ ? control_->status() : GraspStatus{});
}

void SequencePanel::saveFile() {
  const QString path = ask_.newFile("Save the sequence", "sequence.json", kSequenceFilter);
  if (path.isEmpty()) return;
  try {
    // The dialogue has asked about an existing file.
    OutputFile file(path.toStdString(), Overwrite::kReplace);
    file.write(sequenceText(sequence_));
    file.commit();
    said_ = "Saved: " + path;
    refresh(control_ ? control_->status() : GraspStatus{});
  } catch (const Error& error) {
    emit refused(error.what());
  }
}

void SequencePanel::setHand(CaptureSession* session, GraspControl* control, const QString& whyNot) {
  session_ = session;
  control_ = session ? control : nullptr;
  whyNot_ = whyNot;
  run_ = control_ ? std::make_unique<SequenceRun>(*control_) : nullptr;
  refresh(control_ ? control_->status() : GraspStatus{});
}

QString SequencePanel::stateText() const {
  return run_ ? QString::fromStdString(run_->status().text) : QString();
}

void SequencePanel::refresh(const GraspStatus& status) {
  const SequenceRun::Status run = run_ ? run_->status() : SequenceRun::Status{};
  const bool runs = run.running;
  // The table that is being read takes the place of this one.
  const bool edits = !runs && !reading_.busy();
  QString why;
  if (!control_)
    why = whyNot_;
  else if (runs)
    why = "A sequence runs; Stop (Esc) ends it";
  else if (!edits)
    why = "A sequence is being read";
  else if (!status.cannotMove.empty())
    why = QString::fromStdString(status.cannotMove);
  else if (status.phase != GraspPhase::kIdle)
    why = busyText(status);
  else if (sequence_.steps.empty())
    why = "Add a step first";
  enableMotionButton(*start_, why.isEmpty());
  const QString tip = why.isEmpty() ? "Run the steps in order; Stop or Esc ends the sequence" : why;
  if (start_->toolTip() != tip) start_->setToolTip(tip);
  const int row = steps_->currentRow();
  add_->setEnabled(edits);
  remove_->setEnabled(edits && row >= 0);
  up_->setEnabled(edits && row > 0);
  down_->setEnabled(edits && row >= 0 && row + 1 < steps_->count());
  times_->setEnabled(edits);
  file_->setEnabled(edits);
  steps_->setEnabled(!runs);
  if (runs && row != static_cast<int>(run.step)) steps_->setCurrentRow(static_cast<int>(run.step));
  if (runs) said_.clear();
  const QString empty = sequence_.steps.empty() && !runs
                            ? QString(
                                  "Add steps: each takes the values of the pages Grasp and Joints. "
                                  "Start runs them in order.")
                            : QString();
  state_->setText(!said_.isEmpty() ? said_ : !empty.isEmpty() ? empty : stateText());
}

}  // namespace palpate::gui
