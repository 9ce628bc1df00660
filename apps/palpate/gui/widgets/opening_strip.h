// Progress of opening a recording (or writing one, or pictures), with a way to cancel it. It
// appears only when that takes long enough to be noticed.
#pragma once

#include <QTimer>
#include <QWidget>

class QLabel;
class QProgressBar;

namespace palpate::gui {

class OpeningStrip : public QWidget {
  Q_OBJECT
 public:
  // `verb` stands before the name; `part` begins the names of its parts.
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
