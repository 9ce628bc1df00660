#include "gui/appearance/named_items.h"

#include "testing/testing.h"

namespace palpate::gui::named_items_test {
namespace {

class NamedItemsTest : public ::testing::Test {
 protected:
  NamedItems<int> items(const QString& group) {
    return {settings_,
            group,
            [](const int& item) { return std::to_string(item); },
            [](const std::string& text) {
              if (text != "1" && text != "2") throw Error("neither 1 nor 2");
              return text == "1" ? 1 : 2;
            }};
  }
  testing::TemporaryFolder folder_;
  QSettings settings_{QString::fromStdString((folder_ / "a.ini").string()), QSettings::IniFormat};
};

TEST_F(NamedItemsTest, AreKeptByNameInTheirGroup) {
  items("hands/a").save("soft / ü", 1);
  items("hands/a").save("Rest", 1);
  items("hands/a").save("Rest", 2);
  EXPECT_EQ(items("hands/a").names(), (QStringList{"Rest", "soft / ü"}));
  EXPECT_EQ(items("hands/a").load("soft / ü"), 1);
  EXPECT_EQ(items("hands/a").load("Rest"), 2);
  EXPECT_TRUE(items("hands/b").names().isEmpty());
  EXPECT_EQ(settings_.value("hands/a/soft%20%2F%20%C3%BC"), "1");
  items("hands/a").remove("soft / ü");
  EXPECT_EQ(items("hands/a").names(), QStringList{"Rest"});
}

TEST_F(NamedItemsTest, OneThatIsMissingOrCantBeReadIsNothing) {
  settings_.setValue("a/damaged", "3");
  EXPECT_EQ(items("a").load("damaged"), std::nullopt);
  EXPECT_EQ(items("a").load("other"), std::nullopt);
  EXPECT_EQ(items("a").names(), QStringList{"damaged"}) << "so that it can be removed";
}

}  // namespace
}  // namespace palpate::gui::named_items_test
