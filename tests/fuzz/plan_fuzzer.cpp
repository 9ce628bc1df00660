// Fuzzes plans of recordings, as the table that a user imports and as the JSON that the settings
// keep: what is taken keeps the limits and reads back as it was written.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "palpate/capture/recording_plan.h"
#include "palpate/core/csv_rows.h"
#include "palpate/core/error.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

void readTable(const std::string& text) {
  const PlanTable table = readPlanTable(text);
  require(table.rows.size() <= RecordingPlan::kMaxRows);
  // And the one that says that there are too many rows.
  require(table.problems.size() <= kMaximumTableProblems + 1);
  RecordingPlan plan;
  for (const PlanRow& row : table.rows) plan.addRow(row);
  require(RecordingPlan::fromJson(plan.json()) == plan);
  require(readPlanTable(planCsv(plan)).problems.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    readTable(text);
  } catch (const Error&) {
  }
  try {
    const RecordingPlan plan = RecordingPlan::fromJson(text);
    require(plan.rows().size() <= RecordingPlan::kMaxRows);
    require(RecordingPlan::fromJson(plan.json()) == plan);
    plan.next();
  } catch (const Error&) {
  }
  return 0;
}
