// setenv and unsetenv for tests on Windows: every test file includes this there.
#pragma once

#include <stdlib.h>

inline int setenv(const char* name, const char* value, int) { return _putenv_s(name, value); }
inline int unsetenv(const char* name) { return _putenv_s(name, ""); }
