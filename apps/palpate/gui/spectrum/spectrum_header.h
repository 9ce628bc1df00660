// The title row of the dock Spectrum: the name of the signal, and the controls for the view, window
// length, overlap and scale.
#pragma once

#include <QWidget>

#include <palpate/signals/spectrum.h>

#include "gui/spectrum/spectrum_chart.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QSpinBox;

namespace palpate::gui {

// What the dock shows.
enum class SpectrumView {
  kMap,       // spectra over time
  kLine,      // the mean over time, with its peaks
  kCoherence  // coherence with another signal
};
inline constexpr std::array kAllSpectrumViews = {
    SpectrumView::kMap, SpectrumView::kLine, SpectrumView::kCoherence};
// The name of a view: "over time", "mean line", "coherence".
QString nameOf(SpectrumView view);

// What the window and the overlap of a view are until somebody changes them, as in `palpate
// spectrum`: SpectrumOptions over time, welchOptions() of a mean and of a coherence.
SpectrumOptions usualOptions(SpectrumView view);

// The choices of the title row.
struct SpectrumSetting {
  int window = SpectrumOptions{}.window;    // [samples] 2..65,536
  int overlap = SpectrumOptions{}.overlap;  // [samples] 0..window-1
  SpectrumScale scale = SpectrumScale::kDecibels;
  SpectrumView view = SpectrumView::kMap;
  bool fitsTimes = false;  // times of the sender's clock instead of those of arrival
  bool operator==(const SpectrumSetting&) const = default;
};

class SpectrumHeader : public QWidget {
  Q_OBJECT
 public:
  explicit SpectrumHeader(QWidget* parent = nullptr);
  void setSetting(const SpectrumSetting& setting);
  const SpectrumSetting& setting() const noexcept { return setting_; }
  void setName(const QString& name);
  // What is known of the sender's clock; empty: nothing.
  void setClock(const QString& clock);
  // The curves by formulas that can be chosen instead of the chosen taxels.
  void setFormulas(const QStringList& names);
  // The chosen one; empty: the chosen taxels.
  QString formula() const;

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
  QComboBox* signal_;
  QSpinBox* window_;
  QSpinBox* overlap_;
  QComboBox* scale_;
  QComboBox* view_;
  QCheckBox* times_;
};

}  // namespace palpate::gui
