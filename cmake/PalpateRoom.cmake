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
  set_property(GLOBAL APPEND PROPERTY PALPATE_ROOMS palpate::${name})
endfunction()

# palpate_test(ROOM FILE [SLOW] [GUI [DISPLAY]] [LIBS lib...] [SOURCES extra...])
# Builds tests/ROOM/FILE.cpp; each TEST becomes a ctest entry "ROOM/FILE.Suite.Name" that counts as
# skipped by itself when it calls GTEST_SKIP.
function(palpate_test room file)
  cmake_parse_arguments(test "SLOW;GUI;DISPLAY" "" "LIBS;SOURCES" ${ARGN})
  set(target ${room}_${file})
  add_executable(${target} ${CMAKE_CURRENT_SOURCE_DIR}/${file}.cpp ${test_SOURCES})
  target_link_libraries(${target} PRIVATE palpate::palpate palpate_warnings palpate_testing
                        ${test_LIBS})
  if(test_GUI)
    palpate_precompiled(${target} window_tests)
  else()
    palpate_precompiled(${target} tests)
  endif()
  set(label fast)
  if(test_SLOW)
    set(label slow)
  endif()
  set(properties TIMEOUT 300)
  if(test_GUI)
    # One label, "fast_gui": `ctest -L` takes expressions, so that it is both fast and gui (a list of
    # labels doesn't pass gtest_discover_tests, which reads its second word as a property).
    set(label ${label}_gui)
    if(test_DISPLAY)
      # Windows share one display, its focus and its clipboard.
      list(APPEND properties RESOURCE_LOCK display)
    else()
      list(APPEND properties ENVIRONMENT QT_QPA_PLATFORM=offscreen)
    endif()
  else()
    target_link_libraries(${target} PRIVATE GTest::gtest_main)
  endif()
  gtest_discover_tests(${target} TEST_PREFIX "${room}/${file}." DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES
    DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${label} ${properties})
endfunction()
