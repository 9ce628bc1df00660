#include "gui/widgets/empty_page.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "gui/widgets/make.h"

namespace palpate::gui {

EmptyPage::EmptyPage(const QString& part, QWidget* parent) : QWidget(parent) {
  text_ = makeLines(this, part + "Empty", "muted");
  text_->setAlignment(Qt::AlignCenter);
  button_ = makeButton(this, part + "EmptyButton", {});
  // Enter presses the button.
  button_->setAutoDefault(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(24, 24, 24, 24);
  column->setSpacing(12);
  column->addStretch(2);
  column->addWidget(text_);
  column->addWidget(button_, 0, Qt::AlignHCenter);
  column->addStretch(3);
  connect(button_, &QPushButton::clicked, this, &EmptyPage::buttonClicked);
}

void EmptyPage::say(const QString& text, const QString& button) {
  text_->setText(text);
  button_->setText(button);
  button_->setVisible(!button.isEmpty());
}

QString EmptyPage::text() const { return text_->text(); }

}  // namespace palpate::gui
