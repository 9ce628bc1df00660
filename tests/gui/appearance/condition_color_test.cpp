#include "gui/appearance/condition_color.h"

#include <cmath>
#include <set>

#include "testing/testing.h"

namespace palpate::gui::condition_color_test {
namespace {

// Relative luminance and contrast as WCAG 2.1 defines them.
double luminance(const QColor& color) {
  const auto linear = [](double value) {
    return value <= 0.03928 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}

double contrast(const QColor& a, const QColor& b) {
  const double lighter = std::max(luminance(a), luminance(b));
  const double darker = std::min(luminance(a), luminance(b));
  return (lighter + 0.05) / (darker + 0.05);
}

TEST(ConditionColor, IsOneForEachConditionAndCanBeRead) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    std::set<QString> names;
    for (const HandCondition each : kAllHandConditions) {
      const QColor color = conditionColor(each, theme);
      names.insert(color.name());
      EXPECT_GE(contrast(color, colorsOf(theme).panel), 4.5) << nameOf(each);
      EXPECT_GE(contrast(color, colorsOf(theme).window), 4.5) << nameOf(each);
    }
    EXPECT_EQ(names.size(), kAllHandConditions.size());
  }
}

}  // namespace
}  // namespace palpate::gui::condition_color_test
