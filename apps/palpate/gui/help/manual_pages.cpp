#include "gui/help/manual_pages.h"

#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTextBlock>
#include <algorithm>

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

constexpr const char* kContentsPage = "README.md";

QString readPage(const fs::path& path) {
  QFile file(QString::fromStdString(path.string()));
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
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
  const QStringList all = QDir(QString::fromStdString(folder_.string()))
                              .entryList({"*.md"}, QDir::Files | QDir::Readable, QDir::Name);
  if (all.contains(kContentsPage)) names_.append(kContentsPage);
  static const QRegularExpression link(R"(\]\(([a-z0-9_]+\.md)\))");
  auto links = link.globalMatch(readPage(folder_ / kContentsPage));
  while (links.hasNext()) {
    const QString name = links.next().captured(1);
    if (all.contains(name) && !names_.contains(name)) names_.append(name);
  }
  for (const QString& name : all)
    if (!names_.contains(name)) names_.append(name);
}

QString ManualPages::markdown(const QString& name) const {
  if (!has(name)) return {};
  QString text = readPage(folder_ / name.toStdString());
  static const QRegularExpression comment("<!--.*?-->",
                                          QRegularExpression::DotMatchesEverythingOption);
  text.remove(comment);
  if (name == kContentsPage) {
    // Lists of Qt begin at 1 whatever the page says.
    static const QRegularExpression number(R"(^\d+\. )", QRegularExpression::MultilineOption);
    text.replace(number, "* ");
  }
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

std::vector<ManualHit> ManualPages::search(const QString& words, std::size_t most) const {
  const QString wanted = words.simplified();
  if (wanted.isEmpty()) return {};
  std::vector<ManualHit> hits = searchPhrase(wanted, {}, most);
  // Words that stand nowhere together are looked for in one paragraph.
  if (const QStringList each = wanted.split(' '); hits.empty() && each.size() > 1)
    hits = searchPhrase(each.front(), each.mid(1), most);
  return hits;
}

std::vector<ManualHit> ManualPages::searchPhrase(const QString& wanted,
                                                 const QStringList& others,
                                                 std::size_t most) const {
  std::vector<ManualHit> hits;
  for (const QString& name : names_) {
    const QString& text = page(name).text;
    for (qsizetype at = text.indexOf(wanted, 0, Qt::CaseInsensitive); at >= 0;
         at = text.indexOf(wanted, at + wanted.size(), Qt::CaseInsensitive)) {
      if (hits.size() == most) return hits;
      const qsizetype from = text.lastIndexOf('\n', at) + 1;
      const qsizetype end = text.indexOf('\n', at);
      const QString line = text.mid(from, end < 0 ? -1 : end - from);
      if (!std::all_of(others.begin(), others.end(), [&](const QString& other) {
            return line.contains(other, Qt::CaseInsensitive);
          }))
        continue;
      hits.push_back({.page = name,
                      .position = static_cast<int>(at),
                      .length = static_cast<int>(wanted.size()),
                      .title = title(name),
                      .line = line,
                      .inLine = static_cast<int>(at - from)});
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
