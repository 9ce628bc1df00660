// The chart of the dock Spectrum: a signal over time, and below it its spectrogram with frequencies
// up to the Nyquist frequency. Notes name that frequency and other limits. Same cursor as the
// timeline; a click or drag seeks, the wheel zooms, a double click shows everything.
#pragma once

#include <QString>
#include <vector>

#include "gui/appearance/color_map.h"
#include "gui/appearance/theme.h"
#include "gui/chart/reading_chart.h"
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

class SpectrumChart : public ReadingChart {
  Q_OBJECT
 public:
  explicit SpectrumChart(QWidget* parent = nullptr);

  // `answer` has a spectrogram with at least one part.
  void setAnswer(const SpectrumAnswer& answer);
  const SpectrumAnswer& answer() const noexcept { return answer_; }
  void setScale(SpectrumScale scale);
  void setMap(ColorMapName map);
  void setTheme(Theme theme);
  void setVisibleRange(double fromS, double toS);
  void setPosition(double seconds);
  // The tool tip at a point.
  QString valuesAt(const QPointF& at) const;
  QString notes() const { return note_->text(); }
  // Paints the chart as a picture for export.
  void paint(QPainter& painter, const PictureLook& look, const QString& title, const QString& name);

  QSize sizeHint() const override { return {900, 280}; }
  QSize minimumSizeHint() const override { return {260, 180}; }

 signals:
  void seekRequested(double seconds);
  void zoomRequested(double seconds, double factor);
  void panRequested(double seconds);
  void fitRequested();
  // The space right of the time axis is another one now [px]; 0: the chart isn't visible.
  void rightChanged(int px);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  QString readingAt(const QPoint& at) const override { return valuesAt(at); }
  void restyle() override { style(); }

 private:
  void fillSignal();
  void fillSpectra();
  void style();
  void writeNotes();
  void nameAxes();
  void placeCursor();
  double secondsAt(double pixel) const { return xAxis->pixelToCoord(pixel); }

  SpectrumAnswer answer_;
  SpectrumScale scale_ = SpectrumScale::kDecibels;
  ColorMapName map_ = ColorMapName::kInferno;
  Theme theme_ = Theme::kDark;
  QCPAxisRect* spectra_;
  // Axes of the spectrogram.
  QCPAxis* time_;
  QCPAxis* frequency_;
  QCPColorScale* colors_;
  QCPItemText* note_;
  // One map for each part.
  std::vector<QCPColorMap*> maps_;
  QWidget* cursor_;
  double positionS_ = 0.0;
  bool seeking_ = false;
};

}  // namespace palpate::gui
