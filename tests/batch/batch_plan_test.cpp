#include "palpate/batch/batch_plan.h"
