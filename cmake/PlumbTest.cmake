# plumb_test(NAME SOURCES ... LINK plumb::... [LABELS long])
#
# A GoogleTest program. Tests whose name begins with "Long" carry the label `long` and run under `scripts/test --all` only.
include(GoogleTest)
function(plumb_test NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS" ${ARGN})
  add_executable(${NAME} ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE ${ARG_LINK} GTest::gtest_main)
  target_include_directories(${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${NAME} PRIVATE PLUMB_SOURCE_DIR="${PROJECT_SOURCE_DIR}" PLUMB_BIN_DIR="${CMAKE_BINARY_DIR}/bin")
  gtest_discover_tests(${NAME} TEST_FILTER "-Long*" DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 900 LABELS "${ARG_LABELS}")
  gtest_discover_tests(${NAME} TEST_FILTER "Long*" TEST_LIST ${NAME}_long DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 3600 LABELS long)
endfunction()
