# SuiteSparse::SuiteSparse: CHOLMOD, SPQR and UMFPACK over a BLAS. From version 7 on SuiteSparse brings CMake targets of its
# own, which are taken where they are found; older ones (Debian 12 has 5.12) are looked for by their names.
include(FindPackageHandleStandardArgs)
include(CheckLibraryExists)

# OpenBLAS first: with the reference BLAS the Cholesky factor takes 2 to 3 times as long.
if(NOT DEFINED BLA_VENDOR AND NOT TARGET BLAS::BLAS)
  set(BLA_VENDOR OpenBLAS)
  find_package(BLAS QUIET)
  unset(BLA_VENDOR)
endif()
if(NOT TARGET BLAS::BLAS)
  find_package(BLAS REQUIRED)
endif()

find_package(SPQR CONFIG QUIET)
find_package(UMFPACK CONFIG QUIET)
find_package(CHOLMOD CONFIG QUIET)
if(TARGET SuiteSparse::SPQR AND TARGET SuiteSparse::UMFPACK AND TARGET SuiteSparse::CHOLMOD)
  set(SuiteSparse_VERSION ${CHOLMOD_VERSION})
  set(SuiteSparse_LIBRARIES SuiteSparse::SPQR SuiteSparse::UMFPACK SuiteSparse::CHOLMOD)
  find_package_handle_standard_args(SuiteSparse REQUIRED_VARS SuiteSparse_LIBRARIES VERSION_VAR SuiteSparse_VERSION)
else()
  find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
  set(SuiteSparse_LIBRARIES "")
  set(required SuiteSparse_INCLUDE_DIR)
  foreach(part spqr umfpack cholmod camd ccolamd colamd amd suitesparseconfig)
    find_library(SuiteSparse_${part}_LIBRARY ${part})
    list(APPEND SuiteSparse_LIBRARIES ${SuiteSparse_${part}_LIBRARY})
    list(APPEND required SuiteSparse_${part}_LIBRARY)
  endforeach()
  find_package_handle_standard_args(SuiteSparse REQUIRED_VARS ${required})
endif()

# The OpenMP library of CHOLMOD, whose threads solve/cholmod_cholesky.cpp limits where there is one. Its compiler flag
# is not wanted: with it Eigen would start threads of its own.
check_library_exists(gomp omp_get_max_active_levels "" SuiteSparse_HAS_GOMP)

if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::SuiteSparse)
  add_library(SuiteSparse::SuiteSparse INTERFACE IMPORTED)
  target_link_libraries(SuiteSparse::SuiteSparse INTERFACE ${SuiteSparse_LIBRARIES} BLAS::BLAS
                        $<$<BOOL:${SuiteSparse_HAS_GOMP}>:gomp>)
  if(SuiteSparse_INCLUDE_DIR)
    target_include_directories(SuiteSparse::SuiteSparse INTERFACE ${SuiteSparse_INCLUDE_DIR})
  endif()
endif()
