#include "gui/picture/svg_device.h"

#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <QSvgRenderer>
#include <QXmlStreamReader>
#include <functional>

#include "testing/testing.h"

namespace palpate::gui::svg_device_test {
namespace {

std::string drawn(const std::function<void(QPainter&)>& paint) {
  SvgDevice device({200.0, 100.0}, 144.0);
  device.setTitle("a < b & c", "said \"so\"");
  QPainter painter(&device);
  paint(painter);
  painter.end();
  return device.bytes().toStdString();
}

bool has(const std::string& svg, const std::string& part) {
  return svg.find(part) != std::string::npos;
}

// As an independent reader draws it.
QImage rendered(const std::string& svg) {
  QSvgRenderer renderer(QByteArray::fromStdString(svg));
  EXPECT_TRUE(renderer.isValid()) << svg;
  QImage image(200, 100, QImage::Format_RGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  renderer.render(&painter);
  return image;
}

TEST(SvgDevice, IsWellFormedAndHasRealSizes) {
  const std::string svg = drawn([](QPainter& painter) {
    painter.drawText(QPointF(10, 20), QString("1 < 2 & \"3\" \x01 µ"));
  });
  EXPECT_TRUE(has(svg, "width=\"35.278mm\" height=\"17.639mm\" viewBox=\"0 0 200 100\""))
      << svg;  // 200 / 144 inches
  QXmlStreamReader reader(QByteArray::fromStdString(svg));
  QString text;
  while (!reader.atEnd())
    if (reader.readNext() == QXmlStreamReader::Characters) text += reader.text();
  EXPECT_FALSE(reader.hasError()) << reader.errorString().toStdString();
  EXPECT_TRUE(text.contains("a < b & c"));
  text.remove('\n');  // where a font has a picture for the control character there are three texts
  EXPECT_TRUE(text.contains("1 < 2 & \"3\"  µ"));
}

TEST(SvgDevice, ShapesLieWhereTheyWereDrawn) {
  const std::string svg = drawn([](QPainter& painter) {
    painter.fillRect(QRectF(10, 10, 30, 20), Qt::red);
    painter.translate(100, 0);
    painter.scale(2, 2);
    painter.fillRect(QRectF(10, 10, 10, 10), Qt::blue);  // 120..140, 20..40
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(0, 255, 0, 128));
    painter.drawEllipse(QRectF(0, 30, 20, 20));  // 100..140, 60..100
  });
  EXPECT_FALSE(has(svg, "<image"));
  const QImage image = rendered(svg);
  EXPECT_EQ(image.pixelColor(25, 20), QColor(Qt::red));
  EXPECT_EQ(image.pixelColor(130, 30), QColor(Qt::blue));
  EXPECT_EQ(image.pixelColor(45, 20), QColor(Qt::white));
  EXPECT_NEAR(image.pixelColor(120, 80).red(), 127, 1);
  EXPECT_EQ(image.pixelColor(120, 80).green(), 255);
}

TEST(SvgDevice, PensKeepColourWidthAndDashes) {
  const std::string svg = drawn([](QPainter& painter) {
    QPen pen(QColor("#0b84c6"), 2.0);
    pen.setDashPattern({3.0, 1.0});
    painter.setPen(pen);
    painter.drawLine(QPointF(0, 50), QPointF(200, 50));
  });
  EXPECT_TRUE(has(svg, "stroke=\"#0b84c6\" stroke-width=\"2\" stroke-dasharray=\"6,2\"")) << svg;
  EXPECT_TRUE(has(svg, "fill=\"none\""));
}

// What QSvgGenerator of Qt 6.4 leaves out.
TEST(SvgDevice, ClippingIsKeptAndEndsWithIt) {
  const std::string svg = drawn([](QPainter& painter) {
    painter.save();
    painter.translate(10, 0);
    painter.setClipRect(QRectF(20, 20, 40, 40));
    painter.drawLine(QPointF(0, 30), QPointF(200, 30));
    painter.restore();
    painter.drawLine(QPointF(0, 70), QPointF(200, 70));
  });
  EXPECT_TRUE(has(svg, "<clipPath id=\"clip1\"><path d=\"M30,20L70,20L70,60L30,60")) << svg;
  const auto clipped = svg.find("clip-path=\"url(#clip1)\"");
  ASSERT_NE(clipped, std::string::npos);
  EXPECT_LT(clipped, svg.find("0,30 200,30"));
  const auto free = svg.find("0,70 200,70");
  ASSERT_NE(free, std::string::npos);
  // Both groups, of the look and of the clip, are closed before the second line.
  const std::string between = svg.substr(clipped, free - clipped);
  EXPECT_TRUE(has(between, "</g>\n</g>\n")) << between;
  EXPECT_FALSE(has(svg, "clip2"));
}

TEST(SvgDevice, TextIsTextOfTheFontsSize) {
  const std::string svg = drawn([](QPainter& painter) {
    QFont font;
    font.setPixelSize(14);
    font.setBold(true);
    painter.setFont(font);
    painter.setPen(QColor("#16191f"));
    painter.translate(20, 80);
    painter.rotate(-90);
    painter.drawText(QPointF(0, 0), QString("mean in counts"));
  });
  EXPECT_TRUE(has(svg, "font-size=\"14\" font-weight=\"700\"")) << svg;
  EXPECT_TRUE(has(svg, ">mean in counts</text>"));
  EXPECT_TRUE(has(svg, "fill=\"#16191f\" transform=\"matrix(0 -1 1 0 20 80)\""));
}

TEST(SvgDevice, ImagesAreEmbedded) {
  QImage image(2, 1, QImage::Format_RGB32);
  image.setPixelColor(0, 0, Qt::red);
  image.setPixelColor(1, 0, Qt::blue);
  const std::string svg =
      drawn([&](QPainter& painter) { painter.drawImage(QRectF(0, 0, 200, 100), image); });
  const QImage shown = rendered(svg);
  EXPECT_EQ(shown.pixelColor(5, 50), QColor(Qt::red));
  EXPECT_EQ(shown.pixelColor(195, 50), QColor(Qt::blue));
}

}  // namespace
}  // namespace palpate::gui::svg_device_test
