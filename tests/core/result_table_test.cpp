#include "palpate/core/result_table.h"

#include <cmath>

#include <gtest/gtest.h>

#include "palpate/core/json.h"

namespace palpate::result_table_test {
namespace {

struct Fruit {
  std::string name;
  std::int64_t count = 0;
  std::optional<double> grams;
  bool ripe = false;
};

std::vector<ColumnOf<Fruit>> columns() {
  return {columnOf<Fruit>("name", "", "", &Fruit::name),
          columnOf<Fruit>("count", "", "", &Fruit::count),
          columnOf<Fruit>("mass", "g", "of one", &Fruit::grams, 1),
          columnOf<Fruit>("ripe", "", "", &Fruit::ripe)};
}

const std::vector<Fruit> kFruits = {{"apple, red", 3, 150.04, true}, {"plum \"x\"", 0, {}, false}};

RowTable<Fruit> fruits() { return {"fruits", columns(), kFruits}; }

std::string textOf(ResultTable& table, const TableTextOptions& options) {
  std::string text;
  writeTableText(table, options, [&](const std::string& part) { text += part; });
  return text;
}

TEST(ResultTable, csvHasALineForEachRowAndLeavesUnknownCellsEmpty) {
  auto table = fruits();
  EXPECT_EQ(textOf(table, {}),
            "name,count,mass,ripe\n\"apple, red\",3,150.0,1\n\"plum \"\"x\"\"\",0,,0\n");
}

TEST(ResultTable, csvMayHaveARowOfUnits) {
  auto table = fruits();
  EXPECT_EQ(textOf(table, {.unitsRow = true}).find("name,count,mass,ripe\n,,g,\n"), 0U);
}

TEST(ResultTable, jsonIsOneObjectThatReadsBack) {
  auto table = fruits();
  const Json json = Json::parse(textOf(table, {.form = TableForm::kJson}));
  EXPECT_EQ(json.at("table").asString(), "fruits");
  EXPECT_EQ(json.at("columns").at(2).at("unit").asString(), "g");
  EXPECT_EQ(json.at("columns").at(3).at("kind").asString(), "flag");
  ASSERT_EQ(json.at("rows").size(), 2U);
  EXPECT_EQ(json.at("rows").at(0).at("name").asString(), "apple, red");
  EXPECT_EQ(json.at("rows").at(0).at("mass").asDouble(), 150.0);
  EXPECT_TRUE(json.at("rows").at(0).at("ripe").asBool());
  EXPECT_TRUE(json.at("rows").at(1).at("mass").isNull());
  RowTable<Fruit> none("fruits", columns(), std::vector<Fruit>());
  EXPECT_EQ(Json::parse(textOf(none, {.form = TableForm::kJson})).at("rows").size(), 0U);
}

TEST(ResultTable, jsonHasNullForWhatIsNotFinite) {
  const std::vector<ColumnOf<double>> column = {
      columnOf<double>("x", "", "", [](const double& value) { return value; })};
  RowTable<double> table("t", column, std::vector<double>{std::nan(""), INFINITY, 1.5});
  const Json rows = Json::parse(textOf(table, {.form = TableForm::kJson})).at("rows");
  EXPECT_TRUE(rows.at(0).at("x").isNull());
  EXPECT_TRUE(rows.at(1).at("x").isNull());
  EXPECT_EQ(rows.at(2).at("x").asDouble(), 1.5);
}

TEST(ResultTable, aColumnCanBeAddedToEveryRow) {
  auto table = fruits();
  const TableText text(table, {.addedName = "file"}, "a,b.dsa");
  std::string out = text.begin();
  std::vector<Cell> cells;
  ASSERT_TRUE(table.next(cells));
  text.appendRow(out, cells);
  EXPECT_EQ(out, "name,count,mass,ripe,file\n\"apple, red\",3,150.0,1,\"a,b.dsa\"\n");
}

TEST(ResultTable, rowsAreMadeInBatchesThatMayBeEmpty) {
  int calls = 0;
  RowTable<Fruit> table("fruits", columns(), [&](std::vector<Fruit>& rows) {
    if (++calls == 2) rows = kFruits;
    if (calls == 4) rows.push_back(kFruits[0]);
    return calls < 4;
  });
  std::vector<Cell> cells;
  std::size_t count = 0;
  while (table.next(cells)) ++count;
  EXPECT_EQ(count, 3U);
  EXPECT_FALSE(table.next(cells));
  EXPECT_EQ(calls, 4);
}

TEST(ResultTable, columnsOfAPartAreThoseOfThePart) {
  struct Stand {
    int number;
    Fruit fruit;
  };
  std::vector<ColumnOf<Stand>> all = {columnOf<Stand>("stand", "", "", &Stand::number)};
  appendColumns(all, columns(), [](const Stand& s) -> const Fruit& { return s.fruit; });
  EXPECT_EQ(columnsOf(all).size(), 5U);
  RowTable<Stand> table("stands", all, std::vector<Stand>{{7, kFruits[1]}});
  EXPECT_EQ(textOf(table, {}), "stand,name,count,mass,ripe\n7,\"plum \"\"x\"\"\",0,,0\n");
}

TEST(Cell, hasANumberWhereItIsOne) {
  EXPECT_EQ(numberOf(Cell(std::int64_t{-3})), -3.0);
  EXPECT_EQ(numberOf(Cell(2.5)), 2.5);
  EXPECT_EQ(numberOf(Cell(true)), 1.0);
  EXPECT_TRUE(std::isnan(numberOf(Cell())));
  EXPECT_TRUE(std::isnan(numberOf(Cell(std::string("2")))));
  EXPECT_EQ(knownIf(false, 1.0), std::nullopt);
  EXPECT_EQ(knownIf(true, 1.5), 1.5);
  const auto minus = columnOf<double>("x", "", "", [](const double&) { return -0.0; });
  EXPECT_FALSE(std::signbit(std::get<double>(minus.cell(1.0))));
}

}  // namespace
}  // namespace palpate::result_table_test
