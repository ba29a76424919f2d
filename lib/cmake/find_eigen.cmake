# Eigen3::Eigen, 3.4 or any 5. The version is compared here, since the version files of Eigen 3.4 and of Eigen 5 accept
# only requests of their own major version, and no range that spans both.
find_package(Eigen3 REQUIRED CONFIG)
if(Eigen3_VERSION VERSION_LESS 3.4 OR Eigen3_VERSION VERSION_GREATER_EQUAL 6)
  message(FATAL_ERROR "antilock: Eigen ${Eigen3_VERSION} was found in ${Eigen3_DIR}; accepted: 3.4 or later, below 6")
endif()
