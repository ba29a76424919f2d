# Fftw::Fftw: FFTW 3 in double precision (Debian ships no CMake config for it).
find_path(Fftw_INCLUDE_DIR fftw3.h)
find_library(Fftw_LIBRARY fftw3)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Fftw REQUIRED_VARS Fftw_LIBRARY Fftw_INCLUDE_DIR)
if(Fftw_FOUND AND NOT TARGET Fftw::Fftw)
  add_library(Fftw::Fftw UNKNOWN IMPORTED)
  set_target_properties(Fftw::Fftw PROPERTIES IMPORTED_LOCATION ${Fftw_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${Fftw_INCLUDE_DIR})
endif()
