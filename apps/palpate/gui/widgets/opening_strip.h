// Shows the progress of opening a recording (or writing one, or pictures), with a button to cancel
// it. It appears only when the work takes long enough to be noticed.
#pragma once

#include <QTimer>
#include <QWidget>

class QLabel;
class QProgressBar;

namespace palpate::gui {

class OpeningStrip : public QWidget {
  Q_OBJECT
 public:
  // `verb` is shown before the file name; `part`: prefix of the object names of its widgets.
  explicit OpeningStrip(QWidget* parent = nullptr,
                        const QString& verb = "Opening",
                        const QString& part = "opening");
  void begin(const QString& path);
  void setProgress(double fraction);
  void end();

 signals:
  void cancelRequested();

 private:
  QString verb_;
  QLabel* name_;
  QProgressBar* bar_;
  QTimer appear_;
};

}  // namespace palpate::gui
