// How slip is measured: method, where motion is measured from, thresholds. Remembered; a recording
// and what is live have a method each.
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
  // Motion is measured from this frame; nothing: as the box says.
  void setReferenceFrame(std::optional<std::size_t> frame);
  // Whether there is something whose reference can be set.
  void setReferenceEnabled(bool enabled);

 signals:
  void changed();
  void referenceAsked();  // the frame that is shown

 private:
  QDoubleSpinBox* field(const char* name,
                        const QString& label,
                        const char* key,
                        double most,
                        double step,
                        int decimals,
                        double usual);
  void remember();
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
