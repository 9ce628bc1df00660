// A signal over time, and below it its spectra: time to the right, frequency upwards to Nyquist's,
// which is named with all that can't be seen. Same cursor as the timeline; a click or drag seeks,
// the wheel zooms, a double click shows everything.
#pragma once

#include <QString>
#include <vector>

#include "gui/appearance/color_map.h"
#include "gui/appearance/theme.h"
#include "gui/chart/plot.h"
#include "gui/picture/exported_view.h"
#include "gui/spectrum/spectrum_worker.h"

namespace palpate::gui {

enum class SpectrumScale { kDecibels, kMagnitude };
inline constexpr std::array kAllSpectrumScales = {SpectrumScale::kDecibels,
                                                  SpectrumScale::kMagnitude};
QString nameOf(SpectrumScale scale);  // "PSD in dB", "magnitude"

// What can't be seen, and what was done to the samples; the first of several lengths is the
// longest.
std::vector<QString> spectrumNotes(const SpectrumReport& report, const SpectrumOptions& options);

class SpectrumChart : public QCustomPlot {
  Q_OBJECT
 public:
  explicit SpectrumChart(QWidget* parent = nullptr);

  void setAnswer(const SpectrumAnswer& answer);  // with a spectrogram that has a part
  const SpectrumAnswer& answer() const noexcept { return answer_; }
  void setScale(SpectrumScale scale);
  void setMap(ColorMapName map);
  void setTheme(Theme theme);
  void setVisibleRange(double fromS, double toS);
  void setPosition(double seconds);
  // What the mouse is told at a place.
  QString valuesAt(const QPointF& at) const;
  QString notes() const { return note_->text(); }
  // As a picture of its own.
  void paint(QPainter& painter, const PictureLook& look, const QString& title, const QString& name);

  QSize sizeHint() const override { return {900, 280}; }
  QSize minimumSizeHint() const override { return {260, 180}; }

 signals:
  void seekRequested(double seconds);
  void zoomRequested(double seconds, double factor);
  void panAsked(double seconds);
  void fitAsked();

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

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
  QCPAxis* time_;       // of the spectra
  QCPAxis* frequency_;  // likewise
  QCPColorScale* colors_;
  QCPItemText* note_;
  std::vector<QCPColorMap*> maps_;  // one per part
  QWidget* cursor_;
  double positionS_ = 0.0;
  bool seeking_ = false;
};

}  // namespace palpate::gui
