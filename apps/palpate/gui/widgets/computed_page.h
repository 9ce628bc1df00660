// A page of the dock Calibrate, or the dock Slip: something that is computed of a recording beside
// the window, only while the page is seen, with progress and a way to give it up; and what stands
// there when there is nothing to show.
#pragma once

#include <QWidget>
#include <functional>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/picture/exported_view.h"
#include "gui/source/background_job.h"
#include "gui/source/opened_recording.h"

class QStackedWidget;
class QVBoxLayout;

namespace palpate::gui {

class EmptyPage;
class OpeningStrip;

class ComputedPage : public QWidget {
  Q_OBJECT
 public:
  // `part`: the beginning of its parts' names.
  explicit ComputedPage(const QString& part, QWidget* parent = nullptr);

  // Null: none. `live`: what is connected is shown instead. As recorded, whatever filters show.
  void setSource(const OpenedRecordingPtr& recording, bool live);
  virtual void setTheme(Theme theme) = 0;
  virtual void setPosition(double /*seconds*/) {}
  // What is shown, to be taken away: only while shown().
  virtual std::vector<ExportedTable> tables() const = 0;
  virtual void paint(QPainter& painter, const PictureLook& look, const QString& title) = 0;

  const OpenedRecordingPtr& source() const noexcept { return recording_; }
  // Something was found, and it is seen.
  bool shown() const;
  QString emptyText() const;  // why nothing is; empty: something is
  bool busy() const { return job_.busy(); }
  // Gives up what is being computed; whether there was anything.
  bool cancel();
  // For tests and pictures: until what was asked for is there.
  void settle();

 signals:
  void said(const QString& text);

 protected:
  // Applies what was found; in the window's thread.
  using Take = std::function<void()>;
  using Work = std::function<Take(const Progress&)>;

  const OpenedRecordingPtr& recording() const noexcept { return recording_; }
  bool live() const noexcept { return live_; }
  // Rows above what is found; they are always there.
  QVBoxLayout& top() noexcept { return *top_; }
  void setContent(QWidget* content);
  QWidget* content() const noexcept { return content_; }

  // What is computed is of the recording that is shown; else of something that the page asks for
  // itself.
  virtual bool ofRecording() const { return true; }
  // Why there is nothing to ask about now; empty: there is. By default a recording with frames is
  // needed.
  virtual QString emptyReason() const;
  // Begins the work, by run().
  virtual void compute() = 0;
  // Another source came: forget the last one's results.
  virtual void forget() {}

  // What is asked for has changed: it is computed as soon as the page is seen.
  void renew();
  // Replaces what is at work. Cancelled and failures are dealt with.
  void run(const QString& text, Work work);
  void say(const QString& text, const QString& button = {});
  void showContent();

  void showEvent(QShowEvent* event) override;

 private:
  void ask();

  OpenedRecordingPtr recording_;
  bool live_ = false;
  bool stale_ = true;   // nothing was computed of what is asked for now
  int generation_ = 0;  // of the newest work
  BackgroundJob job_;
  QVBoxLayout* top_;
  OpeningStrip* strip_;
  QStackedWidget* pages_;
  EmptyPage* empty_;
  QWidget* content_ = nullptr;
};

}  // namespace palpate::gui
