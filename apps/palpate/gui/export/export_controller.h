// Exports what the views show: asks for the form, writes files in the background, repeats the last
// export, and copies to the clipboard. Each feature registers its views here.
#pragma once

#include <QByteArray>
#include <QImage>
#include <QObject>
#include <QPointer>
#include <QSettings>
#include <QString>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "gui/export/export_request.h"
#include "gui/export/export_work.h"
#include "gui/picture/exported_view.h"
#include "gui/source/background_job.h"
#include "gui/source/latest_answer.h"

namespace palpate::gui {

class Ask;

class ExportController : public QObject {
  Q_OBJECT
 public:
  // `window` is the parent of the dialogs, in which `places` asks for folders. All must outlive
  // this.
  ExportController(QSettings& settings, Ask& places, QWidget* window);

  // Registers a view. The first one is the default when the user has not clicked into another.
  void add(ExportedView view);
  // Adds the views that are visible together as one more; called after all others were added.
  void addTogether();
  // The views that have something to show now.
  std::vector<const ExportedView*> present() const;
  bool anything() const { return !present().empty(); }
  // The view that was clicked into last or has the keyboard focus; else the first that has
  // something to show; null when none has.
  const ExportedView* active() const;

  // Asks what to export and where to.
  void exportNow();
  // Repeats the last export under the next free name; asks when there was no export before.
  void repeatLast();
  // Copy the active view: its picture, and for a chart or a table also its rows as text.
  void copyPicture();
  void copyTable();
  void write(const ExportRequest& request);
  // Cancels everything that is being written or copied.
  void cancel();
  bool busy() const noexcept { return job_.busy() || copying_.busy(); }
  // Waits until all is written and copied, with events.
  void settle();

  // Asks the user for a request; returns nothing when cancelled. Tests replace it.
  std::function<std::optional<ExportRequest>(const ExportRequest& suggestion)> ask;
  // The recording that the views show; empty: none. It is set once.
  std::function<QString()> source;
  // The request that the dialog would start with now.
  ExportRequest suggestion() const;

 signals:
  void started(const QString& what);
  // `fraction`: 0..1.
  void progressed(double fraction);
  // Everything is written.
  void finished();
  // A short message for the status line.
  void said(const QString& text);
  void failed(const QString& message);
  void written(const QString& path);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Copy {
    QString what;
    QImage image = {};
    std::optional<TextTable> table = {};
    // The rows of the table as text.
    QString tabbed = {};
    QByteArray csv = {};
  };
  const ExportedView* viewNamed(const QString& name) const;
  void touch(const QWidget* widget);
  static Copy withText(const Copy& asked, const Progress& progress);
  void toClipboard(const Copy& copy);
  void conclude(const ExportReport& report);

  QSettings& settings_;
  QWidget* window_;
  std::vector<ExportedView> views_;
  // The name of the view that was used last.
  QString touched_;
  // A view was used since the last export. Until then the view of that export is suggested.
  bool isTouchedSinceExport_ = false;
  LatestAnswer<Copy, Copy> copying_;
  // Is waited for at the end: no incomplete file remains.
  BackgroundJob job_;
};

}  // namespace palpate::gui
