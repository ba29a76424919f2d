# cmake --build build --target format-check    every source is laid out as .clang-format says
# cmake --build build --target tidy            every source under the checks of .clang-tidy (.ci/tidy)
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
  add_custom_target(tidy COMMAND ${CMAKE_COMMAND} -E env CLANG_TIDY=${CLANG_TIDY} ${PROJECT_SOURCE_DIR}/.ci/tidy ${PROJECT_BINARY_DIR}
                    USES_TERMINAL VERBATIM)
endif()
