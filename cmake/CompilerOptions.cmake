# Warnings and floating-point rules shared by every target, as one interface target.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

add_library(indet_options INTERFACE)
# No contraction to fused multiply-add: the same seed gives the same bytes on any machine.
target_compile_options(indet_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual
  -Wnull-dereference -Wimplicit-fallthrough -Werror -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 reports these inside Eigen and libstdc++ where they cannot happen.
  target_compile_options(indet_options INTERFACE -Wno-maybe-uninitialized -Wno-null-dereference -Wno-restrict
    -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # The compiler collects garbage from 512 MB on, not from 128 MB: a tenth less time.
  target_compile_options(indet_options INTERFACE "SHELL:--param ggc-min-heapsize=524288")
endif()
if(CMAKE_UNITY_BUILD)
  # Meant for headers: a class of one source file may have members of types in an anonymous namespace.
  target_compile_options(indet_options INTERFACE -Wno-subobject-linkage)
endif()

# For targets that read options, print and compare, and leave the computing to others: a third less compilation.
function(indet_optimise_little target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

if(INDET_SANITIZE)
  add_compile_options(-fsanitize=${INDET_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  # A third of the compilation and more, for what AddressSanitizer finds as well where the pointer is used (null,
  # object-size, pointer-overflow) or x86 allows (alignment).
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fno-sanitize=null,object-size,alignment,pointer-overflow>)
  add_link_options(-fsanitize=${INDET_SANITIZE})
  # At fixed addresses a program need not relocate half a million places of source code at every start.
  add_link_options($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-no-pie>)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
