#include "gui/record/key_labels.h"

#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>

namespace palpate::gui {
namespace {

constexpr int kKeyLabelsMostLetters = 60;  // of a label
constexpr int kRows = 5;
// In the order of the keyboard.
constexpr std::array<std::size_t, 10> kKeyOrder = {1, 2, 3, 4, 5, 6, 7, 8, 9, 0};

constexpr const char* kKeyLabelsStyle = R"(
#keyCap { background: palette(button); border: 1px solid palette(mid); border-radius: 4px; padding: 3px 0; }
)";

}  // namespace

KeyLabels::KeyLabels(QWidget* parent)
    : FoldingPart("marks",
                  "&Marks by key",
                  "Labels that the digit keys add to a running recording",
                  parent) {
  body()->setStyleSheet(kKeyLabelsStyle);
  fillGrid();
  sumUp();
}

void KeyLabels::fillGrid() {
  QWidget* made = body();
  auto* grid = new QGridLayout(made);
  grid->setContentsMargins(0, 2, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(5);
  grid->setColumnMinimumWidth(2, 12);
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(4, 1);
  const int keyWidth = 2 * fontMetrics().horizontalAdvance('0') + 12;
  QWidget* before = header();
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
    connect(field, &QLineEdit::textChanged, this, [this] { sumUp(); });
    const int column = place / kRows * 3;
    grid->addWidget(key, place % kRows, column);
    grid->addWidget(field, place % kRows, column + 1);
    setTabOrder(before, field);
    before = fields_[digit] = field;
    ++place;
  }
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

QString KeyLabels::summary() const {
  QStringList marks;
  const Labels all = labels();
  for (const std::size_t digit : kKeyOrder)
    if (!all[digit].isEmpty()) marks.append(QString::number(digit) + " " + all[digit]);
  return marks.isEmpty() ? "no labels" : marks.join(" · ");
}

}  // namespace palpate::gui
