#include "gui/recognise/recognition_answer.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

constexpr std::size_t kBest = 3;
constexpr double kNameUnits = 3.0;  // largest size of the name
constexpr double kMinNameUnits = 1.2;
constexpr double kPhotoShare = 0.36;            // of the width, at most
constexpr double kRecognitionAnswerLine = 1.7;  // [units] height of a runner-up's line

QFont fontOf(const QPainter& painter, double pixels, bool bold = false) {
  QFont font = painter.font();
  font.setPixelSize(std::max(6, static_cast<int>(std::lround(pixels))));
  font.setBold(bold);
  return font;
}

QColor recognitionAnswerColorOf(const RecognitionAnswer& answer, const ThemeColors& colors) {
  if (answer.kind == RecognitionAnswer::Kind::kUnknown) return colors.muted;
  return answer.sure ? colors.accent : colors.warning;
}

void paintBar(QPainter& painter, const QRectF& bar, double p, const QColor& color, Theme theme) {
  const double radius = std::min(4.0, bar.height() / 2.0);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colorsOf(theme).taxel);
  painter.drawRoundedRect(bar, radius, radius);
  QPainterPath clip;
  clip.addRoundedRect(bar, radius, radius);
  painter.save();
  painter.setClipPath(clip, Qt::IntersectClip);
  painter.fillRect(
      QRectF(bar.left(), bar.top(), bar.width() * std::clamp(p, 0.0, 1.0), bar.height()), color);
  painter.restore();
}

// Returns the lower end of the text.
double paintWords(QPainter& painter,
                  const QRectF& room,
                  const QString& text,
                  const QFont& font,
                  const QColor& color) {
  if (text.isEmpty()) return room.top();
  painter.setFont(font);
  painter.setPen(color);
  QRectF used;
  painter.drawText(room, Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap, text, &used);
  return used.bottom();
}

// Returns the lower end of the photo.
double paintPhoto(QPainter& painter,
                  const QRectF& room,
                  const QPixmap& photo,
                  const QColor& border) {
  const QSizeF size = QSizeF(photo.size()).scaled(room.size(), Qt::KeepAspectRatio);
  const QRectF at(room.right() - size.width(), room.top(), size.width(), size.height());
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawPixmap(at, photo, QRectF(photo.rect()));
  painter.setPen(border);
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(at);
  return at.bottom();
}

}  // namespace

QString probabilityText(double p) {
  return QString::number(std::clamp(static_cast<int>(std::lround(100.0 * p)), 0, 99)) + " %";
}

QString RecognitionAnswer::name() const {
  if (kind == Kind::kUnknown) return "unknown";
  return kind == Kind::kNamed && !best.empty() ? best.front().name : QString();
}

QString RecognitionAnswer::confidenceWord() const {
  if (kind == Kind::kUnknown) return "unknown";
  if (kind != Kind::kNamed) return {};
  return !known ? "not known yet" : sure ? "sure" : "not sure";
}

QString RecognitionAnswer::accessibleText() const {
  if (kind == Kind::kNothing || kind == Kind::kProblem) return text;
  if (kind == Kind::kUnknown || !known)
    return confidenceWord() + (best.empty() ? QString() : "; most similar: " + best.front().name);
  return name() + ", " + probabilityText(best.front().p) + ", " + confidenceWord();
}

RecognitionAnswer answerOf(const TrainedModel& model, const Prediction& prediction) {
  RecognitionAnswer answer;
  answer.kind = prediction.label == Prediction::kUnknown ? RecognitionAnswer::Kind::kUnknown
                                                         : RecognitionAnswer::Kind::kNamed;
  answer.sure = prediction.sure;
  answer.known = prediction.membership != Membership::kNotKnownYet;
  for (std::size_t k = 0; k < std::min(kBest, prediction.ranking.size()); ++k)
    answer.best.push_back(
        {QString::fromStdString(model.classes[static_cast<std::size_t>(prediction.ranking[k])]),
         prediction.p[k]});
  return answer;
}

QString offsetText(const SessionOffset& offset, bool emulated) {
  if (emulated) return "session offset 0 mm: the emulated hand has none";
  const QString value = figure(offset.mm, 1) + " mm";
  switch (offset.origin) {
    case OffsetSource::kNone:
      return "session offset 0 mm, assumed: as in the session of the training";
    case OffsetSource::kUnknown:
      return "session offset not known: all are considered";
    case OffsetSource::kGiven:
      return "session offset " + value + ", typed";
    case OffsetSource::kBatch:
    case OffsetSource::kReferences:
    case OffsetSource::kEmptyHand:
      break;
  }
  const QString origin =
      offset.origin == OffsetSource::kEmptyHand
          ? QString("the empty hand")
          : QString::number(offset.grasps) +
                (offset.origin == OffsetSource::kReferences ? " named" : " unnamed") +
                (offset.grasps == 1 ? " grasp" : " grasps") + ", " +
                QString::number(offset.objects) + (offset.objects == 1 ? " object" : " objects");
  return "session offset " + value + " ± " + figure(offset.sdMm, 1) + " mm, from " + origin;
}

double paintAnswer(QPainter& painter,
                   const QRectF& area,
                   const RecognitionAnswer& answer,
                   const QPixmap& photo,
                   Theme theme,
                   double unit) {
  using Kind = RecognitionAnswer::Kind;
  const ThemeColors& colors = colorsOf(theme);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  QRectF room = area;
  double photoEnd = area.top();
  const bool answered = answer.kind == Kind::kNamed || answer.kind == Kind::kUnknown;
  if (answered && !photo.isNull() && answer.kind == Kind::kNamed && answer.known) {
    const double side = std::min(kPhotoShare * room.width(), 12.0 * unit);
    photoEnd = paintPhoto(
        painter, QRectF(room.right() - side, room.top(), side, side), photo, colors.border);
    room.setRight(room.right() - side - unit);
  }
  if (!answered) {
    const QFont font = fontOf(painter, answer.kind == Kind::kProblem ? 1.15 * unit : unit);
    const double y = paintWords(painter,
                                room,
                                answer.text,
                                font,
                                answer.kind == Kind::kProblem ? colors.text : colors.muted);
    const double end =
        answer.of.isEmpty()
            ? y
            : paintWords(painter,
                         QRectF(room.left(), y + 0.6 * unit, room.width(), room.height()),
                         answer.of,
                         fontOf(painter, 0.9 * unit),
                         colors.muted);
    painter.restore();
    return end;
  }
  const QColor color = recognitionAnswerColorOf(answer, colors);
  const bool named = answer.kind == Kind::kNamed && answer.known;
  const QString headline = named ? answer.name() : answer.confidenceWord();
  // The name is as large as fits.
  double size = kNameUnits * unit;
  while (size > kMinNameUnits * unit &&
         QFontMetricsF(fontOf(painter, size, true)).horizontalAdvance(headline) > room.width())
    size *= 0.94;
  const QFont large = fontOf(painter, size, true);
  const QFontMetricsF metrics(large);
  double y = room.top();
  painter.setFont(large);
  painter.setPen(named ? colors.text : colors.muted);
  painter.drawText(QRectF(room.left(), y, room.width(), metrics.height()),
                   Qt::AlignLeft | Qt::AlignVCenter,
                   metrics.elidedText(headline, Qt::ElideRight, room.width()));
  y += metrics.height() + 0.25 * unit;
  const QFont plain = fontOf(painter, unit), bold = fontOf(painter, unit, true);
  const double figureWidth = QFontMetricsF(bold).horizontalAdvance("99 %") + 0.4 * unit;
  const auto right = Qt::AlignRight | Qt::AlignVCenter, left = Qt::AlignLeft | Qt::AlignVCenter;
  if (named) {
    const QRectF bar(room.left(), y, room.width() - figureWidth, 0.9 * unit);
    paintBar(painter, bar, answer.best.front().p, color, theme);
    painter.setFont(bold);
    painter.setPen(colors.text);
    painter.drawText(QRectF(bar.right(), y - 0.3 * unit, figureWidth, 1.5 * unit),
                     right,
                     probabilityText(answer.best.front().p));
    y += 1.4 * unit;
    painter.setFont(bold);
    painter.setPen(color);
    painter.drawText(
        QRectF(room.left(), y, room.width(), 1.4 * unit), left, answer.confidenceWord());
    y += 1.9 * unit;
  } else {
    // The probabilities are those among the trained objects only, so they say nothing here.
    y = paintWords(painter,
                   QRectF(room.left(), y, room.width(), 4 * unit),
                   (answer.known ? QString("Not one of the trained objects")
                                 : QString("Perhaps not one of the trained objects")) +
                       (answer.best.empty() ? QString(".")
                                            : "; most similar: " + answer.best.front().name),
                   plain,
                   colors.muted) +
        0.4 * unit;
  }
  // The runners-up.
  const double nameWidth = 0.48 * room.width();
  for (std::size_t k = 1; named && k < answer.best.size(); ++k) {
    const auto& place = answer.best[k];
    painter.setFont(plain);
    painter.setPen(colors.muted);
    const QRectF row(room.left(), y, room.width(), kRecognitionAnswerLine * unit);
    painter.drawText(
        QRectF(row.left(), row.top(), nameWidth, row.height()),
        left,
        QFontMetricsF(plain).elidedText(place.name, Qt::ElideRight, nameWidth - 0.5 * unit));
    paintBar(painter,
             QRectF(row.left() + nameWidth,
                    row.center().y() - 0.25 * unit,
                    row.width() - nameWidth - figureWidth,
                    0.5 * unit),
             place.p,
             colors.muted,
             theme);
    painter.setPen(colors.muted);
    painter.drawText(row, right, probabilityText(place.p));
    y += kRecognitionAnswerLine * unit;
  }
  y += 0.5 * unit;
  const QFont small = fontOf(painter, 0.9 * unit);
  const auto line = [&](const QString& text, const QColor& ink) {
    if (text.isEmpty() || y + unit > area.bottom()) return;
    y = paintWords(
            painter, QRectF(area.left(), y, area.width(), area.bottom() - y), text, small, ink) +
        0.25 * unit;
  };
  // These lines are as wide as the area: they stand below the photo.
  y = std::max(y, photoEnd + 0.25 * unit);
  line(answer.of, colors.muted);
  line(answer.offset, colors.muted);
  line(answer.unsure, colors.warning);
  painter.restore();
  return y;
}

}  // namespace palpate::gui
