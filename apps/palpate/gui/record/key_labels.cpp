#include "gui/record/key_labels.h"

#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>
#include <QVBoxLayout>

namespace palpate::gui {
namespace {

constexpr int kKeyLabelsMostLetters = 60;  // of a label
constexpr int kRows = 5;
// In the order of the keyboard.
constexpr std::array<std::size_t, 10> kKeyOrder = {1, 2, 3, 4, 5, 6, 7, 8, 9, 0};

constexpr const char* kKeyLabelsStyle = R"(
#keyCap { background: palette(button); border: 1px solid palette(mid); border-radius: 4px; padding: 3px 0; }
#marksHeader { padding: 4px 6px 4px 2px; }
)";

}  // namespace

KeyLabels::KeyLabels(QWidget* parent) : QWidget(parent) {
  setStyleSheet(kKeyLabelsStyle);
  header_ = new QToolButton(this);
  header_->setObjectName("marksHeader");
  header_->setText("&Marks by key");
  header_->setToolTip("What the digit keys add to a running recording");
  header_->setCheckable(true);
  header_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  header_->setProperty("flat", true);
  header_->setFocusPolicy(Qt::StrongFocus);
  summary_ = new QLabel(this);
  summary_->setObjectName("marksSummary");
  summary_->setTextFormat(Qt::PlainText);
  summary_->setProperty("role", "muted");
  summary_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  auto* head = new QHBoxLayout;
  head->setSpacing(8);
  head->addWidget(header_);
  head->addWidget(summary_, 1);
  grid_ = makeGrid();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addLayout(head);
  column->addWidget(grid_);
  connect(header_, &QToolButton::toggled, this, [this](bool open) {
    fold(open);
    // Updates the layout at once, so that parent widgets get the new height.
    layout()->activate();
    emit folded();
  });
  fold(false);
}

QWidget* KeyLabels::makeGrid() {
  auto* made = new QWidget(this);
  made->setObjectName("marksGrid");
  auto* grid = new QGridLayout(made);
  grid->setContentsMargins(0, 2, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(5);
  grid->setColumnMinimumWidth(2, 12);
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(4, 1);
  const int keyWidth = 2 * fontMetrics().horizontalAdvance('0') + 12;
  QWidget* before = header_;
  int place = 0;
  for (const std::size_t digit : kKeyOrder) {
    const QString name = QString::number(digit);
    auto* key = new QLabel(name, made);
    key->setObjectName("keyCap");
    key->setAlignment(Qt::AlignCenter);
    key->setFixedWidth(keyWidth);
    auto* field = new QLineEdit(made);
    field->setObjectName("markLabel" + name);
    field->setAccessibleName("Label of key " + name);
    field->setPlaceholderText("mark " + name);
    field->setMaxLength(kKeyLabelsMostLetters);
    connect(field, &QLineEdit::textChanged, this, &KeyLabels::sumUp);
    const int column = place / kRows * 3;
    grid->addWidget(key, place % kRows, column);
    grid->addWidget(field, place % kRows, column + 1);
    setTabOrder(before, field);
    before = fields_[digit] = field;
    ++place;
  }
  return made;
}

void KeyLabels::setLabels(const Labels& labels) {
  for (std::size_t digit = 0; digit < fields_.size(); ++digit)
    fields_[digit]->setText(labels[digit]);
}

KeyLabels::Labels KeyLabels::labels() const {
  Labels labels;
  for (std::size_t digit = 0; digit < fields_.size(); ++digit)
    labels[digit] = fields_[digit]->text().simplified();
  return labels;
}

void KeyLabels::fold(bool open) {
  header_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
  grid_->setVisible(open);
  sumUp();
}

void KeyLabels::sumUp() {
  QStringList marks;
  const Labels all = labels();
  for (const std::size_t digit : kKeyOrder)
    if (!all[digit].isEmpty()) marks.append(QString::number(digit) + " " + all[digit]);
  const QString text = marks.isEmpty() ? "no labels" : marks.join(" · ");
  // When open, all labels are visible.
  const bool open = header_->isChecked();
  summary_->setText(
      open ? QString()
           : summary_->fontMetrics().elidedText(text, Qt::ElideRight, summary_->width()));
  summary_->setAccessibleName(text);
}

void KeyLabels::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layout()->activate();
  sumUp();
}

}  // namespace palpate::gui
