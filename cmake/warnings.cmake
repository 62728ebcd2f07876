add_library(steradian_warnings INTERFACE)
target_compile_options(steradian_warnings INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion)
# g++ 12 sees overlapping copies in "text" + std::string (GCC bug 105651).
target_compile_options(steradian_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(STERADIAN_WERROR)
  target_compile_options(steradian_warnings INTERFACE -Werror)
endif()

# Tests mix float and double freely. Linked behind steradian_warnings, whose option it takes back.
add_library(steradian_test_warnings INTERFACE)
target_compile_options(steradian_test_warnings INTERFACE -Wno-double-promotion)
