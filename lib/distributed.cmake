# The module lib/antilock/distributed: PETSc over MPI, where it is asked for or found. Where it is built, there is a target
# antilock::distributed.
if(ANTILOCK_DISTRIBUTED)
  include(cmake/find_petsc.cmake)
endif()
if(NOT (PETSc_FOUND AND MPI_CXX_FOUND))
  if(ANTILOCK_DISTRIBUTED AND NOT ANTILOCK_DISTRIBUTED STREQUAL "AUTO")
    message(FATAL_ERROR "ANTILOCK_DISTRIBUTED=${ANTILOCK_DISTRIBUTED}: PETSc (3.18 or later, by pkg-config) or MPI is missing; "
                        "`.ci/install distributed` installs both")
  endif()
  message(STATUS "PETSc over MPI: not built (ANTILOCK_DISTRIBUTED=${ANTILOCK_DISTRIBUTED}); solver = \"petsc\" and its tests are left out")
  return()
endif()
set_target_properties(MPI::MPI_CXX PROPERTIES IMPORTED_GLOBAL TRUE)
message(STATUS "PETSc over MPI: built with PETSc ${PETSc_VERSION}")

file(GLOB distributed_sources CONFIGURE_DEPENDS antilock/distributed/*.cpp antilock/distributed/detail/*.cpp)
add_library(antilock_distributed STATIC ${distributed_sources})
add_library(antilock::distributed ALIAS antilock_distributed)
set_target_properties(antilock_distributed PROPERTIES EXPORT_NAME distributed)
target_link_libraries(antilock_distributed PUBLIC antilock PkgConfig::PETSc MPI::MPI_CXX
                      PRIVATE $<BUILD_INTERFACE:antilock_warnings>)
# MPI's C++ interface is not used, and its header is not free of warnings
target_compile_definitions(antilock_distributed PUBLIC OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
