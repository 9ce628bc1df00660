#include "palpate/batch/batch_task.h"
