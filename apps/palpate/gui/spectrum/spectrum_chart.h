// The chart of the dock Spectrum: a signal over time, and below it its spectrogram with frequencies
// up to the Nyquist frequency. Notes name that frequency and other limits. Same cursor as the
// timeline; a click or drag seeks, the wheel zooms, a double click shows everything.
#pragma once

#include <QString>
#include <vector>

#include "gui/appearance/color_map.h"
#include "gui/chart/chart.h"
#include "gui/picture/exported_view.h"
#include "gui/spectrum/spectrum_worker.h"

namespace palpate::gui {

// The scale of the colours.
enum class SpectrumScale { kDecibels, kMagnitude };
inline constexpr std::array kAllSpectrumScales = {SpectrumScale::kDecibels,
                                                  SpectrumScale::kMagnitude};
// The name of a scale: "PSD in dB", "magnitude".
QString nameOf(SpectrumScale scale);

// Notes about the limits of the spectrum and the processing of the samples, in several lengths; the
// longest first.
std::vector<QString> spectrumNotes(const SpectrumReport& report, const SpectrumOptions& options);

class SpectrumChart : public Chart {
  Q_OBJECT
 public:
  explicit SpectrumChart(QWidget* parent = nullptr);

  // `answer` has a spectrogram with at least one part.
  void setAnswer(const SpectrumAnswer& answer);
  const SpectrumAnswer& answer() const noexcept { return answer_; }
  void setScale(SpectrumScale scale);
  void setMap(ColorMapName map);
  void setVisibleRange(double fromS, double toS) override;
  QString notes() const { return note_->text(); }
  // Paints the chart as a picture for export.
  void paint(QPainter& painter, const PictureLook& look, const QString& title, const QString& name);

  QString readingAt(const QPointF& at) const override;
  QSize sizeHint() const override { return {900, 280}; }
  QSize minimumSizeHint() const override { return {260, 180}; }

 signals:
  void zoomRequested(double seconds, double factor);
  void panRequested(double seconds);
  void fitRequested();
  // The space right of the time axis is another one now [px]; 0: the chart isn't visible.
  void rightChanged(int px);

 protected:
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void style() override;
  void resized() override { writeNotes(); }
  void panBy(double seconds) override { emit panRequested(seconds); }
  void zoomAbout(double seconds, double factor) override { emit zoomRequested(seconds, factor); }

 private:
  void fillSignal();
  void fillSpectra();
  void writeNotes();
  void nameAxes();

  SpectrumAnswer answer_;
  SpectrumScale scale_ = SpectrumScale::kDecibels;
  ColorMapName map_ = ColorMapName::kInferno;
  QCPAxisRect* spectra_;
  // Axes of the spectrogram.
  QCPAxis* time_;
  QCPAxis* frequency_;
  QCPColorScale* colors_;
  QCPItemText* note_;
  // One map for each part.
  std::vector<QCPColorMap*> maps_;
};

}  // namespace palpate::gui
