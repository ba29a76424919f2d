# Eigen3::Eigen, 3.4 or later, below 5. Eigen 5.0.1 was tried: it has no Eigen::all, and Debian's has an allocator of its own,
# which core/eigen_memory.hpp does not know yet.
find_package(Eigen3 REQUIRED CONFIG)
if(Eigen3_VERSION VERSION_LESS 3.4 OR Eigen3_VERSION VERSION_GREATER_EQUAL 5)
  message(FATAL_ERROR "antilock: Eigen ${Eigen3_VERSION} was found in ${Eigen3_DIR}; accepted: 3.4 or later, below 5")
endif()
