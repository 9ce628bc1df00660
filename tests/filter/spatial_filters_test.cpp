// The spatial filters against OpenCV, against independent numbers, and against textbook loops that
// honour masks.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <opencv2/imgproc.hpp>

#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"
#include "palpate/filter/frame_filter.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::spatial_filters_test {
namespace {

class Collector final : public FrameSink {
 public:
  void take(TactileFrame& frame) override { frames.push_back(frame); }
  std::vector<TactileFrame> frames;
};

TactileFrame filtered(const char* text, TactileFrame frame) {
  Collector out;
  const auto filter = makeFrameFilter(parseFilterStep(text), frame.layout);
  filter->push(frame, out);
  filter->finish(out);
  EXPECT_EQ(out.frames.size(), 1u);
  return out.frames.at(0);
}

std::shared_ptr<const SensorLayout> fullHand() {
  std::vector<MatrixLayout> matrices;
  for (const MatrixLayout& matrix : sdh2().layout->matrices())
    matrices.push_back(MatrixLayout::full(matrix.rows, matrix.columns, matrix.pitchMm));
  return std::make_shared<const SensorLayout>(std::move(matrices));
}

// Speckles and broad contacts, as counts; taxels without sensor are 0 unless `poison`.
TactileFrame randomFrame(std::shared_ptr<const SensorLayout> layout,
                         unsigned seed,
                         bool poison = false) {
  std::mt19937 random(seed);
  TactileFrame frame(layout);
  for (float& value : frame.values)
    value = random() % 3 ? static_cast<float>(random() % 4096) : 0.0F;
  for (std::size_t m = 0; m < layout->numMatrices(); ++m)
    for (int y = 0; y < layout->matrix(m).rows; ++y)
      for (int x = 0; x < layout->matrix(m).columns; ++x)
        if (!layout->matrix(m).enabled(y, x)) frame.matrix(m)(y, x) = poison ? 9999.0F : 0.0F;
  return frame;
}

cv::Mat matOf(TactileFrame& frame, std::size_t m) {
  const MatrixLayout& layout = frame.layout->matrix(m);
  return {layout.rows, layout.columns, CV_32F, frame.values.data() + frame.layout->offset(m)};
}

void expectSame(TactileFrame& result,
                TactileFrame input,
                const std::function<void(const cv::Mat&, cv::Mat&)>& reference,
                double tolerance,
                const char* text) {
  for (std::size_t m = 0; m < input.layout->numMatrices(); ++m) {
    cv::Mat expected;
    reference(matOf(input, m), expected);
    const cv::Mat got = matOf(result, m);
    for (int y = 0; y < expected.rows; ++y)
      for (int x = 0; x < expected.cols; ++x)
        ASSERT_NEAR(got.at<float>(y, x), expected.at<float>(y, x), tolerance)
            << text << ": matrix " << m << ", row " << y << ", column " << x;
  }
}

TEST(SpatialFilters, AgreeWithOpenCvWhereNothingIsMasked) {
  struct Case {
    const char* text;
    std::function<void(const cv::Mat&, cv::Mat&)> reference;
    double tolerance;
  };
  const int border = cv::BORDER_REPLICATE;
  const auto opening = [border](int shape, int size) {
    return [=](const cv::Mat& in, cv::Mat& out) {
      cv::morphologyEx(in,
                       out,
                       cv::MORPH_OPEN,
                       cv::getStructuringElement(shape, {size, size}),
                       {-1, -1},
                       1,
                       border);
    };
  };
  const std::vector<Case> cases = {
      {"box",
       [=](auto& in, auto& out) {
         cv::blur(in, out, {3, 3}, {-1, -1}, border);
       },
       2e-3},
      {"box:size=7",
       [=](auto& in, auto& out) {
         cv::blur(in, out, {7, 7}, {-1, -1}, border);
       },
       2e-3},
      {"gaussian",
       [=](auto& in, auto& out) {
         cv::GaussianBlur(in, out, {3, 3}, 2 / 2.3548, 0, border);
       },
       2e-3},
      {"gaussian:size=9,sigma=1.7",
       [=](auto& in, auto& out) {
         cv::GaussianBlur(in, out, {9, 9}, 1.7, 0, border);
       },
       2e-3},
      {"median", [](auto& in, auto& out) { cv::medianBlur(in, out, 3); }, 0},
      {"median:size=5", [](auto& in, auto& out) { cv::medianBlur(in, out, 5); }, 0},
      {"bilateral:diameter=3,sigma_value=1000,sigma_space=1000",
       [=](auto& in, auto& out) { cv::bilateralFilter(in, out, 3, 1000, 1000, border); },
       0.2},
      {"bilateral:diameter=7,sigma_value=400,sigma_space=2",
       [=](auto& in, auto& out) { cv::bilateralFilter(in, out, 7, 400, 2, border); },
       0.2},
      {"opening", opening(cv::MORPH_CROSS, 3), 0},
      {"opening:shape=cross,size=5", opening(cv::MORPH_CROSS, 5), 0},
      {"opening:shape=rectangle", opening(cv::MORPH_RECT, 3), 0},
      {"opening:shape=rectangle,size=5", opening(cv::MORPH_RECT, 5), 0},
      {"opening:shape=ellipse,size=5", opening(cv::MORPH_ELLIPSE, 5), 0},
      {"opening:shape=ellipse,size=7", opening(cv::MORPH_ELLIPSE, 7), 0},
      {"opening:shape=ellipse,size=9", opening(cv::MORPH_ELLIPSE, 9), 0},
  };
  for (const Case& one : cases) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const TactileFrame input = randomFrame(fullHand(), seed);
      TactileFrame result = filtered(one.text, input);
      expectSame(result, input, one.reference, one.tolerance, one.text);
    }
  }
}

TEST(SpatialFilters, EqualTheIndependentNumbers) {
  const auto folder = testing::goldenFolder();
  PALPATE_NEED(folder);
  const Json settings = Json::parse(testing::readFile(*folder / "filters.json"));
  const auto layout = fullHand();  // the numbers read the masked corners as zeros
  const auto frameOf = [&](const Json& setting) {
    TactileFrame frame(layout);
    for (std::size_t i = 0; i < frame.values.size(); ++i)
      frame.values[i] = static_cast<float>(setting.at("cells").at(i).asDouble());
    return frame;
  };
  const TactileFrame input = frameOf(settings.at(0));
  int compared = 0;
  for (std::size_t s = 1; s < settings.size(); ++s) {
    const Json params = settings.at(s).at("params");
    std::string name = settings.at(s).at("filter").asString();
    if (name == "median3d") continue;  // of three frames, of which one is there
    std::string text = name;
    text += name == "bilateral" ? ":diameter=" : ":size=";
    text += std::to_string(2 * params.at("radius").asInteger() + 1);
    if (params.contains("sigma")) text += ",sigma=" + std::to_string(params.at("sigma").asDouble());
    if (params.contains("sigma_color"))
      text += ",sigma_value=" + std::to_string(params.at("sigma_color").asDouble()) +
              ",sigma_space=" + std::to_string(params.at("sigma_space").asDouble());
    if (params.contains("kernel")) {
      const std::string kernel = params.at("kernel").asString();
      text += ",shape=" + (kernel == "rect" ? std::string("rectangle") : kernel);
    }
    if (params.contains("masked") && params.at("masked").asBool()) text += ",masked=1";
    const TactileFrame expected = frameOf(settings.at(s));
    const TactileFrame result = filtered(text.c_str(), input);
    const double tolerance = name == "bilateral" ? 0.1 : name == "gaussian" ? 1e-3 : 0.0;
    for (std::size_t i = 0; i < result.values.size(); ++i)
      ASSERT_NEAR(result.values[i], expected.values[i], tolerance) << text << " place " << i;
    ++compared;
  }
  EXPECT_EQ(compared, 13);
}

// What a filter should make of one taxel, from the values around it: written down once more,
// slowly.
using Around = std::function<float(int dy, int dx, bool& on)>;
using Textbook = std::function<double(const Around&)>;

double weightedMean(const Around& around,
                    int radius,
                    const std::function<double(int, int, float)>& weigh) {
  double sum = 0.0;
  double total = 0.0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      bool on = false;
      const float value = around(dy, dx, on);
      if (!on) continue;
      const double weight = weigh(dy, dx, value);
      sum += weight * static_cast<double>(value);
      total += weight;
    }
  }
  return sum / total;
}

double lowerMiddle(const Around& around, int radius) {
  std::vector<float> values;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      bool on = false;
      const float value = around(dy, dx, on);
      if (on) values.push_back(value);
    }
  }
  std::sort(values.begin(), values.end());
  return static_cast<double>(values[(values.size() - 1) / 2]);
}

double nonLocal(const Around& around, int patch, int search, double h) {
  return weightedMean(around, search, [&](int dy, int dx, float) {
    double squares = 0.0;
    int count = 0;
    for (int py = -patch; py <= patch; ++py) {
      for (int px = -patch; px <= patch; ++px) {
        bool onHere = false;
        bool onThere = false;
        const double difference = static_cast<double>(around(py, px, onHere)) -
                                  static_cast<double>(around(dy + py, dx + px, onThere));
        if (!onHere || !onThere) continue;
        squares += difference * difference;
        ++count;
      }
    }
    return std::exp(-squares / count / (h * h));
  });
}

double bilateral(const Around& around, int radius, double sigmaValue, double sigmaSpace) {
  bool on = false;
  const double own = static_cast<double>(around(0, 0, on));
  return weightedMean(around, radius, [&](int dy, int dx, float value) {
    const int squared = dy * dy + dx * dx;
    if (squared > radius * radius) return 0.0;
    const double difference = static_cast<double>(value) - own;
    return std::exp(-squared / (2 * sigmaSpace * sigmaSpace) -
                    difference * difference / (2 * sigmaValue * sigmaValue));
  });
}

TEST(SpatialFilters, MaskedTaxelsAreNeitherReadNorWritten) {
  // The fingertips have two corners cut off; besides, a third of the taxels is switched off.
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  std::mt19937 random(7);
  for (std::uint8_t& scanned : matrices[3].dynamicMask) scanned = random() % 3 != 0;
  // Smaller than a window, and as wide as one block of eight taxels, or a little wider.
  for (const auto& [rows, columns] : {std::pair(1, 1), {1, 9}, {9, 1}, {3, 8}, {5, 17}, {4, 15}})
    matrices.push_back(MatrixLayout::full(rows, columns, 3.4));
  for (std::uint8_t& scanned : matrices.back().dynamicMask) scanned = random() % 3 != 0;
  const auto layout = std::make_shared<const SensorLayout>(matrices);
  const std::vector<std::pair<const char*, Textbook>> cases = {
      {"box", [](auto& a) { return weightedMean(a, 1, [](int, int, float) { return 1.0; }); }},
      {"box:size=5",
       [](auto& a) { return weightedMean(a, 2, [](int, int, float) { return 1.0; }); }},
      {"gaussian:size=5,sigma=1.2",
       [](auto& a) {
         return weightedMean(a, 2, [](int dy, int dx, float) {
           return std::exp(-(dy * dy + dx * dx) / (2 * 1.2 * 1.2));
         });
       }},
      {"median", [](auto& a) { return lowerMiddle(a, 1); }},
      {"median:size=5", [](auto& a) { return lowerMiddle(a, 2); }},
      {"bilateral:diameter=3,sigma_value=900,sigma_space=2",
       [](auto& a) { return bilateral(a, 1, 900, 2); }},
      {"bilateral:diameter=5,sigma_value=700,sigma_space=1.5",
       [](auto& a) { return bilateral(a, 2, 700, 1.5); }},
      {"bilateral:diameter=9,sigma_value=2000,sigma_space=4",
       [](auto& a) { return bilateral(a, 4, 2000, 4); }},
      {"nlm:patch=3,search=5,h=900", [](auto& a) { return nonLocal(a, 1, 2, 900); }},
      {"nlm:patch=3,search=9,h=1500", [](auto& a) { return nonLocal(a, 1, 4, 1500); }},
      {"nlm:patch=5,search=3,h=2000", [](auto& a) { return nonLocal(a, 2, 1, 2000); }},
  };
  for (const auto& [text, textbook] : cases) {
    const TactileFrame input = randomFrame(layout, 3, true);
    const TactileFrame result = filtered(text, input);
    for (std::size_t m = 0; m < layout->numMatrices(); ++m) {
      const MatrixLayout& matrix = layout->matrix(m);
      for (int y = 0; y < matrix.rows; ++y) {
        for (int x = 0; x < matrix.columns; ++x) {
          const float own = input.matrix(m)(y, x);
          const float got = result.matrix(m)(y, x);
          if (!matrix.enabled(y, x)) {
            EXPECT_EQ(got, own) << text << ": written, matrix " << m << " row " << y << " column "
                                << x;
            continue;
          }
          const Around around = [&, y = y, x = x](int dy, int dx, bool& on) {
            const int fromY = std::clamp(y + dy, 0, matrix.rows - 1);
            const int fromX = std::clamp(x + dx, 0, matrix.columns - 1);
            on = matrix.enabled(fromY, fromX);
            return input.matrix(m)(fromY, fromX);
          };
          const double expected = textbook(around);
          ASSERT_NEAR(got, expected, 1e-3 + 1e-6 * expected)
              << text << ": matrix " << m << " row " << y << " column " << x;
        }
      }
    }
  }
}

TEST(SpatialFilters, OpeningHonoursMasks) {
  // A bar of three in the last row that the mask leaves: what is masked erodes nothing.
  std::vector<MatrixLayout> one = {MatrixLayout::full(5, 5, 1.0)};
  for (int x = 0; x < 5; ++x)
    one[0].staticMask[static_cast<std::size_t>(x)] = 0;  // row 0 isn't there
  const auto layout = std::make_shared<const SensorLayout>(one);
  TactileFrame frame(layout);
  for (int y = 1; y <= 2; ++y)
    for (int x = 1; x <= 3; ++x) frame.matrix(0)(y, x) = 100.0F;
  const TactileFrame kept = filtered("opening:shape=rectangle", frame);
  EXPECT_EQ(kept.values, frame.values);
  // On a full matrix the row above is empty, and the bar of two rows vanishes.
  TactileFrame whole(std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(5, 5, 1.0)}));
  whole.values = frame.values;
  for (const float value : filtered("opening:shape=rectangle", whole).values)
    EXPECT_EQ(value, 0.0F);
}

TEST(SpatialFilters, MaskedKeepsTheOriginalOrNothing) {
  for (const char* name :
       {"box", "gaussian", "median", "median:size=5", "bilateral", "nlm", "opening"}) {
    const std::string text(name);
    const TactileFrame input = randomFrame(sdh2().layout, 11);
    const TactileFrame plain = filtered(name, input);
    const TactileFrame masked = filtered(
        (text + (text.find(':') == std::string::npos ? ":" : ",") + "masked=1").c_str(), input);
    for (std::size_t i = 0; i < input.values.size(); ++i)
      ASSERT_EQ(masked.values[i], plain.values[i] > 0.0F ? input.values[i] : 0.0F)
          << name << " " << i;
  }
}

TEST(SpatialFilters, AConstantStaysAndALoneTaxelSpreadsByTheKernel) {
  for (const char* name : {"box:size=5", "gaussian", "median", "bilateral", "nlm", "opening"}) {
    TactileFrame frame(sdh2().layout);
    for (std::size_t m = 0; m < 6; ++m)
      for (int y = 0; y < frame.layout->matrix(m).rows; ++y)
        for (int x = 0; x < 6; ++x)
          if (frame.layout->matrix(m).enabled(y, x)) frame.matrix(m)(y, x) = 1234.0F;
    const TactileFrame result = filtered(name, frame);
    for (std::size_t i = 0; i < frame.values.size(); ++i)
      ASSERT_NEAR(result.values[i], frame.values[i], 1e-3) << name << " " << i;
  }
  TactileFrame lone(fullHand());
  lone.matrix(2)(7, 3) = 900.0F;
  EXPECT_NEAR(filtered("box", lone).matrix(2)(6, 2), 100.0F, 1e-3);
  EXPECT_EQ(filtered("box", lone).matrix(2)(5, 3), 0.0F);
  EXPECT_EQ(filtered("median", lone).matrix(2)(7, 3), 0.0F);
  EXPECT_EQ(filtered("opening", lone).matrix(2)(7, 3), 0.0F);
}

TEST(SpatialFilters, WorkOnTheMatricesAskedFor) {
  const TactileFrame input = randomFrame(sdh2().layout, 5);
  const TactileFrame all = filtered("median", input);
  const TactileFrame some = filtered("median:matrices=1+4", input);
  for (std::size_t m = 0; m < 6; ++m)
    EXPECT_EQ(some.matrix(m), (m == 1 || m == 4 ? all : input).matrix(m)) << m;
  EXPECT_THROW(makeFrameFilter(parseFilterStep("median:matrices=6"), sdh2().layout),
               std::invalid_argument);
}

TEST(SpatialFilters, MatricesOfAnySizeAreFiltered) {
  for (const auto& [rows, columns] :
       {std::pair{1, 1}, {1, 9}, {20, 1}, {3, 8}, {7, 17}, {64, 33}}) {
    const auto layout = std::make_shared<const SensorLayout>(
        std::vector<MatrixLayout>{MatrixLayout::full(rows, columns, 2.0)});
    const TactileFrame input = randomFrame(layout, static_cast<unsigned>(rows * columns));
    TactileFrame median = filtered("median", input);
    expectSame(
        median,
        input,
        [](auto& in, auto& out) {
          // OpenCV's median wants at least two columns: repeat the border by hand.
          cv::Mat wide;
          cv::copyMakeBorder(in, wide, 1, 1, 1, 1, cv::BORDER_REPLICATE);
          cv::Mat result;
          cv::medianBlur(wide, result, 3);
          out = result(cv::Rect(1, 1, in.cols, in.rows)).clone();
        },
        0,
        "median");
    TactileFrame box = filtered("box:size=5", input);
    expectSame(
        box,
        input,
        [](auto& in, auto& out) {
          cv::blur(in, out, {5, 5}, {-1, -1}, cv::BORDER_REPLICATE);
        },
        2e-3,
        "box");
  }
}

}  // namespace
}  // namespace palpate::spatial_filters_test
