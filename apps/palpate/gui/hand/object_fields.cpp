#include "gui/hand/object_fields.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QValidator>

#include <palpate/core/error.h>
#include <palpate/kinematics/preshape_opening.h>
#include <palpate/model/hand_file.h>
#include <palpate/model/preshape.h>

#include "gui/appearance/captions.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"

namespace palpate::gui {
namespace {

// A name that GraspRequest accepts: one line of up to so many bytes.
class ObjectName : public QValidator {
 public:
  using QValidator::QValidator;
  State validate(QString& text, int& /*position*/) const override {
    for (QChar& each : text)
      if (each.category() == QChar::Other_Control || each == QChar::LineSeparator ||
          each == QChar::ParagraphSeparator)
        each = ' ';
    return text.toUtf8().size() <= static_cast<qsizetype>(kMaxObjectBytes) ? Acceptable : Invalid;
  }
};

}  // namespace

ObjectFields::ObjectFields(QWidget* parent) : QWidget(parent), hand_(movableHand()) {
  name_ = named(new QComboBox(this), "objectName", {}, "Name of the object");
  name_->setEditable(true);
  name_->setInsertPolicy(QComboBox::NoInsert);
  // No completion: "ball" must not become "ball of foam".
  name_->setCompleter(nullptr);
  name_->setValidator(new ObjectName(name_));
  name_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  name_->setMinimumContentsLength(8);
  name_->lineEdit()->setPlaceholderText("no name");
  name_->setToolTip(
      "Remember under this name where grasps with this preshape touched the object: later ones are "
      "fast until shortly before. Not kept for the next session");
  size_ = named(new SecondsField(this), "objectSize", {}, "Size of the object");
  size_->setToolTip(
      "Width between the fingers: a grasp that keeps its limit is fast until shortly before it. If "
      "unsure, give a larger size. Not kept for the next session");
  size_->refused().setSaidUnit(" mm");
  size_->setDecimals(1);
  size_->setRange(0.0, kLargestObjectMm);
  size_->setFocusPolicy(Qt::StrongFocus);
  size_->setSpecialValueText("not known");
  remembered_ = makeLabel(this, "rememberedTouch", "muted");
  remembered_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  forget_ = makeButton(this, "forgetTouch", "Forget");
  forget_->setAccessibleName("Forget where the object was touched");
  forget_->setFocusPolicy(Qt::TabFocus);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(1, 1);
  grid->addWidget(new QLabel("Object", this), 0, 0);
  grid->addWidget(name_, 0, 1, 1, 2);
  grid->addWidget(new QLabel("Size, mm", this), 1, 0);
  grid->addWidget(size_, 1, 1, 1, 2);
  grid->addWidget(remembered_, 2, 0, 1, 2);
  grid->addWidget(forget_, 2, 2);
  connect(name_, &QComboBox::currentTextChanged, this, [this] {
    showRemembered();
    emit changed();
  });
  connect(size_, &QDoubleSpinBox::valueChanged, this, [this] {
    renewTouchRatio();
    emit changed();
  });
  connect(forget_, &QPushButton::clicked, this, [this] { emit forgets(preshape_, name()); });
  showRemembered();
}

void ObjectFields::setHand(const HandDescription& hand) {
  hand_ = hand;
  geometry_.reset();
  renewTouchRatio();
}

void ObjectFields::setPreshape(const std::string& preshape) {
  preshape_ = preshape;
  showNames();
  renewTouchRatio();
}

void ObjectFields::setTouches(const TouchMemory& touches) {
  touches_ = touches;
  showNames();
  showRemembered();
}

void ObjectFields::showNames() {
  QStringList names, shown;
  for (const std::string& each : touches_.objects(preshape_)) names += QString::fromStdString(each);
  for (int i = 0; i < name_->count(); ++i) shown += name_->itemText(i);
  if (names == shown) return;  // somebody may be typing
  const QSignalBlocker notChosen(name_);
  const QString typed = name_->currentText();
  name_->clear();
  name_->addItems(names);
  name_->setCurrentIndex(static_cast<int>(names.indexOf(typed)));
  name_->setEditText(typed);
}

void ObjectFields::setIdle(bool idle) {
  if (std::exchange(idle_, idle) != idle) showRemembered();
}

// About 30 ms.
void ObjectFields::renewTouchRatio() {
  touchRatio_.reset();
  if (size_->value() > 0.0 && !preshape_.empty() && hasGeometry(hand_)) try {
      if (!geometry_) geometry_ = std::make_unique<const HandGeometry>(describeGeometry(hand_));
      touchRatio_ = touchRatioOf(
          *geometry_, findPreshape(movableHand().file->preshapes, preshape_), size_->value());
    } catch (const std::exception&) {
      // The geometry doesn't fit, or the hand has other joints: the size tells nothing.
    }
  showRemembered();
}

void ObjectFields::showRemembered() {
  const auto touch = touches_.find(preshape_, name());
  QString text;
  if (touch)
    text = "touched at " + figure(touch->ratio, 2) + ", " +
           numberOf(static_cast<std::uint64_t>(touch->grasps), "grasp");
  else if (touchRatio_)
    text = "expected at " + figure(*touchRatio_, 2) + " at the earliest, by its size";
  else if (size_->value() > 0.0)
    text = "this preshape doesn't close to its size";
  else if (!name().empty())
    text = "nothing is remembered with this preshape";
  remembered_->setText(text);
  remembered_->setToolTip(text.isEmpty() ? text : text + ". 0: open, 1: closed");
  forget_->setEnabled(touch && idle_);
  forget_->setToolTip(!touch  ? "Nothing is remembered under this name with this preshape"
                      : idle_ ? "Forget it: the next grasp of this name is slow again"
                              : "A motion runs");
}

std::string ObjectFields::name() const { return name_->currentText().trimmed().toStdString(); }

QString ObjectFields::text() const {
  QStringList parts;
  if (!name().empty()) parts += QString::fromStdString(name());
  if (size_->value() > 0.0) parts += figure(size_->value(), 1) + " mm";
  return parts.join(", ");
}

void ObjectFields::apply(GraspRequest& request) const {
  request.object = name();
  request.touchRatio = touchRatio_;
}

}  // namespace palpate::gui
