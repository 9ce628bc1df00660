// Progress of opening a recording, with a way to cancel it. It appears only when opening takes long
// enough to be noticed.
#pragma once

#include <QTimer>
#include <QWidget>

class QLabel;
class QProgressBar;

namespace palpate::gui {

class OpeningStrip : public QWidget {
  Q_OBJECT
 public:
  explicit OpeningStrip(QWidget* parent = nullptr);
  void begin(const QString& path);
  void setProgress(double fraction);
  void end();

 signals:
  void cancelRequested();

 private:
  QLabel* name_;
  QProgressBar* bar_;
  QTimer appear_;
};

}  // namespace palpate::gui
