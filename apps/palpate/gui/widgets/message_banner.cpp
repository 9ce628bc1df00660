#include "gui/widgets/message_banner.h"

#include <QAccessible>
#include <QEvent>
#include <QLabel>
#include <QToolButton>

#include "gui/appearance/icons.h"
#include "gui/widgets/long_word_label.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr qsizetype kMessageBannerMostLines = 4;

}  // namespace

MessageBanner::MessageBanner(QWidget* parent, const QString& name, const QString& part)
    : QWidget(parent) {
  setObjectName(name);
  setAttribute(Qt::WA_StyledBackground);
  text_ = named(new LongWordLabel(this), part + "Text");
  text_->installEventFilter(this);
  auto* close = named(new QToolButton(this), part + "Close", "Close this message (Esc)");
  close->setProperty("flat", true);
  close->setIcon(makeIcon(IconShape::kClose));
  close->setIconSize({12, 12});
  close->setFocusPolicy(Qt::NoFocus);
  connect(close, &QToolButton::clicked, this, &MessageBanner::dismiss);
  setLayout(inRow({{text_, 1}, {close, 0, Qt::AlignTop}},
                  {.left = Space::kWide,
                   .top = Space::kUsual,
                   .right = Space::kUsual,
                   .bottom = Space::kUsual}));
  hide();
}

void MessageBanner::showAbout(const QString& topic, const QString& message) {
  lines_.removeIf([&](const Line& line) { return line.text == message; });
  lines_.append({topic, message});
  lines_ = lines_.mid(std::max<qsizetype>(0, lines_.size() - kMessageBannerMostLines));
  showLines();
  QAccessibleEvent alert(this, QAccessible::Alert);
  QAccessible::updateAccessibility(&alert);
  emit said(message);
}

void MessageBanner::withdraw(const QString& topic) {
  lines_.removeIf([&](const Line& line) { return line.topic == topic; });
  showLines();
}

void MessageBanner::showAll(const QStringList& messages) {
  lines_.clear();
  for (const QString& message : messages) lines_.append({{}, message});
  showLines();
}

void MessageBanner::dismiss() {
  lines_.clear();
  showLines();
}

void MessageBanner::showLines() {
  QStringList texts;
  for (const Line& line : lines_) texts.append(line.text);
  text_->setText(texts.join('\n'));
  setVisible(!texts.isEmpty());
  setAccessibleName(text_->text());
  askForHeight();
}

void MessageBanner::askForHeight() {
  if (isHidden()) return;
  // The height for a width is never below the least height.
  text_->setMinimumHeight(0);
  text_->setMinimumHeight(text_->heightForWidth(text_->width()));
}

bool MessageBanner::eventFilter(QObject* watched, QEvent* event) {
  if (watched == text_ && (event->type() == QEvent::Resize || event->type() == QEvent::FontChange))
    askForHeight();
  return QWidget::eventFilter(watched, event);
}

QString MessageBanner::message() const { return text_->text(); }

}  // namespace palpate::gui
