# cmake --build build --target format-check    every source is laid out as .clang-format says
# cmake --build build --target tidy            lib/ under the checks of .clang-tidy, in parallel
find_program(CLANG_FORMAT NAMES clang-format-14 clang-format)
find_program(CLANG_TIDY NAMES clang-tidy-14 clang-tidy)
mark_as_advanced(CLANG_FORMAT CLANG_TIDY)

if(CLANG_FORMAT)
  set(formatted "")
  foreach(folder lib tutorials figures freefem tests)
    file(GLOB_RECURSE found CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.hpp)
    list(APPEND formatted ${found})
  endforeach()
  add_custom_target(format-check COMMAND ${CLANG_FORMAT} --dry-run -Werror ${formatted} VERBATIM)
endif()

if(CLANG_TIDY)
  # The compiler's own command line names a precompiled header that clang cannot read; the flags that matter are few.
  set(flags ${PROJECT_BINARY_DIR}/tidy)
  file(GENERATE OUTPUT ${flags}/compile_flags.txt CONTENT "-std=c++20
-I${PROJECT_SOURCE_DIR}/lib
-D$<JOIN:$<TARGET_PROPERTY:antilock,COMPILE_DEFINITIONS>,\n-D>
-isystem$<JOIN:$<FILTER:$<TARGET_PROPERTY:antilock,INCLUDE_DIRECTORIES>,EXCLUDE,/lib$|^/usr/include$>,\n-isystem>
")
  # a room's pages together where they are compiled together, so that headers are read once
  get_target_property(pages antilock SOURCES)
  list(FILTER pages INCLUDE REGEX "/(core|solve)/[^/]*[.]cpp$")
  list(TRANSFORM pages REPLACE "^antilock/" "${PROJECT_SOURCE_DIR}/lib/antilock/")
  list(JOIN pages "\n" pages)
  file(GENERATE OUTPUT ${flags}/pages.txt CONTENT "${pages}\n")
  cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
  set(look ${CLANG_TIDY} --quiet --warnings-as-errors=* -p ${flags})
  set(units ${PROJECT_BINARY_DIR}/lib/CMakeFiles/antilock.dir/Unity)
  add_custom_target(tidy
    COMMAND find ${units} -name *.cxx > ${flags}/units.txt
    COMMAND xargs -P ${cores} -n 1 -a ${flags}/units.txt ${look}
    COMMAND xargs -P ${cores} -n 1 -a ${flags}/pages.txt ${look}
    VERBATIM)
endif()
