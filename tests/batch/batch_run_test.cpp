#include "palpate/batch/batch_run.h"
