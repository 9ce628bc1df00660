#include "gui/export/export_preview.h"

#include <QTest>
#include <atomic>
#include <latch>
#include <memory>

#include <gtest/gtest.h>

namespace palpate::gui::export_preview_test {
namespace {
using std::chrono_literals::operator""s;

// A table whose rows are read from a file that doesn't answer until it is released.
class ExportPreviewTest : public ::testing::Test {
 protected:
  ExportPreviewTest() {
    view_.name = "Rows";
    view_.tables = [end = end_, hangs = hangs_] {
      return std::vector<ExportedTable>{
          {"rows", [end, hangs] {
             return TextTable{{"n"}, 1000, [end, hangs](std::size_t row) {
                                *hangs = true;
                                end->wait();
                                return std::vector<std::string>{std::to_string(row)};
                              }};
           }}};
    };
    request_.view = "Rows";
    request_.form = ExportFormat::kCsv;
  }
  ~ExportPreviewTest() override { EXPECT_TRUE(Abandonable::awaitThreads(20s)); }

  const std::shared_ptr<std::latch> end_ = std::make_shared<std::latch>(1);
  const std::shared_ptr<std::atomic<bool>> hangs_ = std::make_shared<std::atomic<bool>>(false);
  ExportedView view_;
  ExportRequest request_;
  std::unique_ptr<ExportPreview> preview_ = std::make_unique<ExportPreview>();
};

// Window F13: it is called at each key that is pressed in the dialog.
TEST_F(ExportPreviewTest, ShowingATableDoesNotWaitForItsRows) {
  preview_->show(view_, request_);
  EXPECT_EQ(preview_->summary(), "1000 rows");
  end_->count_down();
  preview_->settle();
  // "n" and the numbers 0 to 999, a line each: 2 + 10 * 2 + 90 * 3 + 900 * 4 bytes.
  EXPECT_NEAR(preview_->bytes(), 3892.0, 40.0);
}

// Window F4.
TEST_F(ExportPreviewTest, ClosingItDoesNotWaitForTheMeasurement) {
  preview_->show(view_, request_);
  ASSERT_TRUE(QTest::qWaitFor([this] { return hangs_->load(); }, 20'000));
  preview_.reset();
  EXPECT_FALSE(Abandonable::awaitThreads(std::chrono::milliseconds(1))) << "it still hangs";
  end_->count_down();
}

}  // namespace
}  // namespace palpate::gui::export_preview_test
