// The parts are read by nlohmann-json itself, not by the code that divides them.
#include "palpate/interop/datagrams.h"

#include <limits>

#include <nlohmann/json.hpp>

#include "palpate/interop/signal_json.h"
#include "palpate/live/signals_stage.h"
#include "palpate/recording/tactile_sensor_json.h"

#include "interop/sample_results.h"
#include "testing/testing.h"

namespace palpate::datagrams_test {
namespace {
using Parsed = nlohmann::json;

// Results of a hand with many matrices and axes, and numbers with many digits.
LiveResults largeResults(std::size_t numMatrices, std::size_t numAxes) {
  std::vector<MatrixLayout> matrices(numMatrices, MatrixLayout::full(8, 8, 1.7));
  TactileFrame frame(std::make_shared<const SensorLayout>(std::move(matrices)));
  frame.hostUs = 1'416'996'123'250'007;
  frame.deviceUs = 123'456'789;
  for (std::size_t i = 0; i < frame.values.size(); ++i)
    frame.values[i] = 1000.0F + static_cast<float>(i % 97) / 7.0F;
  LiveResults results;
  results.frame = std::make_shared<const TactileFrame>(std::move(frame));
  std::vector<Event> events;
  SignalsStage().onFrame(results, events);
  results.slip.resize(numMatrices);
  for (SlipDetection& slip : results.slip) {
    slip.state = SlipState::kSlip;
    slip.indicator = SlipIndicator::kSlipping;
    slip.confidence = 0.1234567890123456;
    slip.pMoved = -0.9876543210987654e-200;
    slip.motion.valid = slip.motion.refValid = true;
    slip.motion.dx = slip.motion.dy = -1.2345678901234567e-100;
    slip.motion.refDx = slip.motion.refDy = -2.345678901234567e-100;
    slip.motion.rotation.valid = slip.motion.rotation.refValid = true;
    slip.motion.rotation.rotationDeg = slip.motion.rotation.refRotationDeg = -3.4567890123456e-100;
  }
  results.angles = Sample{1, std::vector<double>(numAxes, -12.345678901234567)};
  if (numAxes > 2) results.angles->values[2] = std::numeric_limits<double>::quiet_NaN();
  results.temperatures = Sample{1, {41.25, 38.0}, kTemperatureSeries};
  return results;
}

struct Whole {
  std::string text;
  std::vector<JsonMember> members;
  std::vector<std::string> datagrams() const { return signalDatagrams(text, members); }
};

Whole wholeOf(const LiveResults& results) {
  Whole whole{"before", {}};  // places are those of the object, not of the text it is appended to
  const LinkHealth link;
  appendSignalJson(whole.text, results, 7, &link, &whole.members);
  whole.text.erase(0, 6);
  return whole;
}

// What a receiver knows after all parts.
Parsed unionOf(const std::vector<std::string>& parts) {
  Parsed all = Parsed::object();
  for (const std::string& part : parts) {
    const Parsed object = Parsed::parse(part);
    EXPECT_EQ(object.at("t").get<double>(), 1'416'996'123.250007);
    EXPECT_EQ(object.at("sequence").get<int>(), 7);
    EXPECT_GT(object.size(), 2u);
    for (const auto& [key, value] : object.items()) {
      EXPECT_TRUE(key == "t" || key == "sequence" || !all.contains(key)) << key << " comes twice";
      all[key] = value;
    }
  }
  return all;
}

TEST(Datagrams, SignalsThatFitStayOneObject) {
  Whole whole;
  appendSignalJson(whole.text, testing::sampleResults(), 3, nullptr, &whole.members);
  ASSERT_LE(whole.text.size(), kMaxDatagramBytes);
  EXPECT_EQ(whole.datagrams(), std::vector<std::string>{whole.text});
}

TEST(Datagrams, PartsOfSignalsAreTogetherTheWholeObject) {
  for (const std::size_t numMatrices : {1u, 6u, 40u}) {
    const LiveResults results = largeResults(numMatrices, 7);
    const Whole whole = wholeOf(results);
    const std::vector<std::string> parts = whole.datagrams();
    EXPECT_EQ(parts.size() > 1, numMatrices > 1);
    for (const std::string& part : parts) EXPECT_LE(part.size(), kMaxDatagramBytes);
    EXPECT_EQ(unionOf(parts), Parsed::parse(whole.text)) << numMatrices << " matrices";
  }
}

TEST(Datagrams, ALongArrayIsDividedIntoItsValues) {
  const Whole object = wholeOf(largeResults(2, 300));
  const std::vector<std::string> parts = object.datagrams();
  for (const std::string& part : parts) EXPECT_LE(part.size(), kMaxDatagramBytes);
  Parsed all = unionOf(parts);
  Parsed whole = Parsed::parse(object.text);
  for (std::size_t i = 0; i < 300; ++i) {
    const std::string key = "angles_deg[" + std::to_string(i) + "]";
    if (i == 2) {
      EXPECT_FALSE(all.contains(key));  // not a number: null in the array
      continue;
    }
    EXPECT_EQ(all.at(key), whole.at("angles_deg").at(i)) << key;
    all.erase(key);
  }
  whole.erase("angles_deg");
  EXPECT_EQ(all, whole);
}

// Series of 3, 64 and 2 columns: the second one alone is too long.
TEST(Datagrams, LargeSeriesAreDividedBetweenTheirColumns) {
  LiveResults results = largeResults(1, 2);
  for (const auto& [name, count] :
       {std::pair("wrist", 3), std::pair("skin", 64), std::pair("imu", 2)}) {
    SeriesDescription series{name, "", {}, ""};
    Sample sample{1, {}, kHandSeries + results.further.size()};
    for (int i = 0; i < count; ++i) {
      series.columns.push_back({"column \"" + std::to_string(i) + "\",:{", ""});
      sample.values.push_back(-1.2345678901234567e-100 * (i + 1));
    }
    results.further.push_back(
        {std::make_shared<const SeriesDescription>(std::move(series)), std::move(sample)});
  }
  const Whole given = wholeOf(results);
  const Parsed whole = Parsed::parse(given.text);
  Parsed series = Parsed::object();
  std::size_t numWithSeries = 0;
  for (const std::string& part : given.datagrams()) {
    EXPECT_LE(part.size(), kMaxDatagramBytes);
    const Parsed object = Parsed::parse(part);
    EXPECT_EQ(object.at("sequence"), 7);
    if (!object.contains("series")) continue;
    ++numWithSeries;
    for (const auto& [name, columns] : object.at("series").items())
      for (const auto& [column, value] : columns.items()) {
        EXPECT_FALSE(series[name].contains(column)) << column;
        series[name][column] = value;
      }
  }
  EXPECT_GT(numWithSeries, 2u);
  EXPECT_EQ(series, whole.at("series"));
}

TEST(Datagrams, TaxelMessagesHoldWholeMatrices) {
  const LiveResults results = largeResults(40, 0);
  const auto parts = tactileSensorMessages(*results.frame, 9, kMaxDatagramBytes);
  std::string text;
  appendTactileSensorJson(text, *results.frame, 9);
  const Parsed whole = Parsed::parse(text);
  Parsed matrices = Parsed::array();
  for (const std::string& part : parts) {
    EXPECT_LE(part.size(), kMaxDatagramBytes);
    const Parsed message = Parsed::parse(part);
    EXPECT_EQ(message.at("header"), whole.at("header"));
    for (const Parsed& matrix : message.at("tactile_matrix")) matrices.push_back(matrix);
  }
  EXPECT_GT(parts.size(), 2u);
  EXPECT_EQ(matrices, whole.at("tactile_matrix"));
}

// 1024 taxels of four digits: more than 1400 bytes.
TEST(Datagrams, AMatrixThatDoesNotFitHasAMessageOfItsOwn) {
  std::vector<MatrixLayout> matrices{MatrixLayout::full(2, 2, 1.0),
                                     MatrixLayout::full(32, 32, 1.0),
                                     MatrixLayout::full(2, 2, 1.0)};
  TactileFrame frame(std::make_shared<const SensorLayout>(std::move(matrices)));
  for (float& value : frame.values) value = 1000.0F;
  const auto parts = tactileSensorMessages(frame, 0, kMaxDatagramBytes);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(Parsed::parse(parts[1]).at("tactile_matrix").at(0).at("matrix_id").get<int>(), 1);
  EXPECT_GT(parts[1].size(), kMaxDatagramBytes);
}

}  // namespace
}  // namespace palpate::datagrams_test
