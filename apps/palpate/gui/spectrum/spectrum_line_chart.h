// The line chart of the dock Spectrum: the mean spectrum of a signal with its peaks, or the
// coherence of two signals with the level that independent noise rarely exceeds.
#pragma once

#include <QString>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/chart/chart.h"
#include "gui/picture/exported_view.h"
#include "gui/spectrum/spectrum_chart.h"
#include "gui/spectrum/spectrum_worker.h"

namespace palpate::gui {

class SpectrumLineChart : public Chart {
  Q_OBJECT
 public:
  explicit SpectrumLineChart(QWidget* parent = nullptr);

  // `answer` has a mean spectrum or a coherence, with bins.
  void setAnswer(const SpectrumAnswer& answer);
  const SpectrumAnswer& answer() const noexcept { return answer_; }
  void setScale(SpectrumScale scale);
  // Marks a peak: its index in the table; -1: none.
  void setChosenPeak(int index);
  QString note() const { return note_->text(); }
  void paint(QPainter& painter, const PictureLook& look, const QString& title, const QString& name);

  // The values of the nearest bin.
  QString readingAt(const QPointF& at) const override;
  QSize sizeHint() const override { return {520, 240}; }
  QSize minimumSizeHint() const override { return {200, 150}; }

 protected:
  void style() override;
  void resized() override { writeNote(); }

 private:
  void fill();
  void writeNote();
  double binHz() const;
  std::size_t numBins() const;
  // The plotted value of a bin.
  double valueOf(std::size_t bin) const;
  std::vector<std::size_t> peakBins() const;

  SpectrumAnswer answer_;
  SpectrumScale scale_ = SpectrumScale::kDecibels;
  int chosen_ = -1;
  QCPGraph* peaks_;
  QCPGraph* chosenPeak_;
  QCPGraph* level_;
  QCPItemText* note_;
};

}  // namespace palpate::gui
