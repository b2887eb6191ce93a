# SPDX-License-Identifier: Apache-2.0
# How a folder of src/ becomes a target, and the flags that every target of ours has.

# Contraction would let the compiler fuse a multiply and an add on one machine and not on another; contact
# is chaotic, so a last bit becomes another motion (docs/determinism.md). That nobody reads errno or traps
# after arithmetic changes no bit, and saves a branch at every root and comparison.
add_library(ifa_flags INTERFACE)
target_compile_options(ifa_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off -fno-math-errno -fno-trapping-math
  $<$<BOOL:${IFA_WARNINGS_AS_ERRORS}>:-Werror>)
# With precompiled headers g++ 12 warns of copies inside std::string that do not happen (gcc's bugs 105329,
# 105651 and their like); without, it does not.
if(IFA_PRECOMPILED_HEADERS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(ifa_flags INTERFACE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                                             -Wno-stringop-overread)
endif()

# It warns, of headers, that types of ours have members of types that only one file knows; where files are
# compiled together it takes all of them for headers.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(ifa_flags INTERFACE -Wno-subobject-linkage)
endif()

# Half of the time of a build from nothing went into reading the same headers again and again. Lint compiles
# without these (scripts/lint.sh), so that a file which forgets to include something is still found.
set(IFA_PRECOMPILED <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <span>
                    <string> <utility> <vector> <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)

# ifa_precompile(NAME OWNER header...): target NAME uses the precompiled headers of OWNER, which may be NAME
# itself; flags of both must be the same.
function(ifa_precompile NAME OWNER)
  if(NOT IFA_PRECOMPILED_HEADERS)
    return()
  endif()
  if("${NAME}" STREQUAL "${OWNER}")
    target_precompile_headers(${NAME} PRIVATE ${IFA_PRECOMPILED} ${ARGN})
  else()
    target_precompile_headers(${NAME} REUSE_FROM ${OWNER})
  endif()
endfunction()

# ifa_folder(NAME DEPENDS folder... LIBRARIES external...)
# An object library of src/NAME/*.cpp that sees the folders it names and nothing else of ours.
function(ifa_folder NAME)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES" ${ARGN})
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${NAME}/*.cpp)
  list(TRANSFORM ARG_DEPENDS PREPEND ifa_)
  if(SOURCES)
    add_library(ifa_${NAME} OBJECT ${SOURCES})
    set(SCOPE PUBLIC)
    target_link_libraries(ifa_${NAME} PRIVATE ifa_flags)
    ifa_precompile(ifa_${NAME} ifa_base)
    set_property(GLOBAL APPEND PROPERTY IFA_OBJECT_FOLDERS ifa_${NAME})
  else()
    add_library(ifa_${NAME} INTERFACE)
    set(SCOPE INTERFACE)
  endif()
  target_include_directories(ifa_${NAME} ${SCOPE} ${PROJECT_SOURCE_DIR}/src
                                                  ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(ifa_${NAME} ${SCOPE} Eigen3::Eigen ${ARG_DEPENDS} ${ARG_LIBRARIES})
endfunction()

# ifa_compile_quickly(NAME): for command lines, which only call the library: to optimise what reads them takes
# as long as to compile half of it. Release builds are optimised all the same.
function(ifa_compile_quickly NAME)
  target_compile_options(${NAME} PRIVATE $<$<NOT:$<CONFIG:Release>>:-O0>)
endfunction()

# ifa_tests(NAME library...): tests/NAME/*_test.cpp as one program ifa_NAME_test, each test a ctest of its own.
# Where NAME is in IFA_TESTS_THAT_CALCULATE its oracles take long, or it compiles the library's templates.
# The others only call the library: to optimise and instrument them takes longer than to run them, and the
# sanitisers watch in the library over what they hand to it.
set(IFA_TESTS_THAT_CALCULATE body dynamics sampler database affinity connection graph planner motion audit ensemble
                             sonify render)
function(ifa_tests NAME)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${NAME}/*.cpp)
  if(SOURCES)
    add_executable(ifa_${NAME}_test ${SOURCES})
    target_include_directories(ifa_${NAME}_test PRIVATE ${PROJECT_SOURCE_DIR}/src
                                                        ${PROJECT_SOURCE_DIR}/tests)
    target_compile_definitions(ifa_${NAME}_test PRIVATE
      IFA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" IFA_PROGRAM="$<TARGET_FILE:ifa_program>")
    target_link_libraries(ifa_${NAME}_test PRIVATE ifa ifa_flags ${ARGN} fmt::fmt
                                                   GTest::gtest_main GTest::gmock)
    if(NAME IN_LIST IFA_TESTS_THAT_CALCULATE)
      set(OWNER ifa_body_test)
    else()
      set(OWNER ifa_base_test)
      target_compile_options(ifa_${NAME}_test PRIVATE -O0 -fno-sanitize=all)
    endif()
    ifa_precompile(ifa_${NAME}_test ${OWNER} <gmock/gmock.h> <gtest/gtest.h>)
    gtest_discover_tests(ifa_${NAME}_test TEST_PREFIX "${NAME}." DISCOVERY_TIMEOUT 60
                         PROPERTIES TIMEOUT 900
                         ENVIRONMENT "XDG_CACHE_HOME=${CMAKE_CURRENT_BINARY_DIR}/cache")
  endif()
endfunction()
