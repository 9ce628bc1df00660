#include "gui/picture/svg_device.h"

#include <QBuffer>
#include <QImage>
#include <QPaintEngine>
#include <QPainter>
#include <QPainterPath>
#include <QPixmap>
#include <climits>
#include <cmath>
#include <string>

#include <palpate/core/number_text.h>

namespace palpate::gui {
namespace {

constexpr int kDepth = 24;  // [bits per colour]
constexpr double kSvgDeviceMmPerInch = 25.4;
constexpr double kSvgDevicePointsPerInch = 72.0;

// Rounds to a thousandth of a unit, which is finer than any printer.
std::string svgDeviceText(double value) {
  constexpr double kParts = 1000.0;
  std::string out;
  appendNumber(out, std::round(value * kParts) / kParts + 0.0);
  return out;
}

std::string pair(const QPointF& point) {
  return svgDeviceText(point.x()) + "," + svgDeviceText(point.y());
}

std::string escaped(const QString& plain) {
  // Control characters, which XML doesn't allow, would make the file unreadable.
  QString kept;
  for (const QChar letter : plain)
    if (letter >= QChar(' ') || letter == '\t') kept += letter;
  return kept.toHtmlEscaped().toStdString();
}

std::string pathData(const QPainterPath& path) {
  std::string data;
  for (int i = 0; i < path.elementCount(); ++i) {
    const QPainterPath::Element& element = path.elementAt(i);
    switch (element.type) {
      case QPainterPath::MoveToElement:
        data += 'M';
        break;
      case QPainterPath::LineToElement:
        data += 'L';
        break;
      case QPainterPath::CurveToElement:
        data += 'C';
        break;
      case QPainterPath::CurveToDataElement:
        data += ' ';
        break;
    }
    data += pair(element);
  }
  return data;
}

std::string svgDeviceColorOf(const char* what, const QColor& color) {
  std::string out = " " + std::string(what) + "=\"" + color.name().toStdString() + '"';
  if (color.alpha() < 255)
    out += " " + std::string(what) + "-opacity=\"" + svgDeviceText(color.alphaF()) + '"';
  return out;
}

std::string strokeOf(const QPen& pen) {
  if (pen.style() == Qt::NoPen) return " stroke=\"none\"";
  const double width = pen.widthF() > 0.0 ? pen.widthF() : 1.0;
  std::string out =
      svgDeviceColorOf("stroke", pen.color()) + " stroke-width=\"" + svgDeviceText(width) + '"';
  if (pen.isCosmetic()) out += " vector-effect=\"non-scaling-stroke\"";
  if (pen.style() != Qt::SolidLine) {
    std::string dashes;
    for (const double dash : pen.dashPattern())
      dashes += (dashes.empty() ? "" : ",") + svgDeviceText(dash * width);
    out += " stroke-dasharray=\"" + dashes + '"';
  }
  out += pen.capStyle() == Qt::RoundCap    ? " stroke-linecap=\"round\""
         : pen.capStyle() == Qt::SquareCap ? " stroke-linecap=\"square\""
                                           : " stroke-linecap=\"butt\"";
  out += pen.joinStyle() == Qt::RoundJoin   ? " stroke-linejoin=\"round\""
         : pen.joinStyle() == Qt::BevelJoin ? " stroke-linejoin=\"bevel\""
                                            : " stroke-linejoin=\"miter\"";
  return out;
}

std::string fillOf(const QBrush& brush) {
  if (brush.style() == Qt::NoBrush) return " fill=\"none\"";
  return svgDeviceColorOf("fill",
                          brush.gradient() && !brush.gradient()->stops().isEmpty()
                              ? brush.gradient()->stops().first().second
                              : brush.color());
}

std::string transformOf(const QTransform& transform) {
  if (transform.isIdentity()) return {};
  return " transform=\"matrix(" + svgDeviceText(transform.m11()) + ' ' +
         svgDeviceText(transform.m12()) + ' ' + svgDeviceText(transform.m21()) + ' ' +
         svgDeviceText(transform.m22()) + ' ' + svgDeviceText(transform.dx()) + ' ' +
         svgDeviceText(transform.dy()) + ")\"";
}

}  // namespace

class SvgEngine : public QPaintEngine {
 public:
  explicit SvgEngine(double unitsPerInch)
      : QPaintEngine(PaintEngineFeatures(AllFeatures) & ~PaintEngineFeatures(PatternBrush) &
                     ~PaintEngineFeatures(PerspectiveTransform) &
                     ~PaintEngineFeatures(ConicalGradientFill) & ~PaintEngineFeatures(PorterDuff)),
        unitsPerInch_(unitsPerInch) {}

  bool begin(QPaintDevice*) override { return true; }
  bool end() override {
    closeGroups();
    return true;
  }
  Type type() const override { return User; }

  void updateState(const QPaintEngineState& now) override {
    if (now.state() & (DirtyClipPath | DirtyClipRegion | DirtyClipEnabled)) clipIsOld_ = true;
  }

  void drawPath(const QPainterPath& path) override {
    open(true);
    const bool winding = path.fillRule() == Qt::WindingFill;
    body_ += "<path d=\"" + pathData(path) + "\" fill-rule=\"" + (winding ? "nonzero" : "evenodd") +
             "\"/>\n";
  }

  void drawPolygon(const QPointF* points, int count, PolygonDrawMode mode) override {
    open(mode != PolylineMode);
    body_ += mode == PolylineMode ? "<polyline points=\"" : "<polygon points=\"";
    for (int i = 0; i < count; ++i) body_ += (i > 0 ? " " : "") + pair(points[i]);
    body_ += mode == OddEvenMode ? "\" fill-rule=\"evenodd\"/>\n" : "\"/>\n";
  }
  void drawPolygon(const QPoint* points, int count, PolygonDrawMode mode) override {
    QPolygonF polygon;
    for (int i = 0; i < count; ++i) polygon << points[i];
    drawPolygon(polygon.constData(), count, mode);
  }

  void drawRects(const QRectF* rects, int count) override {
    open(true);
    for (int i = 0; i < count; ++i) {
      const QRectF rect = rects[i].normalized();
      body_ += "<rect x=\"" + svgDeviceText(rect.x()) + "\" y=\"" + svgDeviceText(rect.y()) +
               "\" width=\"" + svgDeviceText(rect.width()) + "\" height=\"" +
               svgDeviceText(rect.height()) + "\"/>\n";
    }
  }
  void drawRects(const QRect* rects, int count) override {
    for (int i = 0; i < count; ++i) {
      const QRectF rect(rects[i]);
      drawRects(&rect, 1);
    }
  }

  void drawTextItem(const QPointF& at, const QTextItem& item) override {
    openText();
    const QFont font = item.font();
    const double size = font.pixelSize() > 0
                            ? font.pixelSize()
                            : font.pointSizeF() * unitsPerInch_ / kSvgDevicePointsPerInch;
    body_ += "<text x=\"" + svgDeviceText(at.x()) + "\" y=\"" + svgDeviceText(at.y()) +
             "\" font-family=\"" + escaped(font.family()) +
             ", 'DejaVu Sans', Arial, sans-serif\" font-size=\"" + svgDeviceText(size) + '"';
    if (font.weight() != QFont::Normal)
      body_ += " font-weight=\"" + std::to_string(font.weight()) + '"';
    if (font.italic()) body_ += " font-style=\"italic\"";
    body_ += " xml:space=\"preserve\">" + escaped(item.text()) + "</text>\n";
  }

  void drawPixmap(const QRectF& target, const QPixmap& pixmap, const QRectF& source) override {
    drawImage(target, pixmap.toImage(), source, Qt::AutoColor);
  }
  void drawImage(const QRectF& target,
                 const QImage& image,
                 const QRectF& source,
                 Qt::ImageConversionFlags) override {
    open(false);
    QByteArray png;
    QBuffer buffer(&png);
    buffer.open(QIODevice::WriteOnly);
    image.copy(source.toRect()).save(&buffer, "PNG");
    const bool smooth = painter()->testRenderHint(QPainter::SmoothPixmapTransform);
    body_ += "<image x=\"" + svgDeviceText(target.x()) + "\" y=\"" + svgDeviceText(target.y()) +
             "\" width=\"" + svgDeviceText(target.width()) + "\" height=\"" +
             svgDeviceText(target.height()) + "\" preserveAspectRatio=\"none\"" +
             (smooth ? "" : " image-rendering=\"pixelated\"") +
             " xlink:href=\"data:image/png;base64," + png.toBase64().toStdString() + "\"/>\n";
  }

  std::string definitions() const { return definitions_; }
  std::string body() const { return body_; }

 private:
  // Everything up to the next change of pen or brush goes into one group.
  void open(bool filled) {
    look(strokeOf(painter()->pen()) + (filled ? fillOf(painter()->brush()) : " fill=\"none\""));
  }
  void openText() { look(" stroke=\"none\"" + svgDeviceColorOf("fill", painter()->pen().color())); }

  void look(const std::string& strokeAndFill) {
    if (clipIsOld_) useClip();
    std::string attributes = strokeAndFill + transformOf(painter()->transform());
    if (painter()->opacity() < 1.0)
      attributes += " opacity=\"" + svgDeviceText(painter()->opacity()) + '"';
    if (lookIsOpen_ && attributes == look_) return;
    if (lookIsOpen_) body_ += "</g>\n";
    body_ += "<g" + attributes + ">\n";
    look_ = attributes;
    lookIsOpen_ = true;
  }

  void useClip() {
    clipIsOld_ = false;
    std::string wanted;
    if (painter()->hasClipping())
      wanted = pathData(painter()->transform().map(painter()->clipPath()));
    if (painter()->hasClipping() == clipIsOpen_ && wanted == clip_) return;
    closeGroups();
    clip_ = wanted;
    if (!painter()->hasClipping()) return;
    const std::string name = "clip" + std::to_string(++numClips_);
    definitions_ += "<clipPath id=\"" + name + "\"><path d=\"" + wanted + "\"/></clipPath>\n";
    body_ += "<g clip-path=\"url(#" + name + ")\">\n";
    clipIsOpen_ = true;
  }

  void closeGroups() {
    if (lookIsOpen_) body_ += "</g>\n";
    if (clipIsOpen_) body_ += "</g>\n";
    lookIsOpen_ = clipIsOpen_ = false;
    clip_.clear();
  }

  double unitsPerInch_;
  std::string definitions_;
  std::string body_;
  std::string look_;
  std::string clip_;
  int numClips_ = 0;
  bool lookIsOpen_ = false;
  bool clipIsOpen_ = false;
  bool clipIsOld_ = true;
};

SvgDevice::SvgDevice(const QSizeF& size, double unitsPerInch)
    : size_(size),
      unitsPerInch_(unitsPerInch),
      engine_(std::make_unique<SvgEngine>(unitsPerInch)) {}

SvgDevice::~SvgDevice() = default;

void SvgDevice::setTitle(const QString& title, const QString& description) {
  title_ = title;
  description_ = description;
}

QPaintEngine* SvgDevice::paintEngine() const { return engine_.get(); }

int SvgDevice::metric(PaintDeviceMetric metric) const {
  const auto whole = [](double value) { return static_cast<int>(std::lround(value)); };
  switch (metric) {
    case PdmWidth:
      return whole(size_.width());
    case PdmHeight:
      return whole(size_.height());
    case PdmWidthMM:
      return whole(size_.width() / unitsPerInch_ * kSvgDeviceMmPerInch);
    case PdmHeightMM:
      return whole(size_.height() / unitsPerInch_ * kSvgDeviceMmPerInch);
    case PdmDpiX:
    case PdmDpiY:
    case PdmPhysicalDpiX:
    case PdmPhysicalDpiY:
      return whole(unitsPerInch_);
    case PdmDevicePixelRatio:
      return 1;
    case PdmDevicePixelRatioScaled:
      return static_cast<int>(devicePixelRatioFScale());
    case PdmNumColors:
      return INT_MAX;
    case PdmDepth:
      return kDepth;
    default:  // what a later Qt asks for, such as its own form of the pixel ratio
      return QPaintDevice::metric(metric);
  }
}

QByteArray SvgDevice::bytes() const {
  const auto mm = [&](double units) {
    return svgDeviceText(units / unitsPerInch_ * kSvgDeviceMmPerInch) + "mm";
  };
  std::string all = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"no\"?>\n";
  all += "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" ";
  all += "version=\"1.1\" width=\"" + mm(size_.width()) + "\" height=\"" + mm(size_.height()) +
         "\" viewBox=\"0 0 " + svgDeviceText(size_.width()) + ' ' + svgDeviceText(size_.height()) +
         "\">\n";
  all += "<title>" + escaped(title_) + "</title>\n<desc>" + escaped(description_) + "</desc>\n";
  all += "<defs>\n" + engine_->definitions() + "</defs>\n" + engine_->body() + "</svg>\n";
  return QByteArray::fromStdString(all);
}

}  // namespace palpate::gui
