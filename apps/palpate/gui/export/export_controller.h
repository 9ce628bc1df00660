// Takes what is seen away: asks how, writes it beside the window, repeats it, puts it on the
// clipboard. Views are registered by whoever shows them.
#pragma once

#include <QObject>
#include <QPointer>
#include <QSettings>
#include <QString>
#include <QThreadPool>
#include <QWidget>
#include <atomic>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "gui/export/export_request.h"
#include "gui/export/export_work.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

class ExportController : public QObject {
  Q_OBJECT
 public:
  // `window`: over which dialogs stand. Both must outlive this.
  ExportController(QSettings& settings, QWidget* window);
  // Cancels what is being written, and waits: no half file is left.
  ~ExportController() override;

  // The first one is what is taken when no other has been touched.
  void add(ExportedView view);
  // Those that have something to show now.
  std::vector<const ExportedView*> present() const;
  bool anything() const { return !present().empty(); }
  // The view that was clicked into last, or has the keyboard; the first that is there; null: none
  // is.
  const ExportedView* active() const;

  void exportNow();  // asks what and where
  void
  repeatLast();  // as last time, under the next name that is free; asks when there was no last time
  // The active view: its picture, and where it is a chart or table its rows as text.
  void copyPicture();
  void copyTable();
  void write(const ExportRequest& request);
  void cancel();  // everything that is being written
  bool busy() const noexcept { return !waiting_.empty(); }
  void waitForDone();

  // Nothing: cancelled. Tests answer themselves.
  std::function<std::optional<ExportRequest>(const ExportRequest& suggestion)> ask;
  // What would be suggested now.
  ExportRequest suggestion() const;

 signals:
  void started(const QString& what);
  void progressed(double fraction);  // 0..1
  void finished();                   // nothing is being written any more
  void said(const QString& text);    // in passing
  void failed(const QString& message);
  void written(const QString& path);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Job {
    QString what;
    ExportWork work;
  };
  const ExportedView* viewNamed(const QString& name) const;
  void touch(const QWidget* widget);
  void startNext();
  void conclude(const ExportReport& report);

  QSettings& settings_;
  QWidget* window_;
  std::vector<ExportedView> views_;
  QString touched_;          // name of the view
  std::deque<Job> waiting_;  // the first one is at work
  std::atomic<bool> cancelled_ = false;
  QThreadPool worker_;
};

}  // namespace palpate::gui
