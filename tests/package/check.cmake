# What a user of the library does: install it, find_package it from a project of their own, build, run. The project is
# the README's, word for word. The prefix is moved after the install: nothing in it may know where it was put.
# Run: cmake -DSOURCE=... -DBUILD=... -DFLAGS=... -DGENERATOR=... -DCOMPILER=... -DEIGEN=... [-DCCACHE=...] -P check.cmake
set(work ${BUILD}/tests/package)
if(CCACHE)  # what was compiled before is not compiled again, and not in another build folder either
  set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} ${CCACHE})
  set(ENV{CCACHE_BASEDIR} ${work})
endif()
set(HAS_AVX2 FALSE)  # this machine's processor, where it says so: else the tests with its instructions are left out
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo avx2 REGEX "^flags.* avx2( |$)" LIMIT_COUNT 1)
  if(avx2)
    set(HAS_AVX2 TRUE)
  endif()
endif()
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what} failed (${status}):\n${output}")
  endif()
  message(STATUS "${what}: done")
endfunction()

# Brackets and semicolons would split the texts into lists: compared in hexadecimal.
file(READ ${SOURCE}/README.md readme HEX)
foreach(file CMakeLists.txt main.cpp)
  file(READ ${SOURCE}/tests/package/${file} text HEX)
  string(FIND "${readme}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "README.md does not show tests/package/${file} as it is")
  endif()
endforeach()

file(REMOVE_RECURSE ${work})
run("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/installed)
file(RENAME ${work}/installed ${work}/moved)
file(GLOB_RECURSE headers RELATIVE ${SOURCE}/lib ${SOURCE}/lib/antilock/*.hpp)
foreach(header ${headers})
  if(NOT EXISTS ${work}/moved/include/${header})
    message(FATAL_ERROR "${header} is not installed")
  endif()
endforeach()
file(GLOB_RECURSE configs ${work}/moved/*.cmake)
foreach(config ${configs})
  file(STRINGS ${config} leaks REGEX "${SOURCE}/|${BUILD}/")
  if(leaks)
    message(FATAL_ERROR "${config} knows this machine: ${leaks}")
  endif()
endforeach()
# Every header that shows Eigen's types compares its user's memory layout with the library's. Only our own headers are
# followed (-MG: the others need not be found), all in one run.
set(shown "")
foreach(header ${headers})
  file(STRINGS ${work}/moved/include/${header} shows REGEX "#include <Eigen/")
  if(shows)
    list(APPEND shown ${work}/moved/include/${header})
  endif()
endforeach()
execute_process(COMMAND ${COMPILER} -std=c++20 -nostdinc -x c++ -M -MG -I ${work}/moved/include ${shown}
                OUTPUT_VARIABLE rules ERROR_VARIABLE failure RESULT_VARIABLE status)
string(REGEX REPLACE "\\\\\n" " " rules "${rules}")
string(REGEX MATCHALL "[^ \n]+[.]o:[^\n]*" rules "${rules}")
list(LENGTH rules ruled)
list(LENGTH shown wanted)
if(NOT status EQUAL 0 OR NOT ruled EQUAL wanted)
  message(FATAL_ERROR "${ruled} of ${wanted} headers preprocessed: ${failure}")
endif()
foreach(rule ${rules})
  if(NOT rule MATCHES "core/eigen_memory.hpp")
    message(FATAL_ERROR "a header shows Eigen's types without core/eigen_memory.hpp: ${rule}")
  endif()
endforeach()

# By hand with other flags than the library's: the first that the compiler says is a sentence on what to add. That it is
# enough is seen below, where the package adds it and nothing else.
foreach(flags -mavx2 -march=native "-DEIGEN_MAX_ALIGN_BYTES=0" "-DEIGEN_MALLOC_ALREADY_ALIGNED=0")
  set(compile ${COMPILER} -std=c++20 -fsyntax-only -Wfatal-errors ${flags} -I ${work}/moved/include -isystem ${EIGEN}
      ${SOURCE}/tests/package/main.cpp)
  if(flags MATCHES "^-m" AND NOT HAS_AVX2)
    continue()
  endif()
  execute_process(COMMAND ${compile} RESULT_VARIABLE status ERROR_VARIABLE said)
  if(status EQUAL 0 OR NOT said MATCHES "add -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1")
    message(FATAL_ERROR "by hand with ${flags}: not refused by the sentence (${status}):\n${said}")
  endif()
endforeach()

# With the package, a user may have any instruction set: one build folder, in which every change of flags builds anew.
foreach(flags "" -mavx -mavx2 -march=native)
  if(flags MATCHES "avx" AND NOT HAS_AVX2)
    continue()
  endif()
  run("configure ${flags}" ${CMAKE_COMMAND} -S ${SOURCE}/tests/package -B ${work}/build -G ${GENERATOR}
      -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS} ${flags}" -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_PREFIX_PATH=${work}/moved -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
  file(READ ${work}/build/compile_commands.json command)
  string(REGEX MATCHALL "-DEIGEN[^ ]*" added "${command}")
  list(SORT added)
  if(NOT added STREQUAL "-DEIGEN_MALLOC_ALREADY_ALIGNED=1;-DEIGEN_MAX_ALIGN_BYTES=16" OR NOT command MATCHES "${flags} ")
    message(FATAL_ERROR "the package does not add what the sentence says to ${flags}: ${command}")
  endif()
  run("build ${flags}" ${CMAKE_COMMAND} --build ${work}/build)
  run("run ${flags}" ${work}/build/mine)
endforeach()

# clang and g++ share one C++ library and its layouts: what one has built serves a user of the other.
get_filename_component(compiler ${COMPILER} NAME)
set(other g++)
if(compiler MATCHES "^(g|c)\\+\\+")
  set(other clang++-14)
endif()
find_program(other_compiler ${other})
if(other_compiler AND "${FLAGS}" STREQUAL "")  # a sanitizer's or gcov's run-time library is one compiler's own
  run("configure with ${other}" ${CMAKE_COMMAND} -S ${SOURCE}/tests/package -B ${work}/build-other -G ${GENERATOR}
      -DCMAKE_CXX_COMPILER=${other_compiler} -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${work}/moved)
  run("build with ${other}" ${CMAKE_COMMAND} --build ${work}/build-other)
  run("run with ${other}" ${work}/build-other/mine)
endif()
