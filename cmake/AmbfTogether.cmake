# Sources compiled several at a time (AMBF_TOGETHER): a build from nothing, as CI's are, takes a third of the time;
# after a change, whole groups are compiled again. Else each file is compiled alone, as those who edit want it.

# gcc takes a file of a group for a header, where types of unnamed namespaces would be a mistake. Locals may be called
# as another file's own things are; a build file by file refuses real shadows.
set(AMBF_TOGETHER_WARNINGS $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage> $<$<CXX_COMPILER_ID:GNU>:-Wno-error=shadow>)

# ambf_compile_together(<target>): of a library; chooses what fits together (cmake/group_sources.py).
function(ambf_compile_together target)
  if(NOT AMBF_TOGETHER)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  execute_process(
    COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/group_sources.py 10 ${sources}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE groups OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" groups "${groups}")
  foreach(source group IN ZIP_LISTS sources groups)
    if(NOT group STREQUAL alone)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
  target_compile_options(${target} PRIVATE ${AMBF_TOGETHER_WARNINGS})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# ambf_join_tests(<variable> <name> sources...): sets the variable to what a test program compiles instead of its
# sources (cmake/join_tests.py).
function(ambf_join_tests variable name)
  set(${variable} ${ARGN} PARENT_SCOPE)
  if(NOT AMBF_TOGETHER)
    return()
  endif()
  set(script ${PROJECT_SOURCE_DIR}/cmake/join_tests.py)
  set(sources)
  foreach(source IN LISTS ARGN)
    if(NOT source MATCHES "^\\$<")  # else objects of another target
      cmake_path(ABSOLUTE_PATH source)
    endif()
    list(APPEND sources ${source})
  endforeach()
  execute_process(COMMAND ${PYTHON_EXECUTABLE} ${script} plan 8 ${sources} OUTPUT_VARIABLE groups
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" groups "${groups}")
  set(compiled)
  set(parts)
  foreach(source group IN ZIP_LISTS sources groups)
    if(group STREQUAL alone)
      list(APPEND compiled ${source})
    else()
      list(APPEND parts ${group})
      list(APPEND ${group}_sources ${source})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES parts)
  foreach(part IN LISTS parts)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}_${part}.cpp)
    add_custom_command(OUTPUT ${file} COMMAND ${PYTHON_EXECUTABLE} ${script} write ${file} ${${part}_sources}
                       DEPENDS ${script} ${${part}_sources} VERBATIM)
    set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS "-iquote${CMAKE_CURRENT_SOURCE_DIR}")
    list(APPEND compiled ${file})
  endforeach()
  set(${variable} ${compiled} PARENT_SCOPE)
endfunction()
