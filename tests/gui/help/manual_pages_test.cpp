#include "gui/help/manual_pages.h"

#include <QTextDocument>
#include <fstream>

#include <gtest/gtest.h>

#include "testing/testing.h"

namespace palpate::gui::manual_pages_test {
namespace {
namespace fs = std::filesystem;

class ManualPagesTest : public ::testing::Test {
 protected:
  ManualPagesTest() {
    testing::writeFile(folder_ / "README.md",
                       "# The manual\n\n5. [Second](second.md)\n6. [First](first.md#a-b)\n");
    testing::writeFile(
        folder_ / "first.md",
        "# First page\n\nText<!--=a.b-->5<!---->.\n\n## A (b)\n\nPressure of a taxel, "
        "in [kPa](second.md).\nMore.\n\nOther.\n\n## A (b)\n\n| a | b |\n|---|---|\n"
        "| taxel | x |\n");
    testing::writeFile(folder_ / "second.md", "# Second page\n\nTaxels and a TAXEL.\n");
    testing::writeFile(folder_ / "also.md", "no heading\n");
    pages_ = std::make_unique<ManualPages>(folder_.path());
  }
  testing::TemporaryFolder folder_;
  std::unique_ptr<ManualPages> pages_;
};

TEST_F(ManualPagesTest, AreInTheOrderOfTheContents) {
  EXPECT_EQ(pages_->names(), QStringList({"README.md", "second.md", "also.md", "first.md"}));
  EXPECT_EQ(pages_->title("first.md"), "First page");
  EXPECT_EQ(pages_->title("also.md"), "also.md");
}

TEST_F(ManualPagesTest, HeadingsHaveTheAnchorsOfGitHub) {
  EXPECT_EQ(ManualPages::anchorOf("Any hand, as a stream: `x_1`"), "any-hand-as-a-stream-x_1");
  QTextDocument document;
  pages_->fill(document, "first.md");
  const auto& headings = pages_->headings("first.md");
  ASSERT_EQ(headings.size(), 3u);
  EXPECT_EQ(headings[1].anchor, "a-b");
  EXPECT_EQ(headings[2].anchor, "a-b-1");
  EXPECT_EQ(headings[1].level, 2);
  EXPECT_EQ(document.toPlainText().mid(*pages_->positionOf("first.md", "a-b"), 5), "A (b)");
  EXPECT_FALSE(pages_->positionOf("first.md", "nowhere"));
}

TEST_F(ManualPagesTest, SearchFindsEveryPlaceInEitherCase) {
  const auto hits = pages_->search(" taxel ");
  ASSERT_EQ(hits.size(), 4u);
  EXPECT_EQ(hits[0].page, "second.md");
  EXPECT_EQ(hits[0].line, "Taxels and a TAXEL.");
  EXPECT_EQ(hits[3].page, "first.md");
  EXPECT_EQ(hits[3].line, "taxel");
  for (const ManualHit& hit : hits) {
    QTextDocument document;
    pages_->fill(document, hit.page);
    EXPECT_EQ(document.toPlainText().mid(hit.position, hit.length).toLower(), "taxel");
  }
  EXPECT_TRUE(pages_->search("").empty());
  EXPECT_TRUE(pages_->search("a.b").empty()) << "a comment isn't text";
  EXPECT_EQ(pages_->search("e", 2).size(), 2u);
}

// analyst m25
TEST_F(ManualPagesTest, WordsThatDontStandTogetherAreFoundInOneParagraph) {
  EXPECT_EQ(pages_->search("pressure of").size(), 1u) << "they do";
  const auto hits = pages_->search("kpa pressure");
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].page, "first.md");
  EXPECT_EQ(hits[0].line.mid(hits[0].inLine, hits[0].length), "kPa");
  EXPECT_TRUE(pages_->search("pressure other").empty()) << "of different paragraphs";
}

TEST_F(ManualPagesTest, TheFirstParagraphOfASection) {
  EXPECT_EQ(pages_->firstParagraph("first.md", "a-b"), "Pressure of a taxel, in kPa. More.");
  EXPECT_EQ(pages_->firstParagraph("first.md", "nowhere"), "");
  EXPECT_EQ(pages_->firstParagraph("nowhere.md", "a-b"), "");
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
    EXPECT_GT(pages.firstParagraph("docks.md", anchor).size(), 30) << anchor;
}

TEST_F(ManualPagesTest, AFolderWithoutPagesIsAManualWithoutPages) {
  EXPECT_TRUE(ManualPages(folder_ / "nowhere").names().isEmpty());
}

TEST_F(ManualPagesTest, LieInTheDataFolderOrBesideIt) {
  EXPECT_TRUE(ManualPages(ManualPages::folderFor(testing::dataFolder())).has("docks.md"));
  fs::create_directories(folder_ / "data/docs");
  EXPECT_EQ(ManualPages::folderFor(folder_ / "data"), folder_ / "data/docs");
  fs::create_directory_symlink(testing::dataFolder(), folder_ / "link");
  EXPECT_TRUE(ManualPages(ManualPages::folderFor(folder_ / "link")).has("docks.md"));
}

}  // namespace
}  // namespace palpate::gui::manual_pages_test
