#include "gui/shell/dock_layout.h"

#include <QDataStream>
#include <QIODevice>

namespace palpate::gui {
namespace {

// The marks and flags of Qt's format (qmainwindow.cpp, qdockarealayout_p.h).
constexpr int kVersionMark = 0xff;
constexpr quint8 kDocksMark = 0xfd, kWidgetMark = 0xfb, kTabsMark = 0xfa, kSequenceMark = 0xfc;
constexpr quint8 kToolBarsMark = 0xfc;
constexpr quint8 kFloating = 0x02;

constexpr qsizetype kLargestLayoutBytes = 1 << 16;
constexpr int kMaxItems = 100, kDeepest = 16, kLongestName = 100;
constexpr int kLargestPx = 1 << 15;
// Limits of sizes, which Qt passes over: docks without one have QWIDGETSIZE_MAX, and places have
// the sum of those of their docks.
constexpr int kLargestLimitPx = kMaxItems * ((1 << 24) - 1);

class LayoutCheck {
 public:
  explicit LayoutCheck(const QByteArray& bytes) : in_(bytes) {
    in_.setVersion(QDataStream::Qt_5_0);
  }

  bool passes() {
    if (number() != kVersionMark || number() != 0 || byte() != kDocksMark) return false;
    const int sides = number();
    if (sides < 0 || sides > 4) return false;
    for (int i = 0; i < sides; ++i)
      if (!within(number(), 0, 3) || !size() || !items(0)) return false;
    if (!size()) return false;
    for (int corner = 0; corner < 4; ++corner) {
      const int side = number();
      if (side != Qt::LeftDockWidgetArea && side != Qt::RightDockWidgetArea &&
          side != Qt::TopDockWidgetArea && side != Qt::BottomDockWidgetArea)
        return false;
    }
    return byte() == kToolBarsMark && toolBars() && in_.status() == QDataStream::Ok && in_.atEnd();
  }

 private:
  static bool within(int value, int lowest, int highest) {
    return value >= lowest && value <= highest;
  }

  int number() {
    qint32 value = 0;
    in_ >> value;
    return value;
  }

  quint8 byte() {
    quint8 value = 0;
    in_ >> value;
    return value;
  }

  // -1: none was given.
  bool size() { return pixels() && pixels(); }
  bool pixels() { return within(number(), -kLargestPx, kLargestPx); }
  bool limits() {
    return within(number(), -1, kLargestLimitPx) && within(number(), -1, kLargestLimitPx);
  }

  bool name() {
    // Two bytes each.
    const int length = number();
    return within(length, 2, 2 * kLongestName) && in_.skipRawData(length) == length;
  }

  // Lines of tool bars, none of which floats.
  bool toolBars() {
    const int lines = number();
    if (!within(lines, 0, kMaxItems)) return false;
    for (int line = 0; line < lines; ++line) {
      if (!within(number(), 0, 3)) return false;
      const int count = number();
      if (!within(count, 0, kMaxItems)) return false;
      for (int i = 0; i < count; ++i) {
        if (!name()) return false;
        byte();  // whether it is shown
        if (!size() || number() != 0 || number() != 0) return false;
      }
    }
    return true;
  }

  bool widget() {
    if (!name()) return false;
    return (byte() & kFloating) != 0 ? size() && size() : size() && limits();
  }

  // The docks of a side, or those within one of its places.
  bool items(int depth) {
    const quint8 mark = byte();
    if (depth > kDeepest || (mark != kTabsMark && mark != kSequenceMark)) return false;
    // The tab in front.
    if (mark == kTabsMark && !within(number(), -1, kMaxItems)) return false;
    if (const quint8 orientation = byte();
        orientation != Qt::Horizontal && orientation != Qt::Vertical)
      return false;
    const int count = number();
    if (!within(count, 0, kMaxItems)) return false;
    for (int i = 0; i < count; ++i) {
      const quint8 item = byte();
      if (item == kWidgetMark ? !widget()
                              : item != kSequenceMark || !size() || !limits() || !items(depth + 1))
        return false;
      if (in_.status() != QDataStream::Ok) return false;
    }
    return true;
  }

  QDataStream in_;
};

}  // namespace

bool isDockLayout(const QByteArray& bytes) {
  return bytes.size() <= kLargestLayoutBytes && LayoutCheck(bytes).passes();
}

}  // namespace palpate::gui
