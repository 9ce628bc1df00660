// Adds to a trained model what makes it traceable: program version, time, and the recordings it was
// trained with.
#pragma once

#include <vector>

#include "palpate/core/progress.h"
#include "palpate/recognition/trained_model.h"

namespace palpate::python {

// Stores program version and time in the model.
void stampProvenance(TrainedModel& model);
// The recordings of a table in the form that a model stores; none for profiles. Throws FileError,
// Cancelled.
std::vector<ModelInput> inputsFor(const FeatureTable& table, const Progress& progress);

}  // namespace palpate::python
