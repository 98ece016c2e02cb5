# Headers compiled once (AMBF_PRECOMPILED): a build from nothing takes half the time. ccache does not reuse objects that
# were built so. clang-tidy sees each file without them, so that missing includes are found (tests/checks).

# ambf_precompile(<target> <provider> [headers]): lets a target use the headers that the target <provider> has
# compiled; with headers, names below ambf_framework/ or <...> of a package, these and the standard ones, its own.
function(ambf_precompile target provider)
  if(NOT AMBF_PRECOMPILED)
    return()
  endif()
  if(ARGN)
    list(TRANSFORM ARGN REPLACE "^([^<].*)$" "${PROJECT_SOURCE_DIR}/ambf_framework/\\1" OUTPUT_VARIABLE own)
    target_precompile_headers(${target} PRIVATE ${AMBF_STANDARD_HEADERS} ${own})
  else()
    target_precompile_headers(${target} REUSE_FROM ${provider})
  endif()
endfunction()

if(NOT AMBF_PRECOMPILED)
  return()
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # gcc takes what it inlines from a precompiled header for ours, and warns of std::string's own copies.
  target_compile_options(ambf_options INTERFACE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()
set(AMBF_STANDARD_HEADERS
    <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdio> <cstring> <fstream> <functional> <map> <memory>
    <mutex> <optional> <set> <string> <string_view> <thread> <unordered_map> <utility> <variant> <vector>)
# One provider for position-independent libraries and one for programs: their flags differ.
file(CONFIGURE OUTPUT empty.cpp CONTENT "")
add_library(ambf_module_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
target_link_libraries(ambf_module_headers PRIVATE ambf_options)
target_include_directories(ambf_module_headers PRIVATE ${PROJECT_SOURCE_DIR}/ambf_framework)
ambf_precompile(ambf_module_headers none scene/description.h state/frame.h)
if(AMBF_BUILD_TESTS)
  add_executable(ambf_test_headers ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
  target_include_directories(ambf_test_headers PRIVATE ${PROJECT_SOURCE_DIR}/ambf_framework)
  target_link_libraries(ambf_test_headers PRIVATE ambf_test_options GTest::gtest_main)
  ambf_precompile(ambf_test_headers none adf/adf.h model/live_world.h physics/world.h runtime/simulation.h
                  <gtest/gtest.h>)
endif()

# The same for libraries that include ROS headers, which are C++17. (Tests of them include few.)
if(AMBF_WITH_ROS)
  add_library(ambf_ros_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
  set_target_properties(ambf_ros_headers PROPERTIES CXX_STANDARD 17)
  target_link_libraries(ambf_ros_headers PRIVATE ambf_options)
  target_include_directories(ambf_ros_headers PRIVATE ${PROJECT_SOURCE_DIR}/ambf_framework)
  target_include_directories(ambf_ros_headers SYSTEM PRIVATE ${roscpp_INCLUDE_DIRS})
  ambf_precompile(ambf_ros_headers none state/frame.h <ros/ros.h>)
endif()
