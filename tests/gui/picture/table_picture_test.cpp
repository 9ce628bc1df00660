#include "gui/picture/table_picture.h"

#include <QFont>
#include <QPainter>

#include "gui/picture/picture_export.h"
#include "testing/testing.h"

namespace palpate::gui::table_picture_test {
namespace {

TablePicture table(int rows) {
  TablePicture picture{.title = "ball.dsa", .caption = "frame 7", .header = {"matrix", "mean"}};
  for (int i = 0; i < rows; ++i) picture.rows.push_back({"finger", QString::number(100 * i)});
  return picture;
}

std::string svg(const TablePicture& picture, const PictureLook& look) {
  return pictureBytes(
             ImageFormat::kSvg,
             [&](QPainter& painter) { paintTable(painter, look, picture, QFont(), Theme::kDark); },
             {.size = look.size, .unitsPerInch = 144.0},
             "a.svg")
      .toStdString();
}

// The size of the first text, [units].
double textSize(const std::string& svg) {
  const auto at = svg.find("font-size=\"");
  return at == std::string::npos ? 0.0 : std::stod(svg.substr(at + 11));
}

TEST(TablePicture, HoldsEveryCellAsText) {
  const std::string text = svg(table(3), {.size = {400, 300}, .textUnits = 14});
  for (const char* part :
       {">ball.dsa<", ">frame 7<", ">matrix<", ">mean<", ">finger<", ">0<", ">100<", ">200<"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(text.find("<image"), std::string::npos);
  EXPECT_EQ(textSize(text), 14.0);
}

TEST(TablePicture, TextShrinksUntilItFits) {
  const std::string text = svg(table(20), {.size = {400, 280}, .textUnits = 14});
  EXPECT_LT(textSize(text), 14.0);
  EXPECT_NE(text.find(">1900<"), std::string::npos);
  // The last hairline lies within the picture.
  const auto line = text.rfind("points=\"");
  ASSERT_NE(line, std::string::npos);
  EXPECT_LT(std::stod(text.substr(text.find(',', line) + 1)), 280.0);
}

TEST(TablePicture, ColoursOfPaperOrTheme) {
  const auto ground = [](bool forPrint) {
    const PictureLook look{.size = {400, 300}, .forPrint = forPrint};
    return pictureImage(
               [&](QPainter& painter) {
                 paintTable(painter, look, table(2), QFont(), Theme::kDark);
               },
               {.size = look.size, .unitsPerInch = 96.0, .dpi = 96.0})
        .pixelColor(399, 299);
  };
  EXPECT_EQ(ground(true), QColor(Qt::white));
  EXPECT_EQ(ground(false), colorsOf(Theme::kDark).window);
}

TEST(TablePicture, OfNothingIsAnEmptySheet) {
  EXPECT_EQ(svg({}, {.size = {400, 300}}).find("<text"), std::string::npos);
}

}  // namespace
}  // namespace palpate::gui::table_picture_test
