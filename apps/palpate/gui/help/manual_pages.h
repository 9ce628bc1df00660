// The pages of the manual (docs/README.md, docs/manual/*.md) as the window shows them: their order,
// their headings with the anchors that links name, and the search over all of them.
#pragma once

#include <QString>
#include <QStringList>
#include <QTextDocument>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace palpate::gui {

struct ManualHeading {
  QString title;
  // As links name it: "the-docks". The second heading of the same title has "-1" added, and so on.
  QString anchor;
  // 1 is the title of the page.
  int level = 1;
  // Where it begins in the text of the page [characters].
  int position = 0;
};

struct ManualHit {
  // "manual/docks.md"
  QString page;
  // Where it is in the text of the page [characters].
  int position = 0;
  int length = 0;
  // The title of the page, and the line in which it is.
  QString title;
  QString line;
  // Where it is in the line [characters].
  int inLine = 0;
};

// A page is named by its path from the folder of the documentation: "README.md", "manual/docks.md".
class ManualPages {
 public:
  // The folder of the documentation for a data folder: `docs` in it (an installation), else next to
  // it (the sources). It need not exist.
  static std::filesystem::path folderFor(const std::filesystem::path& dataFolder);

  // A folder without pages gives a manual without pages.
  explicit ManualPages(std::filesystem::path folder);

  const std::filesystem::path& folder() const noexcept { return folder_; }
  // README.md, then the pages of the manual in the order in which README.md links to them, then the
  // others by name. Other pages of the documentation (notes) can be shown, but are not listed.
  const QStringList& names() const noexcept { return names_; }
  // Whether it can be shown: a page of the manual, or another page in the folder.
  bool has(const QString& name) const;
  // The page to which `path` leads in a link on the page `from`: relative to that page, else to the
  // manual. Empty: none.
  QString target(const QString& path, const QString& from) const;
  // Fills `document` with a page; a page that doesn't exist leaves it empty.
  void fill(QTextDocument& document, const QString& name) const;
  // The first heading of the page; its file name where it has none.
  QString title(const QString& name) const;
  const std::vector<ManualHeading>& headings(const QString& name) const;
  // Where the heading with this anchor begins [characters]; nothing: there is none.
  std::optional<int> positionOf(const QString& name, const QString& anchor) const;
  // The pages that contain all `words` (in any order and either case, as beginnings of words), the
  // best first: words in headings count more, then their number. Of each page the places of the
  // words in the lines that have most of them; at most `limit` places.
  std::vector<ManualHit> search(const QString& words, std::size_t limit = 500) const;
  // The first paragraph below a heading, in plain text; empty: there is none.
  QString firstParagraph(const QString& name, const QString& anchor) const;

  // The anchor of a heading, as GitHub makes it.
  static QString anchorOf(const QString& heading);

 private:
  struct Page {
    QString text;
    std::vector<ManualHeading> headings;
  };
  const Page& page(const QString& name) const;
  QString markdown(const QString& name) const;

  std::filesystem::path folder_;
  QStringList names_;
  // Pages that were read so far.
  mutable std::map<QString, Page> pages_;
};

}  // namespace palpate::gui
