#include "gui/record/folding_part.h"

#include <QLabel>
#include <QToolButton>

#include "gui/widgets/make.h"

namespace palpate::gui {

FoldingPart::FoldingPart(const QString& name,
                         const QString& title,
                         const QString& tip,
                         QWidget* parent)
    : QWidget(parent) {
  setStyleSheet("#" + name + "Header { padding: 4px 6px 4px 2px; }");
  header_ = makeToolButton(this, name + "Header", title, tip);
  header_->setCheckable(true);
  header_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  header_->setProperty("flat", true);
  header_->setFocusPolicy(Qt::StrongFocus);
  header_->setArrowType(Qt::RightArrow);
  summary_ = makeLabel(this, name + "Summary", "muted");
  summary_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  body_ = named(new QWidget(this), name + "Grid");
  body_->hide();
  setLayout(inColumn({inRow({header_, {summary_, 1}}), body_}, Space::kNarrow));
  connect(header_, &QToolButton::toggled, this, [this](bool open) {
    fold(open);
    // Updates the layout at once, so that parent widgets get the new height.
    layout()->activate();
    emit folded();
  });
}

bool FoldingPart::isOpen() const { return header_->isChecked(); }

QWidget* FoldingPart::header() const { return header_; }

void FoldingPart::fold(bool open) {
  header_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
  body_->setVisible(open);
  sumUp();
}

void FoldingPart::sumUp() {
  const QString text = summary();
  // When open, everything is visible.
  summary_->setText(
      isOpen() ? QString()
               : summary_->fontMetrics().elidedText(text, Qt::ElideRight, summary_->width()));
  summary_->setAccessibleName(text);
  summary_->setToolTip(isOpen() ? QString() : text);
}

void FoldingPart::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layout()->activate();
  sumUp();
}

}  // namespace palpate::gui
