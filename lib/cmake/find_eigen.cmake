# Eigen3::Eigen, 3.4 or later, below 6. Eigen 3.4.0 (Debian 12 and 13) and 5.0.1 were tried.
find_package(Eigen3 REQUIRED CONFIG)
if(Eigen3_VERSION VERSION_LESS 3.4 OR Eigen3_VERSION VERSION_GREATER_EQUAL 6)
  message(FATAL_ERROR "antilock: Eigen ${Eigen3_VERSION} was found in ${Eigen3_DIR}; accepted: 3.4 or later, below 6")
endif()
