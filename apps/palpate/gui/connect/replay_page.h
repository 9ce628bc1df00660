// The page "Replay of a recording" of the Connect dialog: a recording that is played as if it came
// from a hand.
#pragma once

#include <QString>
#include <QStringList>
#include <QWidget>
#include <functional>

#include "gui/appearance/theme.h"

class QComboBox;
class QLabel;

namespace palpate::gui {

class StateMark;

class ReplayPage : public QWidget {
  Q_OBJECT
 public:
  // `recent`: paths, newest first.
  ReplayPage(const QStringList& recent, Theme theme, QWidget* parent);

  ~ReplayPage() override;

  void setRecording(const QString& path);
  QString recording() const;
  // Why it can't be replayed, one line; empty: it can, or none is chosen.
  QString problem() const;

  // Asks for a recording; empty: none. Tests hand in their own.
  std::function<QString()> askForRecording;

 signals:
  void changed();

 private:
  void refresh();

  QComboBox* path_;
  StateMark* mark_;
  QLabel* state_;
};

}  // namespace palpate::gui
