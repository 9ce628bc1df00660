#include "gui/appearance/settings_file.h"

#include <QGuiApplication>
#include <QHeaderView>
#include <QMap>
#include <QScreen>
#include <QSplitter>
#include <QTemporaryDir>
#include <QWidget>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <palpate/core/error.h>
#include <palpate/core/output_file.h>
#include <palpate/core/text_file.h>

#include "gui/appearance/named_items.h"

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kLargestSettingsBytes = 64u << 20;
constexpr int kNarrowestColumn = 10, kWidestColumn = 10'000;  // [px]
constexpr int kLargestPart = 100'000;                         // [px]
// Place and size of a window [px].
constexpr int kFarthest = 32'767;

int digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return 16;
}

// The text as QSettings reads values: without quotes, with escaped characters; those beyond Latin-1
// become '?'.
std::string unescaped(std::string_view text) {
  constexpr std::string_view kControls = "abfnrtv", kControlBytes = "\a\b\f\n\r\t\v";
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') continue;
    if (text[i] != '\\') {
      plain += text[i];
      continue;
    }
    if (++i == text.size()) break;
    const char kind = text[i];
    if (const int base = kind == 'x' ? 16 : 8; kind == 'x' || digitOf(kind) < 8) {
      std::size_t at = kind == 'x' ? i + 1 : i;
      unsigned value = 0;
      for (; at < text.size() && digitOf(text[at]) < base; ++at)
        value = (value * static_cast<unsigned>(base) + static_cast<unsigned>(digitOf(text[at]))) &
                0xffffu;
      plain += value < 0x100u ? static_cast<char>(value) : '?';
      i = at - 1;
    } else if (kind == '\n' || kind == '\r') {
      // Two different ones end one line.
      if (i + 1 < text.size() && text[i + 1] != kind &&
          (text[i + 1] == '\n' || text[i + 1] == '\r'))
        ++i;
    } else if (const std::size_t at = kControls.find(kind); at != std::string_view::npos) {
      plain += kControlBytes[at];
    } else if (kind == '"' || kind == '?' || kind == '\'' || kind == '\\') {
      plain += kind;
    }
  }
  return plain;
}

bool holdsObjects(std::string_view text) {
  const std::string plain = unescaped(text);
  return plain.find("@Variant(") != std::string::npos ||
         plain.find("@DateTime(") != std::string::npos;
}

// Reads the bytes of a QVariantMap of lists of texts, as Qt wrote them into settings. Throws
// FormatError when they are anything else.
class OldMap {
 public:
  explicit OldMap(std::string_view bytes) : bytes_(bytes) {}

  QMap<QString, QStringList> read() {
    expect(kMapType);
    QMap<QString, QStringList> map;
    for (std::uint32_t count = number(); count > 0; --count) {
      const QString key = text();
      expect(kTextsType);
      QStringList& texts = map[key];
      for (std::uint32_t size = number(); size > 0; --size) texts.append(text());
    }
    return map;
  }

 private:
  static constexpr std::uint32_t kMapType = 8, kTextsType = 11;

  // Each text takes four bytes at least, so that a wrong count ends here.
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) throw FormatError("settings", "a value ends too early");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  std::uint32_t number() {
    std::uint32_t value = 0;
    for (const char byte : take(4)) value = value << 8u | static_cast<unsigned char>(byte);
    return value;
  }
  void expect(std::uint32_t type) {
    if (number() != type) throw FormatError("settings", "a value is of another type");
  }
  QString text() {
    const std::string_view utf16 = take(number());
    QString text;
    for (std::size_t i = 0; i + 1 < utf16.size(); i += 2)
      text += QChar(static_cast<unsigned char>(utf16[i + 1]), static_cast<unsigned char>(utf16[i]));
    return text;
  }

  std::string_view bytes_;
};

using LeftOut = QMap<QString, QStringList>;

// The grasps that a version before left out of training, by folder.
void addOldLeftOut(std::string_view line, LeftOut& leftOut) {
  constexpr std::string_view kKey = "leftOut=", kObject = "@Variant(";
  if (!line.starts_with(kKey)) return;
  const std::string value = unescaped(line.substr(kKey.size()));
  const std::size_t end = value.rfind(')');
  if (!value.starts_with(kObject) || end == std::string::npos) return;
  try {
    leftOut.insert(OldMap(std::string_view(value).substr(0, end).substr(kObject.size())).read());
  } catch (const FormatError&) {
    // It is an object of another kind.
  }
}

std::string withoutObjects(std::string_view text, LeftOut& leftOut) {
  std::string kept;
  bool ofRecognition = false;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, std::min(text.find('\n'), text.size() - 1) + 1);
    if (line.starts_with('[')) ofRecognition = line.starts_with("[recognise]");
    if (!holdsObjects(line))
      kept += line;
    else if (ofRecognition)
      addOldLeftOut(line, leftOut);
    text.remove_prefix(line.size());
  }
  return kept;
}

void writeSettings(const fs::path& file, const std::string& text, const LeftOut& leftOut) {
  OutputFile out(file, Overwrite::kReplace);
  out.write(text);
  out.commit();
  if (leftOut.isEmpty()) return;
  QSettings settings(QString::fromStdString(file.string()), QSettings::IniFormat);
  for (const auto& [folder, grasps] : leftOut.asKeyValueRange())
    settings.setValue(leftOutKeyOf(folder), grasps);
}

SettingsPlace ofThisSession(const QString& why) {
  auto folder = std::make_shared<QTemporaryDir>();
  return {.path = folder->filePath("palpate.ini"),
          .problem = why + "; changes of the settings aren't kept after this session",
          .session = folder};
}

SettingsPlace putAside(const fs::path& file, const QString& why) {
  std::error_code failed;
  fs::path aside = file.string() + ".damaged";
  for (int i = 2; fs::exists(fs::symlink_status(aside, failed)); ++i)
    aside = file.string() + ".damaged" + std::to_string(i);
  fs::rename(file, aside, failed);
  if (failed) return ofThisSession(why);
  return {.path = QString::fromStdString(file.string()),
          .problem = why + "; it is " + QString::fromStdString(aside.filename().string()) +
                     " now, and the settings are the usual ones"};
}

// An order of columns has each of them once.
bool isOrder(QList<int> order) {
  std::sort(order.begin(), order.end());
  for (int i = 0; i < order.size(); ++i)
    if (order[i] != i) return false;
  return true;
}

}  // namespace

QString leftOutKeyOf(const QString& folder) { return "recognise/leftOut/" + keyPartOf(folder); }

SettingsPlace readableSettings(const QString& path) {
  const fs::path file = path.toStdString();
  std::error_code failed;
  const fs::file_status status = fs::status(file, failed);
  if (!fs::exists(status) || fs::is_directory(status)) return {path};
  if (!fs::is_regular_file(status)) return putAside(file, path + ": isn't a file");
  std::string text;
  try {
    text = readTextFile(file, kLargestSettingsBytes);
  } catch (const FormatError& error) {
    return putAside(file, QString::fromUtf8(error.what()));
  } catch (const FileError& error) {
    return ofThisSession(QString::fromUtf8(error.what()));
  }
  if (!holdsObjects(text)) return {path};
  LeftOut leftOut;
  const std::string kept = withoutObjects(text, leftOut);
  if (holdsObjects(kept)) return putAside(file, path + ": can't be read as settings");
  try {
    writeSettings(file, kept, leftOut);
    return {path};
  } catch (const FileError& error) {
    const SettingsPlace place = ofThisSession(QString::fromUtf8(error.what()));
    try {
      writeSettings(place.path.toStdString(), kept, leftOut);
    } catch (const FileError&) {
      // Then there is room for no file at all.
    }
    return place;
  }
}

QList<int> storedNumbers(
    const QSettings& settings, const QString& key, qsizetype count, int lowest, int highest) {
  const QStringList words = settings.value(key).toStringList();
  if (words.size() != count) return {};
  QList<int> numbers;
  for (const QString& word : words) {
    bool good = false;
    const int number = word.toInt(&good);
    if (!good || number < lowest || number > highest) return {};
    numbers.append(number);
  }
  return numbers;
}

void storeNumbers(const QList<int>& numbers, QSettings& settings, const QString& key) {
  QStringList words;
  for (const int number : numbers) words.append(QString::number(number));
  settings.setValue(key, words);
}

bool restoreParts(QSplitter& splitter, const QSettings& settings, const QString& key) {
  const QList<int> sizes = storedNumbers(settings, key, splitter.count(), 0, kLargestPart);
  if (std::all_of(sizes.begin(), sizes.end(), [](int size) { return size == 0; })) return false;
  splitter.setSizes(sizes);
  return true;
}

void storeParts(const QSplitter& splitter, QSettings& settings, const QString& key) {
  const QList<int> sizes = splitter.sizes();
  // A part that is hidden has no size.
  if (!sizes.contains(0)) storeNumbers(sizes, settings, key);
}

void restoreColumns(QHeaderView& header, const QSettings& settings, const QString& group) {
  const int count = header.count();
  const QList<int> widths =
      storedNumbers(settings, group + "/widths", count, kNarrowestColumn, kWidestColumn);
  for (int i = 0; i < widths.size(); ++i) header.resizeSection(i, widths[i]);
  // From left to right.
  const QList<int> order = storedNumbers(settings, group + "/order", count, 0, count - 1);
  if (isOrder(order))
    for (int i = 0; i < order.size(); ++i) header.moveSection(header.visualIndex(order[i]), i);
  const QList<int> sorted = storedNumbers(settings, group + "/sorted", 2, 0, count - 1);
  if (!sorted.isEmpty())
    header.setSortIndicator(sorted[0], sorted[1] == 0 ? Qt::AscendingOrder : Qt::DescendingOrder);
}

void storeColumns(const QHeaderView& header, QSettings& settings, const QString& group) {
  QList<int> widths, order;
  for (int i = 0; i < header.count(); ++i) {
    widths.append(header.sectionSize(i));
    order.append(header.logicalIndex(i));
  }
  storeNumbers(widths, settings, group + "/widths");
  storeNumbers(order, settings, group + "/order");
  storeNumbers(
      {header.sortIndicatorSection(), header.sortIndicatorOrder()}, settings, group + "/sorted");
}

void restorePlace(QWidget& window, const QSettings& settings, const QString& key) {
  const QList<int> place = storedNumbers(settings, key, 4, -kFarthest, kFarthest);
  if (place.isEmpty() || place[2] <= 0 || place[3] <= 0) return;
  QRect wanted(place[0], place[1], place[2], place[3]);
  const QScreen* screen = QGuiApplication::screenAt(wanted.center());
  if (!screen) screen = QGuiApplication::primaryScreen();
  const QRect room = screen->availableGeometry();
  wanted.setSize(wanted.size().boundedTo(room.size()));
  wanted.moveLeft(std::clamp(wanted.left(), room.left(), room.right() + 1 - wanted.width()));
  wanted.moveTop(std::clamp(wanted.top(), room.top(), room.bottom() + 1 - wanted.height()));
  window.setGeometry(wanted);
  const QString state = settings.value(key + "_state").toString();
  if (state == "maximized") window.setWindowState(window.windowState() | Qt::WindowMaximized);
  if (state == "full_screen") window.setWindowState(window.windowState() | Qt::WindowFullScreen);
}

void storePlace(const QWidget& window, QSettings& settings, const QString& key) {
  const QRect normal = window.normalGeometry();
  const QRect place = normal.isValid() ? normal : window.geometry();
  storeNumbers({place.x(), place.y(), place.width(), place.height()}, settings, key);
  settings.setValue(key + "_state",
                    window.isFullScreen()  ? "full_screen"
                    : window.isMaximized() ? "maximized"
                                           : "normal");
}

}  // namespace palpate::gui
