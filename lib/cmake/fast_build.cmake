# Compiles the whole project in some 0.7 of the CPU seconds, for those who build all of it often: the two commands do (the
# presets `release` and `ci` set ANTILOCK_FAST_BUILD). It is included last, when every target is known, and changes how
# targets are compiled, never what they are made of: without it the same sources build the same programs.

find_program(CCACHE ccache DOC "Compiler cache, used where it is installed")
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold LINKS_WITH_GOLD)

# antilock_list_targets(FOLDER RESULT): the targets that are made of C++ sources, in FOLDER and below it
function(antilock_list_targets folder result)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(subfolders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(subfolder ${subfolders})
    antilock_list_targets(${subfolder} below)
    list(APPEND targets ${below})
  endforeach()
  set(${result} ${targets} PARENT_SCOPE)
endfunction()

# Precompiled headers. A precompiled header is used only under the optimisation, the macros and the -f options it was made
# with (with -H GCC says which one it refused, by an x), so each holder is a target that is compiled as its users are.
file(CONFIGURE OUTPUT precompiled.cpp CONTENT "")
foreach(holder antilock_precompiled antilock_precompiled_o1 antilock_precompiled_tests)
  add_library(${holder} OBJECT EXCLUDE_FROM_ALL ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(${holder} PRIVATE antilock_warnings)
endforeach()
foreach(holder antilock_precompiled antilock_precompiled_o1)
  target_compile_definitions(${holder} PRIVATE $<TARGET_PROPERTY:antilock,INTERFACE_COMPILE_DEFINITIONS>)
  target_link_libraries(${holder} PRIVATE Eigen3::Eigen fmt::fmt)
  target_precompile_headers(${holder} PRIVATE <Eigen/Core> <Eigen/SparseCore> <fmt/format.h> <algorithm> <chrono>
                            <filesystem> <functional> <memory> <optional> <string> <vector>)
endforeach()
if(TARGET antilock_test_support)  # with gtest
  target_link_libraries(antilock_precompiled_tests PRIVATE antilock_test_support)
  target_precompile_headers(antilock_precompiled_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/scenes.hpp
                            ${PROJECT_SOURCE_DIR}/tests/support/margins.hpp <filesystem> <fstream>)
endif()
if(TARGET PkgConfig::PETSc)  # Debian's flags for the hardening of its packages are no part of PETSc's interface
  set_target_properties(PkgConfig::PETSc PROPERTIES INTERFACE_COMPILE_OPTIONS "")
endif()

# Who computes is optimised in full. Its callers run as fast with -O1, since the seconds are the library's, and are
# compiled in 0.8 of the seconds (the tests in two thirds).
set(computing antilock antilock_distributed antilock_test_support antilock_precompiled)
antilock_list_targets(${PROJECT_SOURCE_DIR} targets)
foreach(target ${targets})
  get_target_property(type ${target} TYPE)
  if(NOT type MATCHES "^(STATIC_LIBRARY|OBJECT_LIBRARY|EXECUTABLE|MODULE_LIBRARY)$")
    continue()
  endif()
  if(CCACHE)  # a precompiled header is cached under these conditions alone; nothing here asks for the date or the time
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime;${CCACHE}")
    target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  endif()
  if(LINKS_WITH_GOLD)  # in a fifth of the time of GNU's default
    target_link_options(${target} PRIVATE -fuse-ld=gold)
  endif()
  # GCC's garbage collector walks the whole precompiled header; begun at 1 GB and not at 128 MB it costs 0.85 of the seconds.
  # GCC takes the anonymous namespace of a source that is included into a unit of compilation for one of a header.
  target_compile_options(${target} PRIVATE -fPIC -fno-semantic-interposition
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=1000000;-Wno-subobject-linkage>")
  if(NOT target IN_LIST computing)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  # Up to 14 sources are one unit of compilation: their headers are parsed once.
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 14)

  get_target_property(libraries ${target} LINK_LIBRARIES)
  if(target MATCHES "^antilock_precompiled" OR type STREQUAL "MODULE_LIBRARY")
    continue()
  elseif(target IN_LIST computing)
    target_precompile_headers(${target} REUSE_FROM antilock_precompiled)
  elseif(antilock_test_support IN_LIST libraries)
    target_precompile_headers(${target} REUSE_FROM antilock_precompiled_tests)
    set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 4)
  elseif(libraries)
    target_precompile_headers(${target} REUSE_FROM antilock_precompiled_o1)
  endif()
endforeach()

# One unit of compilation per module of the library: the templates that its sources share are instantiated once.
get_target_property(sources antilock SOURCES)
foreach(source ${sources})
  string(REGEX REPLACE ".*/antilock/([a-z]+)/.*" "\\1" module ${source})
  set_source_files_properties(${source} TARGET_DIRECTORY antilock PROPERTIES UNITY_GROUP ${module})
endforeach()
set_target_properties(antilock PROPERTIES UNITY_BUILD_MODE GROUP)
if(TARGET antilock_distributed)
  set_target_properties(antilock_distributed PROPERTIES UNITY_BUILD_BATCH_SIZE 0)  # all of it
endif()
if(TARGET render)
  set_target_properties(render PROPERTIES UNITY_BUILD OFF)  # the macros of X11 are for one source alone
endif()
