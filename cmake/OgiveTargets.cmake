# SPDX-License-Identifier: LGPL-2.1-or-later
# Flags that every target of the project shares, and the two kinds of targets.

add_library(ogive_flags INTERFACE)
target_include_directories(ogive_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(ogive_flags INTERFACE Eigen3::Eigen)
target_compile_options(ogive_flags INTERFACE -std=c++20 -Wall -Wextra -Wpedantic -fno-math-errno)
# g++ 12 warns of overlapping copies in std::string where there are none (GCC bug 105651).
# So does its own AVX-512 header of uninitialised operands (GCC bug 105593).
target_compile_options(ogive_flags INTERFACE -Wno-restrict -Wno-maybe-uninitialized)
target_compile_options(ogive_flags INTERFACE $<$<CONFIG:Release>:-O3;-g0>)
if(OGIVE_NATIVE)
  target_compile_options(ogive_flags INTERFACE -march=native)
endif()
if(OGIVE_SANITIZE)
  target_compile_options(ogive_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(ogive_flags INTERFACE -fsanitize=address,undefined)
endif()

# deal.II names an older standard among its flags; ours comes later and wins. Its
# macro links without keywords, so all targets do. The flags stay with the target:
# who links it keeps its own.
function(ogive_use_dealii target)
  deal_ii_setup_target(${target})
  target_compile_options(${target} PRIVATE -std=c++20 -Wno-missing-braces)
  set_property(TARGET ${target} PROPERTY INTERFACE_COMPILE_OPTIONS "")
endfunction()

# ogive_library(NAME SOURCES a.cc ... [LINK lib ...] [DEALII])
function(ogive_library name)
  cmake_parse_arguments(A "DEALII" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${A_SOURCES})
  target_link_libraries(${name} ogive_flags ${A_LINK})
  if(A_DEALII)
    ogive_use_dealii(${name})
  endif()
endfunction()

# ogive_test(NAME SOURCES a.cc ... LINK lib ... [DEALII] [LABELS l ...] [TIMEOUT s])
# One executable of GoogleTest cases, each case its own ctest.
function(ogive_test name)
  cmake_parse_arguments(A "DEALII" "TIMEOUT;PREFIX" "SOURCES;LINK;LABELS" ${ARGN})
  if(NOT A_TIMEOUT)
    set(A_TIMEOUT 300)
  endif()
  if(NOT A_LABELS)
    string(REGEX REPLACE "_.*" "" A_LABELS ${name}) # unit_sph: unit
  endif()
  add_executable(${name} ${A_SOURCES})
  target_link_libraries(${name} ogive_flags ${A_LINK} GTest::gtest GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE OGIVE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(A_DEALII)
    ogive_use_dealii(${name})
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 TEST_PREFIX "${A_PREFIX}"
    PROPERTIES LABELS "${A_LABELS}" TIMEOUT ${A_TIMEOUT})
endfunction()

# ogive_ranked_test(NAME RANKS n ... SOURCES a.cc ... [LINK lib ...] [LABELS l ...] [TIMEOUT s])
# One executable of GoogleTest cases that all ranks run together: one ctest for
# each number of ranks. More ranks than cores give way while they wait.
function(ogive_ranked_test name)
  cmake_parse_arguments(A "" "TIMEOUT" "RANKS;SOURCES;LINK;LABELS" ${ARGN})
  if(NOT A_TIMEOUT)
    set(A_TIMEOUT 300)
  endif()
  if(NOT A_LABELS)
    string(REGEX REPLACE "_.*" "" A_LABELS ${name})
  endif()
  add_executable(${name} ${A_SOURCES})
  target_link_libraries(${name} ogive_flags ogive_ranked_main ${A_LINK} ogive_parallel GTest::gtest)
  target_compile_definitions(${name} PRIVATE OGIVE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  ogive_use_dealii(${name})
  foreach(n ${A_RANKS})
    add_test(NAME ${name}.on_${n}
      COMMAND mpirun --allow-run-as-root --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -n ${n}
              $<TARGET_FILE:${name}>)
    set_tests_properties(${name}.on_${n} PROPERTIES LABELS "${A_LABELS};ranks" TIMEOUT ${A_TIMEOUT} PROCESSORS 2)
  endforeach()
endfunction()
