// Where one controller of the hand is: a port to choose or to type, and below it what answered
// there.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QList>
#include <QWidget>

#include "gui/appearance/theme.h"
#include "gui/connect/port_scan.h"
#include "gui/widgets/state_mark.h"

namespace palpate::gui {

// What a field shows of its port.
struct PortFieldState {
  StateMark::State mark = StateMark::State::kNone;
  QString text;
};

class PortField : public QWidget {
  Q_OBJECT
 public:
  // `title` with the mnemonic of the field; `whenEmpty`: what goes without this controller.
  // `name`: the combo box is NAMEPort, the line of text NAMEAnswer, for tests.
  PortField(const QString& title,
            const QString& whenEmpty,
            const QString& name,
            Theme theme,
            QWidget* parent);

  ~PortField() override;

  QString port() const;  // as openChannel() takes it; empty: none
  void setPort(const QString& port);
  // The user has chosen or typed something: it is his.
  bool touched() const noexcept { return touched_; }
  // The choices, one detail line each; what stands in the field stays.
  void setChoices(const QList<ScannedPort>& ports);
  void setDetail(int choice, const QString& detail);
  void showState(const PortFieldState& state);
  QComboBox* box() { return box_; }

 signals:
  void changed();  // port() has
  void entered();  // the user is done with typing or has chosen

 private:
  QComboBox* box_;
  StateMark* mark_;
  QLabel* answer_;
  QString whenEmpty_;
  bool touched_ = false;
};

}  // namespace palpate::gui
