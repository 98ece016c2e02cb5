# Third-party packages, all from Debian. Interface targets mark their headers as SYSTEM.
find_package(Threads REQUIRED)

find_package(Bullet CONFIG CONFIGS BulletConfig-float64.cmake QUIET)
if(NOT Bullet_FOUND)
  message(FATAL_ERROR "Bullet (double precision) not found. On Debian: apt-get install libbullet-dev, or run './dev deps'.")
endif()
add_library(ambf_bullet INTERFACE)
target_include_directories(ambf_bullet SYSTEM INTERFACE /usr/include/bullet)
target_compile_definitions(ambf_bullet INTERFACE BT_USE_DOUBLE_PRECISION)
target_link_libraries(ambf_bullet INTERFACE BulletSoftBody-float64 BulletDynamics-float64 BulletCollision-float64 LinearMath-float64)

find_package(yaml-cpp REQUIRED)
find_package(assimp REQUIRED)
find_package(glfw3 REQUIRED)

option(AMBF_WITH_ROS "Build the ROS 1 messages and the built-in ROS communication (needs catkin and roscpp)" ON)
if(AMBF_WITH_ROS)
  find_package(roscpp QUIET)
  if(NOT roscpp_FOUND)
    message(STATUS "roscpp not found: building without ROS. The simulator will run, but offer no topics.")
    set(AMBF_WITH_ROS OFF)
  endif()
endif()

if(AMBF_BUILD_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
