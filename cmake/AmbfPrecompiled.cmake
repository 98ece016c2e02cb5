# Standard headers and GoogleTest's, compiled once (AMBF_PRECOMPILED): this halves the time of a build from nothing.
# ccache does not reuse objects that were built so.

# ambf_precompile(<target> <provider>): lets a C++20 target use the headers that the target <provider> has compiled.
function(ambf_precompile target provider)
  if(AMBF_PRECOMPILED)
    target_precompile_headers(${target} REUSE_FROM ${provider})
  endif()
endfunction()

if(NOT AMBF_PRECOMPILED)
  return()
endif()
set(headers <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdio> <cstring> <fstream> <functional> <map>
            <memory> <mutex> <optional> <set> <string> <string_view> <thread> <unordered_map> <utility> <variant>
            <vector>)
# One provider for position-independent libraries and one for programs: their flags differ.
file(CONFIGURE OUTPUT empty.cpp CONTENT "")
add_library(ambf_module_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
target_link_libraries(ambf_module_headers PRIVATE ambf_options)
target_precompile_headers(ambf_module_headers PRIVATE ${headers})
if(AMBF_BUILD_TESTS)
  add_executable(ambf_test_headers ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
  target_link_libraries(ambf_test_headers PRIVATE ambf_test_options GTest::gtest_main)
  target_precompile_headers(ambf_test_headers PRIVATE ${headers} <gtest/gtest.h>)
endif()
