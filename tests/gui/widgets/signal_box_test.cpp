#include "gui/widgets/signal_box.h"

#include <gtest/gtest.h>

namespace palpate::gui::signal_box_test {
namespace {

TEST(SignalBox, OffersComponentsWhereThereAreReadings) {
  QComboBox box;
  offerSignals(box, true);
  ASSERT_EQ(box.count(), 11);
  for (int i = 0; i < box.count(); ++i) {
    const PlottedSignal signal = kAllPlottedSignals.at(static_cast<std::size_t>(i));
    EXPECT_EQ(box.itemText(i), nameOf(signal));
    EXPECT_EQ(plottedSignalFrom(nameOf(signal)), signal);
    EXPECT_FALSE(box.itemData(i, Qt::ToolTipRole).toString().isEmpty());
  }
  box.setCurrentText("maximum");
  offerSignals(box, false);
  EXPECT_EQ(box.count(), 7);
  EXPECT_EQ(box.currentText(), "maximum") << "what is chosen stays";
}

TEST(SignalBox, WithoutReadingsTheSumStandsForAComponent) {
  EXPECT_EQ(plottable(PlottedSignal::kZ, true), PlottedSignal::kZ);
  EXPECT_EQ(plottable(PlottedSignal::kZ, false), PlottedSignal::kSum);
  EXPECT_EQ(plottable(PlottedSignal::kMean, false), PlottedSignal::kMean);
}

}  // namespace
}  // namespace palpate::gui::signal_box_test
