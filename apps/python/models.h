// What makes a model one that can be traced: who made it when, of which recordings.
#pragma once

#include <vector>

#include "palpate/core/progress.h"
#include "palpate/recognition/trained_model.h"

namespace palpate::python {

// Program version and time.
void stampProvenance(TrainedModel& model);
// Recordings of a table as a model names them; of profiles there are none. Throws FileError,
// Cancelled.
std::vector<ModelInput> inputsFor(const FeatureTable& table, const Progress& progress);

}  // namespace palpate::python
