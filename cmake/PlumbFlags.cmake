# Flags that every target shares. The numerical ones are part of the promise of equal bits (docs/determinism.md).
find_program(PLUMB_CCACHE ccache)
if(PLUMB_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${PLUMB_CCACHE})
endif()

add_library(plumb_flags INTERFACE)
target_compile_features(plumb_flags INTERFACE cxx_std_20)
target_compile_options(plumb_flags INTERFACE -ffp-contract=off -fno-fast-math)
target_compile_options(plumb_flags INTERFACE $<BUILD_INTERFACE:-Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor>)
# gcc 12 at -O3 takes "text" + std::string for overlapping copies (its bug 105651).
target_compile_options(plumb_flags INTERFACE $<BUILD_INTERFACE:$<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>>)
if(PLUMB_WERROR)
  target_compile_options(plumb_flags INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(PLUMB_SANITIZE)
  target_compile_options(plumb_flags INTERFACE -fsanitize=${PLUMB_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(plumb_flags INTERFACE -fsanitize=${PLUMB_SANITIZE})
  # Instrumented code hides from gcc that an optional's value is guarded; it warns where the plain build does not.
  target_compile_options(plumb_flags INTERFACE $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>>)
endif()
set_property(GLOBAL PROPERTY PLUMB_MODULES "")
