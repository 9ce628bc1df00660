// The controls of the dock Slip for the measurement: method, reference and thresholds. They are
// stored in the settings; recordings and live sources have separate methods.
#pragma once

#include <QSettings>
#include <QWidget>
#include <optional>

#include <palpate/slip/slip_series.h>

class QComboBox;
class QDoubleSpinBox;
class QPushButton;

namespace palpate::gui {

class SlipControls : public QWidget {
  Q_OBJECT
 public:
  explicit SlipControls(QSettings& settings, QWidget* parent = nullptr);

  SlipSeriesOptions options() const;
  void setLive(bool live);
  // Motion is measured from this frame; nothing: from the reference chosen in the box.
  void setReferenceFrame(std::optional<std::size_t> frame);
  // Whether a reference can be set now.
  void setReferenceEnabled(bool enabled);

 signals:
  void changed();
  // The user wants the shown frame as reference.
  void referenceRequested();

 private:
  QDoubleSpinBox* field(const char* name,
                        const QString& label,
                        const char* key,
                        double most,
                        double step,
                        int decimals,
                        double usual);
  void remember();
  void showLimits();
  void showReference();

  QSettings& settings_;
  bool live_ = false;
  std::optional<std::size_t> frame_;
  QComboBox* method_;
  QComboBox* reference_;
  QPushButton* set_;
  QDoubleSpinBox* step_;
  QDoubleSpinBox* whole_;
  QDoubleSpinBox* rotation_;
};

}  // namespace palpate::gui
