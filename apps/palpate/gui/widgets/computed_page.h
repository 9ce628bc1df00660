// Base class of pages whose content is computed from a recording in the background (dock Calibrate,
// dock Slip). The computation runs only while the page is visible, with progress and cancel; when
// there is nothing to show, the page tells why.
#pragma once

#include <QWidget>
#include <functional>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/picture/exported_view.h"
#include "gui/source/latest_answer.h"
#include "gui/source/opened_recording.h"

class QStackedWidget;
class QVBoxLayout;

namespace palpate::gui {

class EmptyPage;
class OpeningStrip;

class ComputedPage : public QWidget {
  Q_OBJECT
 public:
  // `part`: prefix of the object names of its widgets.
  explicit ComputedPage(const QString& part, QWidget* parent = nullptr);

  // Sets the recording to compute from, as recorded, without filters; null: none. `live`: the
  // window shows a live source instead.
  void setSource(const OpenedRecordingPtr& recording, bool live);
  // Sets what was measured of the connected hand, from which the page computes while the window
  // shows a live source; null: nothing.
  void setMeasured(const OpenedRecordingPtr& measured);
  virtual void setPosition(double /*seconds*/) {}
  // The displayed results for export; call both only while shown().
  virtual std::vector<ExportedTable> tables() const = 0;
  virtual void paint(QPainter& painter, const PictureLook& look, const QString& title) = 0;

  const OpenedRecordingPtr& source() const noexcept { return recording_; }
  // Whether there is a result and it is visible.
  bool shown() const;
  // Why nothing is shown; empty: there is a result.
  QString emptyText() const;
  bool busy() const { return computing_.busy(); }
  // Cancels the computation; returns whether one was running.
  bool cancel();
  // Waits until the result exists; for tests and pictures.
  void settle();

 signals:
  void said(const QString& text);

 protected:
  // Applies the result; called in the thread of the window.
  using Take = std::function<void()>;
  // Runs in another thread: it uses nothing of the page.
  using Work = std::function<Take(const Progress&)>;

  // The recording to compute from or, while the source is live, what was measured of it.
  const OpenedRecordingPtr& recording() const noexcept { return live_ ? measured_ : recording_; }
  bool live() const noexcept { return live_; }
  // Layout of the rows above the result, which are always visible.
  QVBoxLayout& top() noexcept { return *top_; }
  void setContent(QWidget* content);
  QWidget* content() const noexcept { return content_; }

  // True: the result is computed from the displayed recording; false: from something that the page
  // itself asks for.
  virtual bool ofRecording() const { return true; }
  // Why nothing can be computed now; empty: it can. By default a recording with frames is needed.
  virtual QString emptyReason() const;
  // The same for a live source of which nothing was measured.
  virtual QString liveReason() const;
  // Starts the computation by calling run().
  virtual void compute() = 0;
  // Called when the source has changed: drops the results of the previous one.
  virtual void forget() {}

  // To be called when the inputs have changed: computes anew as soon as the page is visible.
  void renew();
  // Starts `work` in place of the running one. Handles Cancelled and failures.
  void run(const QString& text, Work work);
  void say(const QString& text, const QString& button = {});
  void showContent();

  void showEvent(QShowEvent* event) override;

 private:
  void ask();

  OpenedRecordingPtr recording_;
  OpenedRecordingPtr measured_;
  bool live_ = false;
  // Nothing has been computed from the present inputs yet.
  bool stale_ = true;
  LatestAnswer<Work, Take> computing_{
      [](const Work& work, const Progress& progress, const auto&) { return work(progress); },
      [](const Take& take) {
        if (take) take();
      },
      [this](const QString& message) { say(message, "Try again"); }};
  QVBoxLayout* top_;
  OpeningStrip* strip_;
  QStackedWidget* pages_;
  EmptyPage* empty_;
  QWidget* content_ = nullptr;
};

}  // namespace palpate::gui
