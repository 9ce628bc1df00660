// Logs once the time from the start of the process to the first paint of the window. It measures
// the figure in the README:
//   QT_LOGGING_RULES="palpate.startup.debug=true" palpate
#pragma once

#include <QObject>

class QWidget;

namespace palpate::gui {

class FirstPaint : public QObject {
  Q_OBJECT
 public:
  // Watches `window`, which must not have been shown yet.
  explicit FirstPaint(QWidget& window);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace palpate::gui
