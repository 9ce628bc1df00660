# How every target of the project is compiled: language, warnings, sanitizers, ccache.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Release: -O2; the core library asks for more (palpate_optimise_speed), tests for less (palpate_optimise_build_time).
if(CMAKE_CXX_FLAGS_RELEASE STREQUAL "-O3 -DNDEBUG")
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
endif()

find_program(PALPATE_CCACHE ccache)
if(PALPATE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without the first ccache refuses what reads a precompiled header; with the second it looks into
  # that large file once only.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros
      CCACHE_INODECACHE=true ${PALPATE_CCACHE})
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12)
  message(FATAL_ERROR "GCC ${CMAKE_CXX_COMPILER_VERSION} is too old: 12 or newer is wanted")
endif()

# Linked privately by every target of ours, so that warnings concern our code only. They are errors where the project is
# developed, not where another compiler or library knows more of them.
add_library(palpate_warnings INTERFACE)
target_compile_options(palpate_warnings INTERFACE
  -Wall -Wextra -Wpedantic $<$<BOOL:${PALPATE_WERROR}>:-Werror> -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -Wcast-align -Wformat=2 -Wdouble-promotion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(palpate_warnings INTERFACE -Wno-restrict)  # false alarms: GCC bug 105651
endif()

if(PALPATE_SANITIZE)
  # libceres.a has functions of Eigen that were compiled without AddressSanitizer, and the linker
  # keeps one of each: all must take memory in the same way.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
  add_compile_options(-fsanitize=${PALPATE_SANITIZE} -fno-omit-frame-pointer
                      -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${PALPATE_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # The checks that sanitizers insert make GCC see values it can't follow (std::optional's, say).
    target_compile_options(palpate_warnings INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
if(PALPATE_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()
if(PALPATE_FUZZERS)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# palpate_precompiled(TARGET KIND) lets TARGET read cmake/precompiled/KIND.h, headers of others, in
# compiled form: half of a build from nothing goes into reading them. Sources still name every header
# they use: the fuzzers' build and the tests of headers do without.
function(palpate_precompiled target kind)
  if(PALPATE_PRECOMPILED)
    palpate_match_precompiled_flags(${target})
    target_precompile_headers(${target} REUSE_FROM palpate_precompiled_${kind})
  endif()
endfunction()

# palpate_build_precompiled(KIND [SPEED | BUILD_TIME] LIBS lib...) makes that form, as optimised as those who read it; LIBs are
# those whose headers are in it.
function(palpate_build_precompiled kind)
  cmake_parse_arguments(form "SPEED;BUILD_TIME" "" "LIBS" ${ARGN})
  if(PALPATE_PRECOMPILED)
    set(target palpate_precompiled_${kind})
    add_library(${target} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled/nothing.cpp)
    target_link_libraries(${target} PRIVATE palpate_warnings ${form_LIBS})
    palpate_match_precompiled_flags(${target})
    if(form_SPEED)
      palpate_optimise_speed(${target})
    elseif(form_BUILD_TIME)
      palpate_optimise_build_time(${target})
    endif()
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled/${kind}.h)
  endif()
endfunction()

# Who makes the form and who reads it are compiled alike: CMake gives programs -fPIE.
function(palpate_match_precompiled_flags target)
  target_compile_options(${target} PRIVATE -fPIC)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # ccache asks for the first. The warnings are false alarms in std::string (GCC bugs 105329, 105762):
    # of a precompiled header GCC forgets that it is the system's. Without (fuzz, tsan) they stay on.
    target_compile_options(${target} PRIVATE -fpch-preprocess -Wno-array-bounds -Wno-stringop-overflow
                           -Wno-stringop-overread)
  endif()
endfunction()

# palpate_unity(TARGET) compiles the sources of TARGET several at a time, so that headers are read once for
# all of them. Names in anonymous namespaces of one folder have to differ (project_rules/unity_names_test).
# PALPATE_UNITY=OFF compiles each source by itself: for clang-tidy, editors, and the proof that every
# source names what it uses (preset `separate`).
function(palpate_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${PALPATE_UNITY} UNITY_BUILD_BATCH_SIZE 8)
  if(PALPATE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # A source that is included is taken for a header, whose types were seen by several sources.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# palpate_optimise(TARGET LEVEL): in a release, -O1 or -O3 instead of -O2. A target that reads a precompiled header
# has the level of that header: GCC goes back to the one that stands in it, behind Eigen's `#pragma GCC optimize`
# (project_rules/compile_options_test).
function(palpate_optimise target level)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE ${level})
  endif()
endfunction()

# palpate_optimise_speed(TARGET): the core library, in whose loops the program spends its time. GCC vectorises most of
# them from -O3 on only.
function(palpate_optimise_speed target)
  palpate_optimise(${target} -O3)
endfunction()

# palpate_optimise_build_time(TARGET): no time is won by optimising what runs for milliseconds, much by compiling it fast.
function(palpate_optimise_build_time target)
  palpate_optimise(${target} -O1)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Needs the whole optimiser to be right.
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
endfunction()
