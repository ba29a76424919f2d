# PkgConfig::PETSc and MPI::MPI_CXX, where both are found: PETSc_FOUND and MPI_CXX_FOUND say so.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PETSc QUIET IMPORTED_TARGET GLOBAL PETSc>=3.18)
  find_package(MPI QUIET COMPONENTS CXX)
endif()
