# SuiteSparse::SuiteSparse: CHOLMOD, SPQR and UMFPACK over OpenBLAS (Debian ships no CMake config for them).
# OpenBLAS is named explicitly: with the reference BLAS the Cholesky factor takes 2 to 3 times as long. So is gomp, the OpenMP
# library of CHOLMOD, whose threads solve/detail/cholmod_cholesky.cpp limits.
find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
set(SuiteSparse_LIBRARIES "")
set(required SuiteSparse_INCLUDE_DIR)
foreach(part spqr umfpack cholmod camd ccolamd colamd amd suitesparseconfig openblas)
  find_library(SuiteSparse_${part}_LIBRARY ${part} PATH_SUFFIXES openblas-pthread)
  list(APPEND SuiteSparse_LIBRARIES ${SuiteSparse_${part}_LIBRARY})
  list(APPEND required SuiteSparse_${part}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS ${required})
if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::SuiteSparse)
  add_library(SuiteSparse::SuiteSparse INTERFACE IMPORTED)
  set_target_properties(SuiteSparse::SuiteSparse PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${SuiteSparse_LIBRARIES};gomp")
endif()
