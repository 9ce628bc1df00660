// Writes the labels of the displayed recording into a CSV table, and adds those of such a table to
// it; what was added can be undone.
#pragma once

#include <QObject>
#include <QPointer>
#include <QString>

#include <palpate/recording/label_table.h>

#include "gui/source/event_editor.h"
#include "gui/source/file_reading.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class LabelExchange : public QObject {
  Q_OBJECT
 public:
  // All arguments must outlive this object.
  LabelExchange(WindowState& windowState, QObject* parent);

  void exportLabels();
  void importLabels();

 private:
  void take(const LabelTable& table, const QString& path, EventEditor& editor);
  void fail(const QString& message, EventEditor* in, bool added);
  void withdrawWhenUndone();

  WindowState& windowState_;
  // The events that the shown failure of an import is about, and the place in their undo stack
  // behind the import.
  bool failed_ = false;
  QPointer<EventEditor> failedIn_;
  int failedAt_ = 0;
  FileReading reading_{this};
};

}  // namespace palpate::gui
