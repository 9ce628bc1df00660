#include "gui/help/manual_pages.h"

#include <QTextDocument>

#include <gtest/gtest.h>

#include "testing/testing.h"

namespace palpate::gui::manual_pages_test {
namespace {
namespace fs = std::filesystem;

class ManualPagesTest : public ::testing::Test {
 protected:
  ManualPagesTest() {
    fs::create_directories(folder_ / "manual");
    fs::create_directories(folder_ / "notes");
    testing::writeFile(folder_ / "README.md",
                       "# The manual\n\n* [Second](manual/second.md)\n"
                       "* [First](manual/first.md#a-b)\n* [Note](notes/note.md)\n");
    testing::writeFile(
        folder_ / "manual/first.md",
        "# First page\n\nText<!--=a.b-->5<!---->.\n\n## A (b)\n\nPressure of a taxel, "
        "in [kPa](second.md).\nMore.\n\nOther.\n\n## A (b)\n\n| a | b |\n|---|---|\n"
        "| taxel | x |\n");
    testing::writeFile(folder_ / "manual/second.md", "# Second page\n\nTaxels and a TAXEL.\n");
    testing::writeFile(folder_ / "manual/also.md", "no heading\n");
    testing::writeFile(folder_ / "notes/note.md", "# A note\n\nA taxel.\n");
    pages_ = std::make_unique<ManualPages>(folder_.path());
  }
  testing::TemporaryFolder folder_;
  std::unique_ptr<ManualPages> pages_;
};

TEST_F(ManualPagesTest, AreInTheOrderOfTheContents) {
  EXPECT_EQ(pages_->names(),
            QStringList({"README.md", "manual/second.md", "manual/first.md", "manual/also.md"}));
  EXPECT_EQ(pages_->title("manual/first.md"), "First page");
  EXPECT_EQ(pages_->title("manual/also.md"), "manual/also.md");
}

TEST_F(ManualPagesTest, HeadingsHaveTheAnchorsOfGitHub) {
  EXPECT_EQ(ManualPages::anchorOf("Any hand, as a stream: `x_1`"), "any-hand-as-a-stream-x_1");
  QTextDocument document;
  pages_->fill(document, "manual/first.md");
  const auto& headings = pages_->headings("manual/first.md");
  ASSERT_EQ(headings.size(), 3u);
  EXPECT_EQ(headings[1].anchor, "a-b");
  EXPECT_EQ(headings[2].anchor, "a-b-1");
  EXPECT_EQ(headings[1].level, 2);
  EXPECT_EQ(document.toPlainText().mid(*pages_->positionOf("manual/first.md", "a-b"), 5), "A (b)");
  EXPECT_FALSE(pages_->positionOf("manual/first.md", "nowhere"));
}

TEST_F(ManualPagesTest, SearchFindsEveryPlaceInEitherCase) {
  const auto hits = pages_->search(" taxel ");
  ASSERT_EQ(hits.size(), 4u);
  EXPECT_EQ(hits[0].page, "manual/second.md");
  EXPECT_EQ(hits[0].line, "Taxels and a TAXEL.");
  EXPECT_EQ(hits[3].page, "manual/first.md");
  EXPECT_EQ(hits[3].line, "taxel");
  for (const ManualHit& hit : hits) {
    QTextDocument document;
    pages_->fill(document, hit.page);
    EXPECT_EQ(document.toPlainText().mid(hit.position, hit.length).toLower(), "taxel");
  }
  EXPECT_TRUE(pages_->search("").empty());
  EXPECT_TRUE(pages_->search("a.b").empty()) << "a comment isn't text";
  EXPECT_EQ(pages_->search("a", 2).size(), 2u);
}

// analyst m25
TEST_F(ManualPagesTest, SearchFindsWordsInAnyOrder) {
  const auto hits = pages_->search("kpa  Pressure kpa");
  ASSERT_EQ(hits.size(), 2u) << "each word of the line once";
  for (const ManualHit& hit : hits) EXPECT_EQ(hit.page, "manual/first.md");
  EXPECT_EQ(hits[0].line.mid(hits[0].inLine, hits[0].length), "Pressure");
  EXPECT_EQ(hits[1].line.mid(hits[1].inLine, hits[1].length), "kPa");
  const auto apart = pages_->search("other pressure");
  ASSERT_EQ(apart.size(), 2u) << "of different paragraphs of one page";
  EXPECT_EQ(apart[0].line, "Pressure of a taxel, in kPa. More.");
  EXPECT_EQ(apart[1].line, "Other.");
  EXPECT_TRUE(pages_->search("pressure second nowhere").empty());
  EXPECT_TRUE(pages_->search("kpa heading").empty()) << "on different pages";
  EXPECT_TRUE(pages_->search("axel").empty()) << "not the beginning of a word";
}

TEST_F(ManualPagesTest, SearchShowsTheLinesWithMostOfTheWords) {
  const auto hits = pages_->search("pressure taxel");
  ASSERT_EQ(hits.size(), 2u);
  for (const ManualHit& hit : hits) EXPECT_EQ(hit.line, "Pressure of a taxel, in kPa. More.");
}

TEST_F(ManualPagesTest, WordsInHeadingsCountMoreThanTheirNumber) {
  testing::writeFile(folder_ / "manual/also.md", "# Often\n\nglove glove glove glove\n");
  testing::writeFile(folder_ / "manual/first.md", "# Much\n\n## The glove\n\nText.\n");
  testing::writeFile(folder_ / "manual/second.md", "# Glove\n\nText.\n");
  const auto hits = ManualPages(folder_.path()).search("glove");
  ASSERT_EQ(hits.size(), 6u);
  EXPECT_EQ(hits[0].page, "manual/second.md") << "the title";
  EXPECT_EQ(hits[1].page, "manual/first.md") << "a heading";
  EXPECT_EQ(hits[2].page, "manual/also.md");
}

// The questions of people with a task lead to the page about it.
TEST_F(ManualPagesTest, QuestionsFindTheirPage) {
  const ManualPages pages(ManualPages::folderFor(testing::dataFolder()));
  for (const auto& [question, page] : {std::pair{"all keys", "manual/keys.md"},
                                       {"settings units", "manual/settings.md"},
                                       {"python recordings", "manual/python.md"},
                                       {"docks timeline", "manual/docks.md"},
                                       {"load cell", "manual/second_sensor.md"},
                                       {"hand does not answer", "manual/connect.md"},
                                       {"stop the hand", "manual/safety.md"},
                                       {"csv import", "manual/import.md"},
                                       {"compare two recordings", "manual/compare.md"}}) {
    const auto hits = pages.search(question);
    ASSERT_FALSE(hits.empty()) << question;
    EXPECT_EQ(hits.front().page, page) << question;
  }
}

TEST_F(ManualPagesTest, NotesCanBeShownButAreNotListed) {
  EXPECT_FALSE(pages_->names().contains("notes/note.md"));
  EXPECT_TRUE(pages_->has("notes/note.md"));
  EXPECT_EQ(pages_->title("notes/note.md"), "A note");
  for (const ManualHit& hit : pages_->search("taxel")) EXPECT_NE(hit.page, "notes/note.md");
}

TEST_F(ManualPagesTest, LinksAreRelativeToTheirPageOrToTheManual) {
  EXPECT_EQ(pages_->target("second.md", "manual/first.md"), "manual/second.md");
  EXPECT_EQ(pages_->target("../notes/note.md", "manual/first.md"), "notes/note.md");
  EXPECT_EQ(pages_->target("../README.md", "manual/first.md"), "README.md");
  EXPECT_EQ(pages_->target("second.md", "README.md"), "manual/second.md") << "of a tool tip";
  EXPECT_EQ(pages_->target("nowhere.md", "manual/first.md"), "");
  fs::create_directories(folder_ / "inner");
  testing::writeFile(folder_ / "inner/README.md", "# Inner\n");
  EXPECT_EQ(ManualPages(folder_ / "inner").target("../README.md", "README.md"), "")
      << "outside the documentation";
}

TEST_F(ManualPagesTest, TheFirstParagraphOfASection) {
  EXPECT_EQ(pages_->firstParagraph("manual/first.md", "a-b"), "Pressure of a taxel, in kPa. More.");
  EXPECT_EQ(pages_->firstParagraph("manual/first.md", "nowhere"), "");
  EXPECT_EQ(pages_->firstParagraph("manual/nowhere.md", "a-b"), "");
}

// What's this tells this paragraph of a dock; the heading of a table explains nothing.
TEST_F(ManualPagesTest, EveryDockBeginsWithASentence) {
  const ManualPages pages(ManualPages::folderFor(testing::dataFolder()));
  for (const char* anchor : {"matrices",
                             "inspect",
                             "timeline",
                             "hand",
                             "link",
                             "filter",
                             "spectrum",
                             "calibrate",
                             "slip",
                             "library",
                             "log",
                             "recognise"})
    EXPECT_GT(pages.firstParagraph("manual/docks.md", anchor).size(), 30) << anchor;
}

TEST_F(ManualPagesTest, AFolderWithoutPagesIsAManualWithoutPages) {
  EXPECT_TRUE(ManualPages(folder_ / "nowhere").names().isEmpty());
}

TEST_F(ManualPagesTest, LieInTheDataFolderOrBesideIt) {
  EXPECT_TRUE(ManualPages(ManualPages::folderFor(testing::dataFolder())).has("manual/docks.md"));
  fs::create_directories(folder_ / "data/docs");
  EXPECT_EQ(ManualPages::folderFor(folder_ / "data"), folder_ / "data/docs");
  fs::create_directory_symlink(testing::dataFolder(), folder_ / "link");
  EXPECT_TRUE(ManualPages(ManualPages::folderFor(folder_ / "link")).has("manual/docks.md"));
}

}  // namespace
}  // namespace palpate::gui::manual_pages_test
