#include "gui/widgets/computed_page.h"

#include <QStackedWidget>
#include <QVBoxLayout>

#include "gui/widgets/empty_page.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/make.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {

ComputedPage::ComputedPage(const QString& part, QWidget* parent) : QWidget(parent) {
  setObjectName(part + "Page");
  strip_ = new OpeningStrip(this, "Computing", part);
  pages_ = new FittingPages(this);
  // What was computed may need a wider dock than the text before it.
  pages_->setObjectName(kDockPages);
  empty_ = new EmptyPage(part, pages_);
  pages_->addWidget(empty_);
  top_ = new QVBoxLayout;
  top_->setContentsMargins(12, 8, 12, 8);
  top_->setSpacing(6);
  setLayout(inColumn({top_, strip_, {pages_, 1}}, Space::kNone));
  connect(&computing_, &Abandonable::progressed, strip_, &OpeningStrip::setProgress);
  connect(&computing_, &Abandonable::finished, strip_, &OpeningStrip::end);
  connect(strip_, &OpeningStrip::cancelRequested, this, &ComputedPage::cancel);
  connect(empty_, &EmptyPage::buttonClicked, this, &ComputedPage::renew);
}

void ComputedPage::setContent(QWidget* content) {
  content_ = content;
  pages_->addWidget(content);
}

void ComputedPage::setSource(const OpenedRecordingPtr& recording, bool live) {
  const OpenedRecordingPtr source = live ? nullptr : recording;
  if (source == recording_ && live == live_ && !stale_) return;
  if (source != recording_ || live != live_) {
    recording_ = source;
    live_ = live;
    if (ofRecording()) forget();
  }
  if (ofRecording()) renew();
}

void ComputedPage::setMeasured(const OpenedRecordingPtr& measured) {
  if (measured == measured_) return;
  measured_ = measured;
  if (!live_) return;
  forget();
  renew();
}

QString ComputedPage::emptyReason() const {
  if (live_ && !measured_) return liveReason();
  if (!recording()) return "Open a recording first.";
  if (recording()->profile.numFrames() == 0) return "This recording has no frames.";
  return {};
}

QString ComputedPage::liveReason() const {
  return "This works with recordings only. Record the connected hand (Ctrl+R), then open the "
         "recording.";
}

void ComputedPage::renew() {
  stale_ = true;
  computing_.abandon();
  ask();
}

void ComputedPage::ask() {
  if (!stale_ || !isVisible()) return;
  stale_ = false;
  const QString why = emptyReason();
  if (!why.isEmpty()) return say(why);
  say("");
  compute();
}

void ComputedPage::run(const QString& text, Work work) {
  strip_->begin(text);
  computing_.ask(std::move(work));
}

bool ComputedPage::cancel() {
  if (!busy()) return false;
  computing_.abandon();
  say("Cancelled.", "Compute");
  emit said("computing was cancelled");
  return true;
}

void ComputedPage::settle() {
  ask();
  computing_.settle();
}

void ComputedPage::say(const QString& text, const QString& button) {
  empty_->say(text, button);
  pages_->setCurrentWidget(empty_);
}

void ComputedPage::showContent() { pages_->setCurrentWidget(content_); }

QString ComputedPage::emptyText() const {
  return pages_->currentWidget() == empty_ ? empty_->text() : QString();
}

bool ComputedPage::shown() const { return isVisible() && pages_->currentWidget() == content_; }

void ComputedPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ask();
}

}  // namespace palpate::gui
