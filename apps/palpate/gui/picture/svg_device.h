// A paint device that writes what a QPainter draws as an SVG: lines stay lines, text stays text.
// Unlike QSvgGenerator it supports clipping (the curves of a chart end at its axes) and real sizes
// (millimetres on paper).
#pragma once

#include <QByteArray>
#include <QPaintDevice>
#include <QSizeF>
#include <QString>
#include <memory>

namespace palpate::gui {

class SvgEngine;

class SvgDevice : public QPaintDevice {
 public:
  // `size` is in units of the painter, of which `unitsPerInch` are an inch. Fonts are best given in
  // pixels (units).
  SvgDevice(const QSizeF& size, double unitsPerInch);
  ~SvgDevice() override;

  void setTitle(const QString& title, const QString& description);
  // The complete document; call it after the painter has ended.
  QByteArray bytes() const;

  QPaintEngine* paintEngine() const override;

 protected:
  int metric(PaintDeviceMetric metric) const override;

 private:
  QSizeF size_;
  double unitsPerInch_;
  QString title_;
  QString description_;
  std::unique_ptr<SvgEngine> engine_;
};

}  // namespace palpate::gui
