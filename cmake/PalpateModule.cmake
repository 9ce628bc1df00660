# palpate_module(NAME SOURCES ... [APART] [USES module...] [PUBLIC lib...] [PRIVATE lib...])
# One static library per module (docs/architecture.md): palpate_NAME, collected by palpate::palpate
# except those marked APART.
# USES are modules; the include-rule test checks that the #include lines agree.
function(palpate_module name)
  cmake_parse_arguments(module "APART" "" "SOURCES;USES;PUBLIC;PRIVATE" ${ARGN})
  add_library(palpate_${name} STATIC ${module_SOURCES})
  add_library(palpate::${name} ALIAS palpate_${name})
  target_include_directories(palpate_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include
                             PRIVATE ${PROJECT_SOURCE_DIR}/src)
  list(TRANSFORM module_USES PREPEND palpate::)
  target_link_libraries(palpate_${name} PUBLIC ${module_USES} ${module_PUBLIC}
                        PRIVATE palpate_warnings ${module_PRIVATE})
  palpate_precompiled(palpate_${name} core)
  palpate_unity(palpate_${name})
  palpate_optimise_speed(palpate_${name})
  if(NOT module_APART)
    set_property(GLOBAL APPEND PROPERTY PALPATE_MODULES palpate::${name})
  endif()
endfunction()

# palpate_tests(MODULE [GUI] FILES file... [DISPLAY file...] [SLOW file...] [LIVE file...] [TIMED file...]
#   [SOURCES extra...] [LIBS lib...])
# One test program per module, MODULE_tests, of tests/MODULE/FILE.cpp (FILE may lie in a folder: slip/slip_panel_test); it is linked to the whole core library,
# of which the linker takes what the tests use. Each FILE is one ctest entry MODULE/FILE: a process of its
# own, which runs the tests of that file (tests/testing/test_selection.h). Labels: fast, or slow for the
# files called *_slow_test and those after SLOW. LIVE: files that drive an emulated hand in real time (tests/testing/test_run.h).
# TIMED: files that run once more in the slow suite, which judges real time (tests/testing/time_limit.h), as MODULE/FILE_timed. Files
# of both stand in another list, too. GUI: main() is in the sources; Qt draws to memory but for
# the files after DISPLAY, which get a display of their own (tests/testing/on_display).
function(palpate_tests module)
  cmake_parse_arguments(tests "GUI" "" "FILES;DISPLAY;SLOW;LIVE;TIMED;SOURCES;LIBS" ${ARGN})
  set(target ${module}_tests)
  set(files ${tests_FILES} ${tests_DISPLAY} ${tests_SLOW})
  list(TRANSFORM files APPEND .cpp OUTPUT_VARIABLE sources)
  add_executable(${target} ${sources} ${tests_SOURCES})
  target_link_libraries(${target} PRIVATE palpate::palpate palpate::laboratory palpate_warnings
                        palpate_testing ${tests_LIBS})
  if(tests_GUI)
    palpate_precompiled(${target} window_tests)
  else()
    target_link_libraries(${target} PRIVATE palpate_test_main)
    palpate_precompiled(${target} tests)
  endif()
  palpate_unity(${target})
  palpate_optimise_build_time(${target})
  foreach(file ${files})
    set(options "")
    if(tests_GUI)
      set(options GUI)
    endif()
    if(file IN_LIST tests_DISPLAY)
      list(APPEND options DISPLAY)
    endif()
    if(file IN_LIST tests_SLOW OR file MATCHES "_slow_test$")
      list(APPEND options SLOW)
    endif()
    get_filename_component(name ${file} NAME)
    set(environment "")
    if(file IN_LIST tests_LIVE)
      set(environment ENVIRONMENT PALPATE_EXCUSE_STANDSTILL=1)
    endif()
    palpate_test_entry(${module} ${file} ${name} ${options} ${environment})
    if(file IN_LIST tests_TIMED)
      palpate_test_entry(${module} ${file}_timed ${name} ${options} SLOW)
    endif()
  endforeach()
endfunction()

# palpate_test_entry(MODULE NAME FILE [SLOW] [GUI [DISPLAY]] [TIMEOUT s] [ARGUMENTS ...] [ENVIRONMENT ...])
# The ctest entry MODULE/NAME, which runs the tests of FILE in the program MODULE_tests.
function(palpate_test_entry module name)
  cmake_parse_arguments(entry "SLOW;GUI;DISPLAY" "TIMEOUT" "ARGUMENTS;ENVIRONMENT" ${ARGN})
  list(GET entry_UNPARSED_ARGUMENTS 0 file)
  set(command $<TARGET_FILE:${module}_tests> --file=${file} --entry=${module}/${name} ${entry_ARGUMENTS})
  set(label fast)
  if(entry_SLOW)
    set(label slow)
    list(APPEND entry_ENVIRONMENT PALPATE_JUDGE_TIME=1)
  endif()
  if(NOT entry_TIMEOUT)
    set(entry_TIMEOUT 300)
    if(entry_SLOW)
      set(entry_TIMEOUT 3600)
    endif()
  endif()
  if(PALPATE_SANITIZE)
    math(EXPR entry_TIMEOUT "4 * ${entry_TIMEOUT}")
  else()
    # New memory isn't 0, so that what is read before it is set fails in every run (glibc).
    list(APPEND entry_ENVIRONMENT MALLOC_PERTURB_=165)
  endif()
  set(labels ${label})
  if(entry_GUI)
    list(APPEND labels gui)
    if(entry_DISPLAY)
      list(PREPEND command ${PROJECT_SOURCE_DIR}/tests/testing/on_display)
    else()
      list(APPEND entry_ENVIRONMENT QT_QPA_PLATFORM=offscreen)
    endif()
  endif()
  add_test(NAME ${module}/${name} COMMAND ${command})
  set_tests_properties(${module}/${name} PROPERTIES LABELS "${labels}" TIMEOUT ${entry_TIMEOUT}
                       ENVIRONMENT "${entry_ENVIRONMENT}")
endfunction()

# palpate_fuzz_corpus(MODULE NAME) adds the source of a fuzzer to the test that replays its corpus,
# tests/MODULE/NAME_fuzz_corpus_test.cpp. Fuzzers all have one function name; here each gets its own.
function(palpate_fuzz_corpus module name)
  set(fuzzer ${PROJECT_SOURCE_DIR}/tests/fuzz/${name}_fuzzer.cpp)
  target_sources(${module}_tests PRIVATE ${fuzzer})
  set_source_files_properties(${fuzzer} ${name}_fuzz_corpus_test.cpp PROPERTIES COMPILE_DEFINITIONS
    "LLVMFuzzerTestOneInput=fuzz_${name};PALPATE_FUZZ_CORPUS=\"${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${name}\"")
endfunction()
