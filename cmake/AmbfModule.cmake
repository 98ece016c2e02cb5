# One folder, one target.

# ambf_add_module(<name> [LIBRARY core|view] [ARITHMETIC] SOURCES ... [USES other modules]
#                 [PRIVATE third-party libraries] [PRECOMPILED headers that most sources include])
# An object library ambf_<name>, part of libambf_core.so (the default) or libambf_view.so. Its headers are included as
# "<name>/x.h". Third-party packages stay private: their headers never appear in a public header of ours.
# ARITHMETIC: computes in long loops, and is optimised accordingly (AmbfOptions.cmake).
function(ambf_add_module name)
  cmake_parse_arguments(ARG "ARITHMETIC" "LIBRARY" "SOURCES;USES;PRIVATE;PRECOMPILED" ${ARGN})
  if(NOT ARG_LIBRARY)
    set(ARG_LIBRARY core)
  endif()
  add_library(ambf_${name} OBJECT ${ARG_SOURCES})
  target_include_directories(ambf_${name} PUBLIC ${PROJECT_SOURCE_DIR}/ambf_framework)
  target_link_libraries(ambf_${name} PRIVATE ambf_options ${ARG_PRIVATE})
  if(ARG_ARITHMETIC)
    target_compile_options(ambf_${name} PRIVATE ${AMBF_ARITHMETIC_OPTIONS})
  endif()
  if(NOT ARG_ARITHMETIC OR ARG_PRECOMPILED)  # headers are compiled for one set of options
    ambf_precompile(ambf_${name} ambf_module_headers ${ARG_PRECOMPILED})
  endif()
  ambf_compile_together(ambf_${name})
  # Only the layers below are named; object code is gathered once, in one of the two shared libraries.
  foreach(used ${ARG_USES})
    add_dependencies(ambf_${name} ambf_${used})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY AMBF_OBJECTS_${ARG_LIBRARY} $<TARGET_OBJECTS:ambf_${name}>)
  set_property(GLOBAL APPEND PROPERTY AMBF_THIRD_PARTY_${ARG_LIBRARY} ${ARG_PRIVATE})
endfunction()

# ambf_add_test(<name> SOURCES ... [PRIVATE libraries] [LABELS tsan] [TIMEOUT s] [SHARDS n] [SERIAL] [CXX17])
# A GoogleTest program that links libambf_core.so as users do; tests of render/ name ambf_view among their libraries.
# ctest runs it as one process (tests/support/run_gtest.py). SHARDS: n processes, each with its part of the tests.
# SERIAL: nothing else runs beside it, for tests that compare times.
# CXX17: for sources that include ROS headers, which do not compile as C++20.
# LABELS takes one label. tsan: CI runs it under ThreadSanitizer too. The target ambf_tests_<label> builds all programs
# of a label.
function(ambf_add_test name)
  cmake_parse_arguments(ARG "SERIAL;CXX17" "TIMEOUT;LABELS;SHARDS" "SOURCES;PRIVATE" ${ARGN})
  ambf_join_tests(sources ${name} ${ARG_SOURCES})
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ambf_test_options ambf_core ${ARG_PRIVATE} GTest::gtest_main)
  if(AMBF_TOGETHER)
    target_compile_options(${name} PRIVATE ${AMBF_TOGETHER_WARNINGS})
  endif()
  if(ARG_CXX17)
    set_target_properties(${name} PROPERTIES CXX_STANDARD 17)
  else()
    ambf_precompile(${name} ambf_test_headers)
  endif()
  add_dependencies(ambf_gtests ${name})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  if(AMBF_SANITIZER)
    math(EXPR ARG_TIMEOUT "8 * ${ARG_TIMEOUT}")  # ThreadSanitizer slows long runs of physics that much
  endif()
  set(properties)
  if(ARG_SERIAL)
    list(APPEND properties RUN_SERIAL TRUE)
  endif()
  if(ARG_LABELS)
    list(APPEND properties LABELS ${ARG_LABELS})
    if(NOT TARGET ambf_tests_${ARG_LABELS})
      add_custom_target(ambf_tests_${ARG_LABELS})
    endif()
    add_dependencies(ambf_tests_${ARG_LABELS} ${name})
  endif()
  set(command ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/support/run_gtest.py $<TARGET_FILE:${name}>
              --timeout ${ARG_TIMEOUT})
  if(NOT ARG_SHARDS)
    set(ARG_SHARDS 1)
  endif()
  foreach(shard RANGE 1 ${ARG_SHARDS})
    set(test ${name})
    if(ARG_SHARDS GREATER 1)
      string(APPEND test -${shard})
    endif()
    add_test(NAME ${test} COMMAND ${command} --shard ${shard}/${ARG_SHARDS})
    math(EXPR ctest_timeout "${ARG_TIMEOUT} + 60")  # the program's own comes first and ends it properly
    set_tests_properties(${test} PROPERTIES TIMEOUT ${ctest_timeout} ${properties})
  endforeach()
endfunction()
