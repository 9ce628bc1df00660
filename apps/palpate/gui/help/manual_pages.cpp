#include "gui/help/manual_pages.h"

#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTextBlock>
#include <algorithm>
#include <set>

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

constexpr const char* kContentsPage = "README.md";
constexpr const char* kManual = "manual/";

QString readPage(const fs::path& path) {
  QFile file(QString::fromStdString(path.string()));
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

// How much a word in a heading, in the title of a page, and in its text counts in a search.
constexpr int kHeadingWorth = 10, kTitleWorth = 40, kMaxCounted = 15;

// Where a word of a search begins in a text.
struct WordPlace {
  qsizetype position = 0;
  std::size_t word = 0;  // which
};

// All places, in the order of the text. A word is found at the beginning of a word: "slip" in
// "slipping", not in "nonslip".
std::vector<WordPlace> placesOf(const QString& text, const QStringList& words) {
  std::vector<WordPlace> places;
  for (qsizetype i = 0; i < words.size(); ++i) {
    const bool isWord = words[i].front().isLetterOrNumber();
    for (qsizetype at = text.indexOf(words[i], 0, Qt::CaseInsensitive); at >= 0;
         at = text.indexOf(words[i], at + words[i].size(), Qt::CaseInsensitive))
      if (!isWord || at == 0 || !text[at - 1].isLetterOrNumber())
        places.push_back({at, static_cast<std::size_t>(i)});
  }
  std::sort(places.begin(), places.end(), [](const WordPlace& a, const WordPlace& b) {
    return a.position < b.position;
  });
  return places;
}

qsizetype lineStart(const QString& text, qsizetype position) {
  return position == 0 ? 0 : text.lastIndexOf('\n', position - 1) + 1;
}

}  // namespace

fs::path ManualPages::folderFor(const fs::path& dataFolder) {
  std::error_code ignored;
  if (fs::is_directory(dataFolder / "docs", ignored)) return dataFolder / "docs";
  // In a build folder, the data folder is a link into the sources.
  const fs::path real = fs::canonical(dataFolder, ignored);
  return (ignored ? dataFolder : real).parent_path() / "docs";
}

ManualPages::ManualPages(fs::path folder) : folder_(std::move(folder)) {
  const QDir all(QString::fromStdString(folder_.string()));
  if (all.exists(kContentsPage)) names_.append(kContentsPage);
  static const QRegularExpression link(R"(\]\((manual/[a-z0-9_]+\.md))");
  auto links = link.globalMatch(readPage(folder_ / kContentsPage));
  while (links.hasNext()) {
    const QString name = links.next().captured(1);
    if (all.exists(name) && !names_.contains(name)) names_.append(name);
  }
  const QStringList files =
      QDir(all.filePath(kManual)).entryList({"*.md"}, QDir::Files | QDir::Readable, QDir::Name);
  for (const QString& file : files)
    if (const QString name = kManual + file; !names_.contains(name)) names_.append(name);
}

bool ManualPages::has(const QString& name) const {
  if (names_.contains(name)) return true;
  const bool below = !name.isEmpty() && !name.startsWith("..") && !QDir::isAbsolutePath(name);
  const QDir folder(QString::fromStdString(folder_.string()));
  return below && name.endsWith(".md") && folder.exists(name);
}

QString ManualPages::target(const QString& path, const QString& from) const {
  const QString here = from.left(from.lastIndexOf('/') + 1);
  if (const QString name = QDir::cleanPath(here + path); has(name)) return name;
  // A tool tip names a page of the manual.
  const QString name = QDir::cleanPath(kManual + path);
  return path.startsWith("../") || !has(name) ? QString() : name;
}

QString ManualPages::markdown(const QString& name) const {
  if (!has(name)) return {};
  QString text = readPage(folder_ / name.toStdString());
  static const QRegularExpression comment("<!--.*?-->",
                                          QRegularExpression::DotMatchesEverythingOption);
  text.remove(comment);
  return text;
}

void ManualPages::fill(QTextDocument& document, const QString& name) const {
  document.setMarkdown(markdown(name), QTextDocument::MarkdownDialectGitHub);
}

QString ManualPages::anchorOf(const QString& heading) {
  QString anchor;
  for (const QChar letter : heading)
    if (letter == ' ')
      anchor += '-';
    else if (letter.isLetterOrNumber() || letter == '-' || letter == '_')
      anchor += letter.toLower();
  return anchor;
}

const ManualPages::Page& ManualPages::page(const QString& name) const {
  const auto known = pages_.find(name);
  if (known != pages_.end()) return known->second;
  QTextDocument document;
  fill(document, name);
  Page page{.text = document.toPlainText(), .headings = {}};
  std::map<QString, int> times;
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
    const int level = block.blockFormat().headingLevel();
    if (level == 0) continue;
    QString anchor = anchorOf(block.text());
    if (const int before = times[anchor]++; before > 0) anchor += QString("-%1").arg(before);
    page.headings.push_back({block.text(), anchor, level, block.position()});
  }
  return pages_.emplace(name, std::move(page)).first->second;
}

QString ManualPages::title(const QString& name) const {
  const auto& all = headings(name);
  return all.empty() ? name : all.front().title;
}

const std::vector<ManualHeading>& ManualPages::headings(const QString& name) const {
  return page(name).headings;
}

std::optional<int> ManualPages::positionOf(const QString& name, const QString& anchor) const {
  for (const ManualHeading& heading : headings(name))
    if (heading.anchor == anchor) return heading.position;
  return std::nullopt;
}

std::vector<ManualHit> ManualPages::search(const QString& words, std::size_t limit) const {
  QStringList wanted = words.simplified().toLower().split(' ', Qt::SkipEmptyParts);
  wanted.removeDuplicates();
  if (wanted.isEmpty()) return {};
  struct Found {
    QString page;
    int score = 0;
    std::vector<WordPlace> places;  // in the order of the text
  };
  std::vector<Found> found;
  for (const QString& name : names_) {
    Found each{.page = name, .places = placesOf(page(name).text, wanted)};
    std::vector<int> times(static_cast<std::size_t>(wanted.size()));
    for (const WordPlace& place : each.places) ++times[place.word];
    if (std::count(times.begin(), times.end(), 0) > 0) continue;
    for (const int count : times) each.score += std::min(count, kMaxCounted);
    for (const ManualHeading& heading : page(name).headings) {
      std::set<std::size_t> inHeading;
      for (const WordPlace& place : placesOf(heading.title, wanted)) inHeading.insert(place.word);
      each.score +=
          static_cast<int>(inHeading.size()) * (heading.level == 1 ? kTitleWorth : kHeadingWorth);
    }
    found.push_back(std::move(each));
  }
  std::stable_sort(
      found.begin(), found.end(), [](const Found& a, const Found& b) { return a.score > b.score; });
  std::vector<ManualHit> hits;
  for (const Found& each : found) {
    const QString& text = page(each.page).text;
    // The lines with most of the words.
    std::map<qsizetype, std::set<std::size_t>> wordsOfLine;
    for (const WordPlace& place : each.places)
      wordsOfLine[lineStart(text, place.position)].insert(place.word);
    std::size_t most = 0;
    for (const auto& [from, inLine] : wordsOfLine) most = std::max(most, inLine.size());
    for (const WordPlace& place : each.places) {
      const qsizetype from = lineStart(text, place.position);
      if (wordsOfLine.at(from).size() < most) continue;
      if (hits.size() == limit) return hits;
      const qsizetype end = text.indexOf('\n', place.position);
      hits.push_back({.page = each.page,
                      .position = static_cast<int>(place.position),
                      .length = static_cast<int>(wanted[static_cast<qsizetype>(place.word)].size()),
                      .title = title(each.page),
                      .line = text.mid(from, end < 0 ? -1 : end - from),
                      .inLine = static_cast<int>(place.position - from)});
    }
  }
  return hits;
}

QString ManualPages::firstParagraph(const QString& name, const QString& anchor) const {
  const Page& all = page(name);
  for (std::size_t i = 0; i < all.headings.size(); ++i) {
    if (all.headings[i].anchor != anchor) continue;
    const qsizetype from = all.text.indexOf('\n', all.headings[i].position);
    if (from < 0) return {};
    const qsizetype to =
        i + 1 < all.headings.size() ? all.headings[i + 1].position : all.text.size();
    const QString below = all.text.mid(from + 1, std::max<qsizetype>(0, to - from - 1)).trimmed();
    return below.section('\n', 0, 0);
  }
  return {};
}

}  // namespace palpate::gui
