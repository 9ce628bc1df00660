// The title row of the dock Spectrum: the name of the signal, and the controls for window length,
// overlap and scale.
#pragma once

#include <QWidget>

#include "gui/spectrum/spectrum_chart.h"

class QComboBox;
class QLabel;
class QSpinBox;

namespace palpate::gui {

// The choices of the title row.
struct SpectrumSetting {
  int window = 32;   // [samples] 2..65,536
  int overlap = 31;  // [samples] 0..window-1
  SpectrumScale scale = SpectrumScale::kDecibels;
  bool operator==(const SpectrumSetting&) const = default;
};

class SpectrumHeader : public QWidget {
  Q_OBJECT
 public:
  explicit SpectrumHeader(QWidget* parent = nullptr);
  void setSetting(const SpectrumSetting& setting);
  const SpectrumSetting& setting() const noexcept { return setting_; }
  void setName(const QString& name);

 signals:
  void changed();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void take(SpectrumSetting setting);
  void show(const SpectrumSetting& setting);
  void elide();

  SpectrumSetting setting_;
  QString whole_;
  QLabel* name_;
  QSpinBox* window_;
  QSpinBox* overlap_;
  QComboBox* scale_;
};

}  // namespace palpate::gui
