// The page "Replay of a recording" of the Connect dialog: the user chooses a recording that is
// replayed as if it came from a hand.
#pragma once

#include <QString>
#include <QStringList>
#include <QWidget>

#include "gui/appearance/theme.h"

class QComboBox;
class QLabel;

namespace palpate::gui {

class Ask;
class StateMark;

class ReplayPage : public QWidget {
  Q_OBJECT
 public:
  // `recent`: paths, newest first.
  ReplayPage(const QStringList& recent, Ask& ask, QWidget* parent);

  ~ReplayPage() override;

  void setRecording(const QString& path);
  QString recording() const;
  // Why the recording cannot be replayed, in one line; empty when it can, or when none is chosen.
  QString problem() const;

 signals:
  void changed();

 private:
  void refresh();

  QComboBox* path_;
  StateMark* mark_;
  QLabel* state_;
};

}  // namespace palpate::gui
