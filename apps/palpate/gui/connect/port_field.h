// A field of the page "Hand on ports" for one controller of the hand: a port to choose or type, and
// below it what answered at that port.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QList>
#include <QWidget>

#include "gui/appearance/theme.h"
#include "gui/connect/port_scan.h"
#include "gui/widgets/state_mark.h"

namespace palpate::gui {

// What a field shows about its port.
struct PortFieldState {
  StateMark::State mark = StateMark::State::kNone;
  QString text;
};

class PortField : public QWidget {
  Q_OBJECT
 public:
  // `title` contains the mnemonic of the field; `whenEmpty` tells what works without this
  // controller. `name` gives the object names for tests: the combo box is NAMEPort, the line of
  // text NAMEAnswer.
  PortField(const QString& title, const QString& whenEmpty, const QString& name, QWidget* parent);

  ~PortField() override;

  // The port in the form that openChannel() takes; empty when none is chosen.
  QString port() const;
  void setPort(const QString& port);
  // The user has chosen or typed a port, which must not be overwritten.
  bool touched() const noexcept { return touched_; }
  // Sets the choices, each with one line of details; the text in the field does not change.
  void setChoices(const QList<ScannedPort>& ports);
  void setDetail(int choice, const QString& detail);
  void showState(const PortFieldState& state);
  QComboBox* box() { return box_; }

 signals:
  // port() has changed.
  void changed();
  // The user has finished typing, pauses in it, or has chosen a port.
  void entered();

 private:
  QComboBox* box_;
  StateMark* mark_;
  QLabel* answer_;
  QString whenEmpty_;
  bool touched_ = false;
};

}  // namespace palpate::gui
