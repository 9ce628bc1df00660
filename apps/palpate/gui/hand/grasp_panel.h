// What the hand shall do: preshape, how far, how fast, how hard; and the buttons that begin it.
#pragma once

#include <QSettings>
#include <QWidget>

#include <palpate/control/grasp_control.h>

class QComboBox;
class QLabel;
class QPushButton;

namespace palpate::gui {

class ValueSlider;

class GraspPanel : public QWidget {
  Q_OBJECT
 public:
  // Remembers what was chosen in `settings`, which must outlive it.
  GraspPanel(QSettings& settings, QWidget* parent);
  // Null: no hand. Must outlive this, or be taken away before.
  void setControl(GraspControl* control);
  // What may be begun now, and why not.
  void showStatus(const GraspStatus& status);
  GraspRequest request(GraspMode mode) const;
  // As they stand: Grasp, Reactive, Slip-aware, Open, Relax.
  QList<QPushButton*> buttons() const { return {grasp_, reactive_, slipAware_, open_, relax_}; }

 signals:
  void begins();  // something is asked for now
  void refused(const QString& why);
  void asked();  // something was begun, or refused

 private:
  void begin(const GraspRequest& request);
  void remember();

  QSettings& settings_;
  GraspControl* control_ = nullptr;
  QComboBox* preshape_;
  ValueSlider* close_;
  ValueSlider* velocity_;
  ValueSlider* limit_;
  QPushButton* open_;
  QPushButton* grasp_;
  QPushButton* reactive_;
  QPushButton* slipAware_;
  QPushButton* relax_;
};

}  // namespace palpate::gui
