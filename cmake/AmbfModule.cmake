# One folder, one target.

# ambf_add_module(<name> [LIBRARY core|view] SOURCES ... [USES other modules] [PRIVATE third-party libraries])
# An object library ambf_<name>, part of libambf_core.so (the default) or libambf_view.so. Its headers are included as "<name>/x.h".
# Third-party packages stay private: their headers never appear in a public header of ours.
function(ambf_add_module name)
  cmake_parse_arguments(ARG "" "LIBRARY" "SOURCES;USES;PRIVATE" ${ARGN})
  if(NOT ARG_LIBRARY)
    set(ARG_LIBRARY core)
  endif()
  add_library(ambf_${name} OBJECT ${ARG_SOURCES})
  target_include_directories(ambf_${name} PUBLIC ${PROJECT_SOURCE_DIR}/ambf_framework)
  target_link_libraries(ambf_${name} PRIVATE ambf_options ${ARG_PRIVATE})
  # Only the layers below are named; object code is gathered once, in one of the two shared libraries.
  foreach(used ${ARG_USES})
    add_dependencies(ambf_${name} ambf_${used})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY AMBF_OBJECTS_${ARG_LIBRARY} $<TARGET_OBJECTS:ambf_${name}>)
  set_property(GLOBAL APPEND PROPERTY AMBF_THIRD_PARTY_${ARG_LIBRARY} ${ARG_PRIVATE})
endfunction()

# ambf_add_test(<name> SOURCES ... [PRIVATE libraries] [LABELS tsan] [TIMEOUT s] [SERIAL])
# A GoogleTest executable that links libambf_core.so as users do; tests of render/ name ambf_view among their libraries. SERIAL: nothing else runs beside it, for tests that compare times.
# LABELS takes one label. tsan: CI runs it under ThreadSanitizer too. All programs of a label are built by the target ambf_tests_<label>.
function(ambf_add_test name)
  cmake_parse_arguments(ARG "SERIAL" "TIMEOUT;LABELS" "SOURCES;PRIVATE" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ambf_options ambf_core ${ARG_PRIVATE} GTest::gtest_main)
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(AMBF_SANITIZER)
    math(EXPR ARG_TIMEOUT "8 * ${ARG_TIMEOUT}")  # ThreadSanitizer slows long runs of physics that much
  endif()
  set(properties TIMEOUT ${ARG_TIMEOUT})
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
  # Parameters by the names that INSTANTIATE_TEST_SUITE_P gives them, not by their bytes, which hold addresses.
  gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
endfunction()
