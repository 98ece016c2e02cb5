# Sources of one library compiled several at a time, in the trees of the sanitizers: they are built from nothing in CI,
# where each file alone takes three times as long. The release tree compiles file by file, as users do and clang-tidy.

# ambf_compile_together(<target> sources...): chooses what fits together (cmake/group_sources.py).
function(ambf_compile_together target)
  if(NOT AMBF_PRECOMPILED OR NOT AMBF_SANITIZER)
    return()
  endif()
  execute_process(
    COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/group_sources.py 10 ${ARGN}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE groups OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" groups "${groups}")
  foreach(source group IN ZIP_LISTS ARGN groups)
    if(NOT group STREQUAL alone)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # gcc takes a file of the group for a header, where types of unnamed namespaces would be a mistake.
    # Locals may be called as another file's own things are; the release build refuses real shadows.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage -Wno-error=shadow)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
