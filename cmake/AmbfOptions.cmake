# Language standard, warnings, sanitizers and output folders of every target of ours.
option(AMBF_BUILD_TESTS "Build the tests" ON)
option(AMBF_WERROR "Treat warnings as errors" ON)
option(AMBF_PRECOMPILED "Precompile the standard headers: quick from nothing, but ccache cannot reuse the objects" OFF)
option(AMBF_TOGETHER "Compile several sources at a time: quick from nothing, slow after a change" OFF)
set(AMBF_SANITIZER "" CACHE STRING "Build everything under one sanitizer: '', thread or address")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
# The installed tree may be moved: programs find our library beside themselves.
set(CMAKE_INSTALL_RPATH "$ORIGIN/../lib")

add_library(ambf_options INTERFACE)
target_compile_options(ambf_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # gcc 12 warns of overlapping copies inside std::string's own operator+ (GCC bug 105651).
  target_compile_options(ambf_options INTERFACE -Wno-restrict)
endif()
# The same expression must give the same bits wherever it is inlined: no fused multiply-add by chance.
target_compile_options(ambf_options INTERFACE -ffp-contract=off)
if(AMBF_WERROR)
  target_compile_options(ambf_options INTERFACE -Werror)
endif()
# Sources are compiled more often than most of them run long: what does arithmetic (ARITHMETIC in ambf_add_module) is
# optimised as far as it goes, the rest of a release as Debian does it, and under a sanitizer not at all, which takes
# half the time. clang 14 inlines nothing below -O2. The level comes after the build type's own.
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
set(AMBF_ARITHMETIC_OPTIONS $<$<CONFIG:Release>:-O3>)
if(AMBF_SANITIZER STREQUAL "thread")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer -O0 -g1)
  add_link_options(-fsanitize=thread)
  set(AMBF_ARITHMETIC_OPTIONS -O1)
elseif(AMBF_SANITIZER STREQUAL "address")
  # Left out are checks of pointers that are a third of the time to compile: what they find, AddressSanitizer finds when
  # memory is touched (null, object-size, pointer-overflow), or vector instructions of the release build (alignment).
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,object-size,pointer-overflow,alignment
                      -fno-sanitize-recover=undefined -fno-omit-frame-pointer -O0 -g1)
  add_link_options(-fsanitize=address,undefined)
  set(AMBF_ARITHMETIC_OPTIONS -O2)
elseif(AMBF_SANITIZER)
  message(FATAL_ERROR "AMBF_SANITIZER must be empty, 'thread' or 'address', not '${AMBF_SANITIZER}'")
endif()
if(AMBF_SANITIZER AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Instrumented code hides from gcc that a moved std::variant holds something; the release build still warns.
  # The same for bounds of temporary strings. The release build still warns of both.
  target_compile_options(ambf_options INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds
                         -Wno-stringop-overflow -Wno-stringop-overread)
endif()

# What tests themselves compute is little.
add_library(ambf_test_options INTERFACE)
target_compile_options(ambf_test_options INTERFACE -O0)
target_link_libraries(ambf_test_options INTERFACE ambf_options)

find_program(AMBF_CCACHE ccache)
if(AMBF_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${AMBF_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${AMBF_CCACHE})
endif()
