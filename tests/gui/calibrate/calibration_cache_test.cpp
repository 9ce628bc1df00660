#include "gui/calibrate/calibration_cache.h"

#include <QSignalSpy>

#include <gtest/gtest.h>

#include "calibration/sample_calibrations.h"
#include "gui/testing/held_readings.h"
#include "testing/testing.h"

namespace palpate::gui::calibration_cache_test {
namespace {

class CalibrationCacheTest : public ::testing::Test {
 protected:
  CalibrationCacheTest() {
    saveCalibration(testing::linearCalibration({0.5, 150.0, false}), folder_ / "c.json");
  }

  const testing::TemporaryFolder folder_;
  const QString path_ = QString::fromStdString((folder_ / "c.json").string());
  CalibrationCache cache_;
};

TEST_F(CalibrationCacheTest, WhatWasReadBeforeIsForgottenAtOnce) {
  EXPECT_EQ(cache_.find(path_), nullptr);
  FileReading::settleAll(cache_);
  ASSERT_NE(cache_.find(path_), nullptr);
  EXPECT_TRUE(cache_.find(path_)->calibration);
  testing::writeFile(folder_ / "c.json", "{}");
  HeldReadings held;
  QSignalSpy changed(&cache_, &CalibrationCache::changed);
  cache_.renew(path_);
  EXPECT_EQ(changed.size(), 1);
  EXPECT_EQ(cache_.find(path_), nullptr);
  held.release();
  FileReading::settleAll(cache_);
  ASSERT_NE(cache_.find(path_), nullptr);
  EXPECT_FALSE(cache_.find(path_)->calibration);
  EXPECT_FALSE(cache_.find(path_)->problem.isEmpty());
  EXPECT_EQ(changed.size(), 2);
}

}  // namespace
}  // namespace palpate::gui::calibration_cache_test
