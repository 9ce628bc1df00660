#include "palpate/kinematics/contact_rows.h"

#include <gtest/gtest.h>

#include "palpate/model/profile_builder.h"

#include "testing/sdh2.h"

namespace palpate::contact_rows_test {
namespace {

const std::vector<double> kStraight(7, 0.0);

// Three frames: nothing, one taxel of matrix 0 with 16, and another one.
Profile threeFrames(std::vector<double> anglesDeg = kStraight) {
  ProfileBuilder builder(sdh2().layout);
  builder.addAngles(900'000, std::move(anglesDeg));
  TactileFrame frame(sdh2().layout);
  builder.addFrame(1'000'000, frame.values);
  frame.matrix(0)(5, 2) = 16.0F;
  builder.addFrame(1'031'000, frame.values);
  frame.matrix(0)(0, 0) = 8.0F;
  builder.addFrame(1'062'000, frame.values);
  return builder.finish({});
}

std::string csvOf(ResultTable& table) {
  std::string csv;
  writeTableText(table, {}, [&](const std::string& text) { csv += text; });
  return csv;
}

TEST(ContactRows, areOneForEachFrame) {
  const auto table = contactTable(threeFrames(), sdh2Geometry());
  std::vector<Cell> cells;
  ASSERT_TRUE(table->next(cells));
  ASSERT_EQ(cells.size(), 8u);
  EXPECT_EQ(std::get<std::int64_t>(cells[1]), 1000);
  EXPECT_EQ(numberOf(cells[2]), 0.0);
  for (std::size_t i = 3; i < 8; ++i)
    EXPECT_TRUE(std::holds_alternative<std::monostate>(cells[i])) << i;
  // The sphere around one taxel is the taxel.
  ASSERT_TRUE(table->next(cells));
  EXPECT_EQ(numberOf(cells[2]), 1.0);
  EXPECT_NEAR(std::get<double>(cells[6]), 0.0, 1e-9);
  const HandGeometry geometry(sdh2Geometry());
  EXPECT_NEAR(std::get<double>(cells[5]),
              contactOf(threeFrames().frame(1), geometry.pose(kStraight)).centroidMm->z(),
              1e-9);
  ASSERT_TRUE(table->next(cells));
  EXPECT_FALSE(table->next(cells));
  EXPECT_TRUE(table->notes().empty());
  EXPECT_TRUE(table->problems().empty());
}

TEST(ContactRows, canBeOneForEachMatrix) {
  const std::string csv = csvOf(
      *contactTable(threeFrames(), sdh2Geometry(), {.matrices = true, .first = 1, .last = 1}));
  EXPECT_EQ(csv.find("frame,time_ms,matrix,active,sum,area_mm2,centroid_x_mm,centroid_y_mm,"
                     "centroid_z_mm,nx,ny,nz,major_x,major_y,major_z,major_sd_mm,minor_x,minor_y,"
                     "minor_z,minor_sd_mm,surface_x_mm,surface_y_mm\n1,1031,0,1,16,11.5"),
            0u)
      << csv;
  EXPECT_NE(csv.find("\n1,1031,5,0,0,0,,,,,,,,,,,,,,,,\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",6.8,17\n"), std::string::npos) << csv;  // column 2, row 5 of 3.4 mm
}

TEST(ContactRows, haveTheSphereAroundCentroidsWhereWanted) {
  const auto columns = frameContactColumns(true);
  EXPECT_EQ(columns.size(), frameContactColumns().size() + 4);
  ContactRun run(threeFrames(), sdh2Geometry(), {.first = 1, .last = 1});
  ASSERT_TRUE(run.next());
  const FrameContact row = contactOfFrame(run);
  EXPECT_EQ(row.frame, 1u);
  EXPECT_EQ(row.active, 1u);
  // The only centroid is the only taxel.
  for (const char* axis : {"x", "y", "z"})
    EXPECT_NEAR(
        numberOf(columnNamed(columns, std::string("centroid_sphere_") + axis + "_mm").cell(row)),
        numberOf(columnNamed(columns, std::string("sphere_") + axis + "_mm").cell(row)),
        1e-9);
  EXPECT_NEAR(numberOf(columnNamed(columns, "centroid_sphere_radius_mm").cell(row)), 0.0, 1e-9);
}

TEST(ContactRows, sayWhichAnglesAreWrong) {
  std::vector<double> far = kStraight;
  far[1] = 300.0;
  const auto outside = contactTable(threeFrames(far), sdh2Geometry());
  csvOf(*outside);
  ASSERT_EQ(outside->notes().size(), 1u);
  EXPECT_EQ(outside->notes()[0].find("3 of 3 frames have joint angles that the hand can't take"),
            0u);
  const auto given = contactTable(threeFrames(far), sdh2Geometry(), {.anglesDeg = kStraight});
  csvOf(*given);
  EXPECT_TRUE(given->notes().empty());
}

TEST(ContactRows, haveNoPlaceInSpaceWithoutAngles) {
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame(sdh2().layout);
  frame.matrix(0)(5, 2) = 16.0F;
  builder.addFrame(1'000'000, frame.values);
  const auto table = contactTable(builder.finish({}), sdh2Geometry());
  EXPECT_NE(csvOf(*table).find("\n0,1000,1,,,,,\n"), std::string::npos);
  ASSERT_EQ(table->problems().size(), 1u);
  EXPECT_EQ(table->problems()[0].find("1 of 1 frames have no usable joint angles, and no sphere: 0 "
                                      "joint angles for 7 axes"),
            0u);
}

TEST(ContactRows, haveTheForceThatIsGiven) {
  const auto force = [](const TactileFrame& frame) {
    return frame.hostUs == 1'000'000   ? ForceReading{std::nullopt, true}
           : frame.hostUs == 1'031'000 ? ForceReading{2.5}
                                       : ForceReading{};
  };
  const auto table =
      contactTable(threeFrames(), sdh2Geometry(), {.forceOf = force, .noForceText = "too much"});
  const std::string csv = csvOf(*table);
  EXPECT_NE(csv.find(",2.5\n"), std::string::npos);
  EXPECT_EQ(table->notes().size(), 1u);
  EXPECT_EQ(table->problems().at(0), "1 of 3 frames have no force_n: too much");
}

}  // namespace
}  // namespace palpate::contact_rows_test
