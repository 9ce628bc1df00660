#include "gui/shell/hand_chip.h"

#include <QAction>
#include <QToolTip>
#include <algorithm>
#include <utility>

#include "gui/appearance/condition_color.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kHandChipPadding = 8;  // [px] on either side
constexpr int kHandChipHeight = 22;  // [px]
constexpr int kSentenceMs = 15'000;  // for which a click shows it

QString conditionWord(HandCondition condition) {
  const std::string_view name = nameOf(condition);
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
}

}  // namespace

HandChip::HandChip(QAction& acknowledge, QWidget* parent)
    : QPushButton(parent), acknowledge_(acknowledge) {
  setObjectName("handChip");
  setFocusPolicy(Qt::NoFocus);  // its action is in the menu Hand
  setMinimumHeight(kHandChipHeight);
  fitToText(*this, [this] { fit(); });
  connect(this, &QPushButton::clicked, this, [this] {
    QToolTip::showText(mapToGlobal(rect().bottomLeft()), sentence_, this, rect(), kSentenceMs);
    acknowledge_.trigger();
  });
  connect(&acknowledge_, &QAction::changed, this, &HandChip::explain);
  fitToTheme(*this, [this] { style(); });
}

void HandChip::fit() {
  int widest = 0;
  for (const HandCondition each : kAllHandConditions)
    widest = std::max(widest, fontMetrics().horizontalAdvance(conditionWord(each)));
  constexpr int kBorder = 1;
  setFixedWidth(narrow_ ? kHandChipHeight : widest + 2 * (kHandChipPadding + kBorder));
}

void HandChip::setNarrow(bool on) {
  if (narrow_ == on) return;
  narrow_ = on;
  setText(on ? QString() : word_);
  fit();
  style();
}

void HandChip::setCondition(const ExplainedCondition& condition, const HandTask& task) {
  HandCondition shown = condition.condition;
  const bool danger = shown == HandCondition::kNotProtected || shown == HandCondition::kGone;
  const QString word = conditionWord(shown);
  word_ = task.word.isEmpty() || danger ? word : task.word;
  if (!narrow_ && text() != word_) setText(word_);
  if (accessibleName() != word_) setAccessibleName(word_);
  sentence_ = "The hand is " + word + ": " + QString::fromStdString(condition.sentence) + ".";
  if (!task.word.isEmpty()) sentence_ = task.sentence + ". Stop (Esc) ends it.\n" + sentence_;
  explain();
  // The next motion begins by itself.
  if (!task.word.isEmpty() && (shown == HandCondition::kReady || shown == HandCondition::kRelaxed))
    shown = HandCondition::kMoving;
  if (std::exchange(condition_, shown) != shown) style();
}

void HandChip::explain() {
  const QString tip = acknowledge_.isEnabled() ? sentence_ + "\nClick to acknowledge." : sentence_;
  if (toolTip() != tip) setToolTip(tip);
}

// What needs attention is filled, and what has no word.
void HandChip::style() {
  const QColor color = conditionColor(condition_);
  const bool filled =
      narrow_ || condition_ == HandCondition::kNotProtected || condition_ == HandCondition::kGone;
  const ThemeColors& colors = colorsOf();
  setStyleSheet(QString("#handChip { color: %1; background: %2; border: 1px solid %3; "
                        "border-radius: 10px; padding: 2px %4px; }")
                    .arg((filled ? colors.window : color).name(),
                         (filled ? color : colors.panel).name(),
                         color.name())
                    .arg(kHandChipPadding));
}

}  // namespace palpate::gui
