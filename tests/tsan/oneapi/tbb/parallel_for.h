#include "../../tbb/threads.h"
