#include "gui/connect/port_field.h"

#include <QAbstractItemView>
#include <QGridLayout>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QTimer>

#include "gui/widgets/make.h"
#include "gui/widgets/two_line_delegate.h"

namespace palpate::gui {
namespace {

constexpr int kTypingPauseMs = 800;

}  // namespace

PortField::PortField(const QString& title,
                     const QString& whenEmpty,
                     const QString& name,
                     QWidget* parent)
    : QWidget(parent), whenEmpty_(whenEmpty) {
  box_ = named(new QComboBox(this), name + "Port");
  box_->setEditable(true);
  box_->setInsertPolicy(QComboBox::NoInsert);
  // A completer would turn ttyUSB1 into ttyUSB10.
  box_->setCompleter(nullptr);
  box_->setItemDelegate(new TwoLineDelegate(box_));
  box_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box_->setMinimumContentsLength(30);
  box_->lineEdit()->setPlaceholderText("none");
  box_->setToolTip(
      "A port of the list, another device such as /dev/pts/3, or a network name such as "
      "tcp:192.168.1.42:13000");
  mark_ = new StateMark(this);
  answer_ = makeLines(this, name + "Answer", "muted");
  answer_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  answer_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  // Two lines, so that the layout does not change when the text wraps.
  answer_->setMinimumHeight(2 * fontMetrics().lineSpacing());
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(7);
  grid->setVerticalSpacing(4);
  grid->addWidget(makeTitle(title, box_), 0, 0, 1, 2);
  grid->addWidget(box_, 1, 0, 1, 2);
  grid->addWidget(mark_, 2, 0, Qt::AlignTop);
  grid->addWidget(answer_, 2, 1);
  grid->setColumnStretch(1, 1);
  connect(box_, &QComboBox::editTextChanged, this, &PortField::changed);
  connect(box_->lineEdit(), &QLineEdit::textEdited, this, [this] { touched_ = true; });
  connect(box_, &QComboBox::activated, this, [this] {
    touched_ = true;
    emit entered();
  });
  connect(box_->lineEdit(), &QLineEdit::editingFinished, this, &PortField::entered);
  // A typed port is checked when the user pauses, too.
  auto* pause = new QTimer(this);
  pause->setSingleShot(true);
  pause->setInterval(kTypingPauseMs);
  connect(box_->lineEdit(), &QLineEdit::textEdited, pause, qOverload<>(&QTimer::start));
  connect(pause, &QTimer::timeout, this, &PortField::entered);
}

// Disconnects the box first: when it is destroyed with the keyboard focus, it emits that typing has
// ended, and this object could no longer handle that.
PortField::~PortField() {
  box_->lineEdit()->disconnect(this);
  box_->disconnect(this);
}

QString PortField::port() const { return box_->currentText().trimmed(); }

void PortField::setPort(const QString& port) {
  const int choice = box_->findText(port);
  const QSignalBlocker quiet(box_);
  box_->setCurrentIndex(choice);
  box_->setEditText(port);
  box_->lineEdit()->setCursorPosition(0);
  emit changed();
}

void PortField::setChoices(const QList<ScannedPort>& ports) {
  const QString text = box_->currentText();
  const int cursor = box_->lineEdit()->cursorPosition();
  {
    const QSignalBlocker quiet(box_);
    box_->clear();
    for (const ScannedPort& port : ports)
      box_->addItem(QString::fromStdString(port.info.stableName));
    box_->setCurrentIndex(box_->findText(text));
    box_->setEditText(text);
  }
  box_->lineEdit()->setCursorPosition(cursor);
}

void PortField::setDetail(int choice, const QString& detail) {
  {
    // When the model reports that an item changed, the box would overwrite what the user is typing.
    const QSignalBlocker quiet(box_->model());
    box_->setItemData(choice, detail, TwoLineDelegate::kDetailRole);
  }
  if (box_->view()->isVisible()) box_->view()->viewport()->update();
}

void PortField::showState(const PortFieldState& state) {
  mark_->setState(state.mark);
  answer_->setText(state.text.isEmpty() && port().isEmpty() ? whenEmpty_ : state.text);
}

}  // namespace palpate::gui
