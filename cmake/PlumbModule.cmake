# plumb_module(NAME SOURCES ... HEADERS ... [ROOT folder] [DEPENDS modules] [PUBLIC targets] [PRIVATE targets])
#
# A folder of src/ (or of ROOT) as a static library plumb_NAME, known to others as plumb::NAME. HEADERS are installed;
# PRIVATE targets are linked but seen by no consumer (heavy libraries).
function(plumb_module NAME)
  cmake_parse_arguments(ARG "" "ROOT" "SOURCES;HEADERS;DEPENDS;PUBLIC;PRIVATE" ${ARGN})
  if(NOT ARG_ROOT)
    set(ARG_ROOT ${PROJECT_SOURCE_DIR}/src)
  endif()
  set(target plumb_${NAME})
  add_library(${target} STATIC ${ARG_SOURCES} ${ARG_HEADERS})
  add_library(plumb::${NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${NAME} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${ARG_ROOT}>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/plumb>)
  target_link_libraries(${target} PUBLIC plumb_flags ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  foreach(module IN LISTS ARG_DEPENDS)
    target_link_libraries(${target} PUBLIC plumb_${module})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY PLUMB_MODULES ${target})
  foreach(header IN LISTS ARG_HEADERS)
    get_filename_component(folder ${header} DIRECTORY)
    file(RELATIVE_PATH below ${ARG_ROOT} ${CMAKE_CURRENT_SOURCE_DIR})
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plumb/${below}/${folder} COMPONENT devel)
  endforeach()
endfunction()

# plumb_kernel(avx2|avx512 SOURCES...)
#
# Compiles these files of the calling module for newer processors; core/instruction_set.h says whether they may be called.
# No FMA: kernels have the bits of plain arithmetic.
function(plumb_kernel SET)
  set(avx2 -mavx2 -mno-fma)
  set(avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw)
  set(flags ${${SET}})
  if(SET STREQUAL "avx512" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND flags -Wno-maybe-uninitialized -Wno-uninitialized)  # gcc 12's own intrinsics
  endif()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${flags}")
endfunction()
