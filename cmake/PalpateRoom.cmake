# palpate_room(NAME SOURCES ... [USES room...] [PUBLIC lib...] [PRIVATE lib...])
# One static library per room (docs/architecture.md): palpate_NAME, collected by palpate::palpate.
# USES are rooms; the include-rule test checks that the #include lines agree.
function(palpate_room name)
  cmake_parse_arguments(room "" "" "SOURCES;USES;PUBLIC;PRIVATE" ${ARGN})
  add_library(palpate_${name} STATIC ${room_SOURCES})
  add_library(palpate::${name} ALIAS palpate_${name})
  target_include_directories(palpate_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include
                             PRIVATE ${PROJECT_SOURCE_DIR}/src)
  list(TRANSFORM room_USES PREPEND palpate::)
  target_link_libraries(palpate_${name} PUBLIC ${room_USES} ${room_PUBLIC}
                        PRIVATE palpate_warnings ${room_PRIVATE})
  palpate_precompiled(palpate_${name} core)
  palpate_unity(palpate_${name})
  palpate_thorough(palpate_${name})
  set_property(GLOBAL APPEND PROPERTY PALPATE_ROOMS palpate::${name})
endfunction()

# palpate_tests(ROOM [GUI] FILES file... [DISPLAY file...] [SLOW file...] [SOURCES extra...] [LIBS lib...])
# One test program per room, ROOM_tests, of tests/ROOM/FILE.cpp; it is linked to the whole core library,
# of which the linker takes what the tests use. Each FILE is one ctest entry ROOM/FILE: a process of its
# own, which runs the tests of that file (tests/testing/test_selection.h). Labels: fast, or slow for the
# files called *_slow_test and those after SLOW. GUI: main() is in the sources; Qt draws to memory but for
# the files after DISPLAY, which get a display of their own (tests/testing/on_display).
function(palpate_tests room)
  cmake_parse_arguments(tests "GUI" "" "FILES;DISPLAY;SLOW;SOURCES;LIBS" ${ARGN})
  set(target ${room}_tests)
  set(files ${tests_FILES} ${tests_DISPLAY} ${tests_SLOW})
  list(TRANSFORM files APPEND .cpp OUTPUT_VARIABLE sources)
  add_executable(${target} ${sources} ${tests_SOURCES})
  target_link_libraries(${target} PRIVATE palpate::palpate palpate_warnings palpate_testing
                        ${tests_LIBS})
  if(tests_GUI)
    palpate_precompiled(${target} window_tests)
  else()
    target_link_libraries(${target} PRIVATE palpate_test_main)
    palpate_precompiled(${target} tests)
  endif()
  palpate_unity(${target})
  palpate_light(${target})
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
    palpate_test_entry(${room} ${file} ${file} ${options})
  endforeach()
endfunction()

# palpate_test_entry(ROOM NAME FILE [SLOW] [GUI [DISPLAY]] [TIMEOUT s] [ARGUMENTS ...] [ENVIRONMENT ...])
# The ctest entry ROOM/NAME, which runs the tests of FILE in the program ROOM_tests.
function(palpate_test_entry room name)
  cmake_parse_arguments(entry "SLOW;GUI;DISPLAY" "TIMEOUT" "ARGUMENTS;ENVIRONMENT" ${ARGN})
  list(GET entry_UNPARSED_ARGUMENTS 0 file)
  set(command $<TARGET_FILE:${room}_tests> --file=${file} --entry=${room}/${name} ${entry_ARGUMENTS})
  set(label fast)
  if(entry_SLOW)
    set(label slow)
  endif()
  if(NOT entry_TIMEOUT)
    set(entry_TIMEOUT 300)
    if(entry_SLOW)
      set(entry_TIMEOUT 3600)
    endif()
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
  add_test(NAME ${room}/${name} COMMAND ${command})
  set_tests_properties(${room}/${name} PROPERTIES LABELS "${labels}" TIMEOUT ${entry_TIMEOUT}
                       ENVIRONMENT "${entry_ENVIRONMENT}")
endfunction()

# palpate_fuzz_corpus(ROOM NAME) adds the source of a fuzzer to the test that replays its corpus,
# tests/ROOM/NAME_fuzz_corpus_test.cpp. Fuzzers all have one function name; here each gets its own.
function(palpate_fuzz_corpus room name)
  set(fuzzer ${PROJECT_SOURCE_DIR}/tests/fuzz/${name}_fuzzer.cpp)
  target_sources(${room}_tests PRIVATE ${fuzzer})
  set_source_files_properties(${fuzzer} ${name}_fuzz_corpus_test.cpp PROPERTIES COMPILE_DEFINITIONS
    "LLVMFuzzerTestOneInput=fuzz_${name};PALPATE_FUZZ_CORPUS=\"${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${name}\"")
endfunction()
