#include "gui/hand/joint_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSet>
#include <QSlider>
#include <algorithm>
#include <initializer_list>
#include <set>
#include <string_view>

#include <palpate/core/error.h>
#include <palpate/core/output_file.h>
#include <palpate/core/text_file.h>

#include "gui/appearance/captions.h"
#include "gui/desktop/ask.h"
#include "gui/hand/motion_button.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"
#include "gui/widgets/value_slider.h"

namespace palpate::gui {
namespace {

constexpr const char* kJointContact = "joints/stop_at_contact";
constexpr const char* kOwnPoses = "Own poses…";
constexpr const char* kSaveTip = "Save the current angles under a name";
constexpr const char* kPoseFilter = "Poses (*.json)";
constexpr std::uint64_t kLargestPoseFile = 10'000'000;
constexpr std::size_t kMaxImportedPoses = 1000;

QString angleText(double value, const AxisDescription& axis) {
  return figure(value, 1) + (axis.isSliding ? " mm" : "°");
}

}  // namespace

JointPanel::JointPanel(QSettings& settings, Ask& ask, QWidget* parent)
    : QWidget(parent), settings_(settings), ask_(ask) {
  reactiveLimits = [] { return GraspRequest{}; };
  auto* grid = new QGridLayout;
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(2, 1);
  makeRows(*grid);
  velocity_ =
      new ValueSlider("Velocity of the joints",
                      {kMinGraspDegPerS, kMaxGraspDegPerS, kMaxGraspDegPerS, 0.2, 1, {}, " deg/s"},
                      this);
  velocity_->setObjectName("jointVelocity");
  velocity_->field()->setSingleStep(1.0);
  velocity_->setToolTip("deg/s; slower joints go as fast as they can");
  velocity_->showValue(GraspRequest{}.velocityDegPerS);
  settings.remove("joints/velocity_deg_per_s");
  const int last = static_cast<int>(rows_.size());
  grid->addWidget(new QLabel("Velocity, deg/s", this), last, 0, 1, 2);
  grid->addWidget(velocity_, last, 2);
  stopAtContact_ = named(new QCheckBox("Stop at a contact", this), "stopAtContact");
  stopAtContact_->setToolTip("Move under tactile control, with the limits of the page Grasp");
  stopAtContact_->setChecked(settings.value(kJointContact, false).toBool());
  move_ = motionButton("Move", "moveJoints", {}, true, this);
  reset_ = motionButton("Reset",
                        "resetTargets",
                        "Reset the targets to the current angles; nothing moves",
                        false,
                        this);
  setLayout(
      inColumn({grid, inRow({stopAtContact_, Stretch{}, move_, reset_}), makePoses(), Stretch{}}));
  connect(stopAtContact_, &QCheckBox::toggled, this, [this](bool on) {
    settings_.setValue(kJointContact, on);
  });
  connect(move_, &QPushButton::clicked, this, [this] { move(std::nullopt); });
  connect(reset_, &QPushButton::clicked, this, &JointPanel::resetTargets);
  listPoses();
  showStatus({}, GraspPhase::kIdle);
}

void JointPanel::makeRows(QGridLayout& grid) {
  const HandDescription& hand = movableHand();
  for (std::size_t axis = 0; axis < hand.axes.size(); ++axis) {
    const AxisDescription& is = hand.axes[axis];
    const QString name = QString::fromStdString(is.name);
    const QString number = QString::number(axis);
    Row row{};
    row.name = new QLabel(name, this);
    row.present = new QLabel(this);
    row.present->setObjectName("presentAngle" + number);
    row.present->setProperty("role", "muted");
    row.present->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    fitToText(*row.present, [label = row.present] {
      label->setFixedWidth(label->fontMetrics().horizontalAdvance("-188.8°") + 4);
    });
    row.present->setToolTip("Present angle");
    row.target = new ValueSlider(
        "Target of " + name,
        {is.minimumDeg, is.maximumDeg, is.maximumDeg, 0.5, 1, {}, is.isSliding ? " mm" : "°"},
        this);
    row.target->setObjectName("targetAngle" + number);
    row.target->setToolTip(name + ": " + angleText(is.minimumDeg, is) + " .. " +
                           angleText(is.maximumDeg, is) + "; moves only with Move");
    fitToText(*row.target->field(), [field = row.target->field()] {
      field->setFixedWidth(field->fontMetrics().horizontalAdvance("-188.8") + 18);
    });
    row.move = motionButton("Move", "moveJoint" + number, {}, true, this);
    row.move->setAccessibleName("Move " + name);
    const int at = static_cast<int>(axis);
    grid.addWidget(row.name, at, 0);
    grid.addWidget(row.present, at, 1);
    grid.addWidget(row.target, at, 2);
    grid.addWidget(row.move, at, 3);
    rows_.push_back(row);
    // While a slider is dragged the field shows the value, and the row counts as changed.
    connect(row.target->slider(), &QSlider::sliderPressed, this, [this, axis] {
      setChangedByHand(rows_[axis]);
    });
    connect(row.target, &ValueSlider::chosen, this, [this, axis] {
      setChangedByHand(rows_[axis]);
      showPresent();
    });
    connect(row.move, &QPushButton::clicked, this, [this, axis] { move(axis); });
  }
}

QWidget* JointPanel::makePoses() {
  auto* part = new QWidget(this);
  names_ = named(new QComboBox(part), "ownPoses", "Load this pose as the targets; Move goes there");
  names_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  names_->setMinimumContentsLength(8);
  save_ = motionButton("Save…", "savePose", kSaveTip, false, part);
  rename_ = motionButton("Rename…", "renamePose", "Rename the chosen pose", false, part);
  remove_ = motionButton("Delete", "removePose", "Delete the chosen pose", false, part);
  file_ = motionButton("File", "poseFile", "Import poses from a file, or export them", false, part);
  auto* menu = new QMenu(file_);
  menu->addAction("Import…", this, &JointPanel::importPoses)->setObjectName("importPoses");
  menu->addAction("Export…", this, &JointPanel::exportPoses)->setObjectName("exportPoses");
  file_->setMenu(menu);
  part->setLayout(inRow({{names_, 1}, save_, rename_, remove_, file_}));
  connect(names_, &QComboBox::activated, this, [this](int index) {
    if (index > 0) choosePose(names_->currentText());
    showPresent();
  });
  connect(save_, &QPushButton::clicked, this, &JointPanel::savePose);
  connect(rename_, &QPushButton::clicked, this, &JointPanel::renamePose);
  connect(remove_, &QPushButton::clicked, this, &JointPanel::removePose);
  return part;
}

NamedItems<SavedPose> JointPanel::saved() const {
  return {settings_,
          "poses/" + keyPartOf(QString::fromStdString(movableHand().name)),
          [](const SavedPose& pose) { return posesText({pose}); },
          [](const std::string& text) {
            const std::vector<SavedPose> poses = parsePoses(text, "settings");
            if (poses.size() != 1) throw FormatError("settings", "isn't one pose");
            return poses[0];
          }};
}

void JointPanel::listPoses(const QString& chosen) {
  names_->clear();
  names_->addItem(kOwnPoses);
  names_->addItems(saved().names());
  names_->setCurrentIndex(std::max(0, names_->findText(chosen)));
  showPresent();
  emit posesChanged();
}

void JointPanel::choosePose(const QString& name) {
  const auto pose = saved().load(name);
  if (!pose) return emit refused("the pose '" + name + "' can't be read");
  if (const std::string problem = problemOf(*pose, movableHand()); !problem.empty())
    return emit refused(QString::fromStdString(problem));
  for (std::size_t axis = 0; axis < rows_.size(); ++axis) {
    rows_[axis].target->showValue(pose->anglesDeg[axis]);
    setChanged(rows_[axis]);
  }
}

void JointPanel::setChanged(Row& row) {
  row.changed = true;
  row.underWay = false;
}

void JointPanel::setChangedByHand(Row& row) {
  names_->setCurrentIndex(0);
  setChanged(row);
}

void JointPanel::savePose() {
  if (!control_) return;
  const std::vector<double> angles = control_->status().anglesDeg;
  const QString name =
      ask_.text("Pose", "Name", names_->currentIndex() > 0 ? names_->currentText() : QString())
          .value_or(QString());
  if (name.isEmpty()) return;
  SavedPose pose{name.toStdString(), movableHand().name, angles};
  // A joint can be a few hundredths of a degree beyond its range.
  for (std::size_t axis = 0; axis < std::min(angles.size(), movableHand().axes.size()); ++axis) {
    const AxisDescription& is = movableHand().axes[axis];
    const double within = std::clamp(angles[axis], is.minimumDeg, is.maximumDeg);
    if (std::abs(within - angles[axis]) < 1.0) pose.anglesDeg[axis] = within;
  }
  if (const std::string problem = problemOf(pose, movableHand()); !problem.empty())
    return emit refused(QString::fromStdString(problem));
  if (saved().names().contains(name) &&
      !ask_.confirmed("Replace the pose \"" + name + "\" with the current angles?", "Replace"))
    return;
  saved().save(QString::fromStdString(pose.name), pose);
  // The name says what the targets are: those that were set before are other ones.
  const bool targetsSet =
      std::any_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.changed; });
  listPoses(targetsSet ? QString() : name);
}

void JointPanel::removePose() {
  if (names_->currentIndex() <= 0) return;
  const QString name = names_->currentText();
  if (!ask_.confirmed("Delete the pose \"" + name + "\"?", "Delete")) return;
  saved().remove(name);
  listPoses();
}

void JointPanel::renamePose() {
  if (names_->currentIndex() <= 0) return;
  const QString before = names_->currentText();
  auto pose = saved().load(before);
  if (!pose) return emit refused("the pose '" + before + "' can't be read");
  const QString name = ask_.text("Pose", "Name", before).value_or(QString());
  if (name.isEmpty() || name == before) return;
  if (saved().names().contains(name)) return emit refused("a pose '" + name + "' exists already");
  pose->name = name.toStdString();
  saved().save(name, *pose);
  saved().remove(before);
  listPoses(name);
}

// All poses of the file, or none.
void JointPanel::importPoses() {
  const QString path = ask_.file("Import poses", {}, kPoseFilter);
  if (path.isEmpty()) return;
  reading_.start(
      [this, file = std::filesystem::path(path.toStdString())]() -> FileReading::Take {
        auto poses = parsePoses(readTextFile(file, kLargestPoseFile), file);
        if (poses.size() > kMaxImportedPoses)
          throw Error("nothing imported: more than " + std::to_string(kMaxImportedPoses) +
                      " poses");
        std::set<std::string_view> names;
        for (const SavedPose& pose : poses) {
          if (const std::string problem = problemOf(pose, movableHand()); !problem.empty())
            throw Error("nothing imported: " + problem);
          if (!names.insert(pose.name).second)
            throw Error("nothing imported: the pose '" + pose.name + "' is there twice");
        }
        return [this, poses = std::move(poses)] { takePoses(poses); };
      },
      [this](const QString& why) { emit refused(why); });
}

void JointPanel::takePoses(const std::vector<SavedPose>& poses) {
  const QStringList names = saved().names();
  const QSet<QString> there(names.begin(), names.end());
  for (const SavedPose& pose : poses)
    if (there.contains(QString::fromStdString(pose.name)))
      return emit refused("nothing imported: a pose '" + QString::fromStdString(pose.name) +
                          "' exists already");
  for (const SavedPose& pose : poses) saved().save(QString::fromStdString(pose.name), pose);
  listPoses();
}

void JointPanel::exportPoses() {
  std::vector<SavedPose> poses;
  for (const QString& name : saved().names())
    if (auto pose = saved().load(name)) poses.push_back(std::move(*pose));
  if (poses.empty()) return emit refused("there is no pose to export");
  const QString path = ask_.newFile("Export poses", "poses.json", kPoseFilter);
  if (path.isEmpty()) return;
  try {
    // The dialogue has asked about an existing file.
    OutputFile file(path.toStdString(), Overwrite::kReplace);
    file.write(posesText(poses));
    file.commit();
  } catch (const Error& error) {
    emit refused(error.what());
  }
}

double JointPanel::velocityDegPerS() const { return velocity_->value(); }

// Moves one joint, or all whose target was set; the others stay.
void JointPanel::move(std::optional<std::size_t> axis) {
  if (!control_) return;
  GraspRequest request;
  if (stopAtContact_->isChecked()) request = reactiveLimits();
  request.startRatio.reset();
  request.velocityDegPerS = velocity_->value();
  request.targetDeg.assign(rows_.size(), std::nullopt);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].underWay = axis ? i == *axis : rows_[i].changed;
    if (!rows_[i].underWay) continue;
    request.targetDeg[i] = rows_[i].target->value();
    ++moved;
  }
  if (moved == 0) return;
  request.title = axis || moved == 1 ? std::string("one joint")
                  : moved == rows_.size() && names_->currentIndex() > 0
                      ? names_->currentText().toStdString()
                      : std::to_string(moved) + " joints";
  emit begins();
  try {
    control_->grasp(request);
    moving_ = true;
  } catch (const std::exception& error) {
    const auto last = control_->status().last;
    const bool refusedByHand = last && last->outcome == GraspOutcome::kRefused;
    emit refused(refusedByHand ? QString::fromStdString(last->text) : QString(error.what()));
  }
  emit asked();
}

void JointPanel::resetTargets() {
  for (Row& row : rows_) row.changed = false;
  names_->setCurrentIndex(0);
  showPresent();
}

void JointPanel::setControl(GraspControl* control, const QString& whyNot) {
  control_ = control;
  whyNot_ = whyNot;
  moving_ = false;
  for (Row& row : rows_) row.changed = row.underWay = false;
  showPresent();
}

void JointPanel::showPresent() {
  const GraspStatus status = control_ ? control_->status() : GraspStatus{};
  showStatus(status, status.phase);
}

void JointPanel::showStatus(const GraspStatus& status, GraspPhase phase) {
  const bool idle = status.phase == GraspPhase::kIdle;
  const HandDescription& hand = movableHand();
  const bool known = control_ && status.anglesDeg.size() == rows_.size();
  if (moving_ && idle) {
    // What was reached is no target any more; what was stopped on its way remains one.
    moving_ = false;
    const bool reached = status.last && status.last->outcome == GraspOutcome::kFinished &&
                         status.last->heldAxes.empty();
    for (Row& row : rows_)
      if (row.underWay && reached) row.changed = false;
  }
  QString why;
  if (!control_)
    why = whyNot_;
  else if (!status.cannotMove.empty())
    why = QString::fromStdString(status.cannotMove);
  else if (!known)
    why = "The current angles are not known yet";
  else if (!idle)
    why = busyText(status);
  std::size_t changed = 0;
  for (std::size_t axis = 0; axis < rows_.size(); ++axis) {
    Row& row = rows_[axis];
    const QString present = known ? angleText(status.anglesDeg[axis], hand.axes[axis]) : "–";
    if (row.present->text() != present) row.present->setText(present);
    if (!row.changed) {
      if (known)
        row.target->showValue(status.anglesDeg[axis]);
      else
        row.target->showUnknown();
    }
    row.target->setEnabled(known);
    changed += row.changed ? 1 : 0;
    showRow(row);
    const bool can = why.isEmpty() && row.changed;
    enableMotionButton(*row.move, can);
    const QString tip = can             ? "Move only this joint to its target"
                        : why.isEmpty() ? "Set a target first"
                                        : why;
    if (row.move->toolTip() != tip) row.move->setToolTip(tip);
  }
  const bool can = why.isEmpty() && changed > 0;
  enableMotionButton(*move_, can);
  const QString tip = can             ? "Move all joints whose targets were set; the others stay"
                      : why.isEmpty() ? "Set a target first, or choose a pose"
                                      : why;
  if (move_->toolTip() != tip) move_->setToolTip(tip);
  reset_->setEnabled(changed > 0);
  velocity_->setEnabled(control_);
  // Angles of a motion are those of one moment, which is no pose.
  const bool moves = phase != GraspPhase::kIdle && phase != GraspPhase::kHolding;
  save_->setEnabled(known && status.cannotMove.empty() && !moves);
  const QString saveTip =
      moves ? QString("The hand moves: angles are saved when it stands still") : kSaveTip;
  if (save_->toolTip() != saveTip) save_->setToolTip(saveTip);
  rename_->setEnabled(names_->currentIndex() > 0);
  remove_->setEnabled(names_->currentIndex() > 0);
}

// A row whose target differs from the present angle is bold.
void JointPanel::showRow(Row& row) {
  QFont font = row.name->font();
  if (font.bold() == row.changed) return;
  font.setBold(row.changed);
  row.name->setFont(font);
}

}  // namespace palpate::gui
