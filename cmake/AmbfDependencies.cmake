# Third-party packages, all from Debian. Interface targets mark their headers as SYSTEM.
find_package(Threads REQUIRED)

find_package(Bullet CONFIG CONFIGS BulletConfig-float64.cmake QUIET)
if(NOT Bullet_FOUND)
  message(FATAL_ERROR "Bullet (double precision) not found. "
                      "On Debian: apt-get install libbullet-dev, or run './dev deps'.")
endif()
add_library(ambf_bullet INTERFACE)
target_include_directories(ambf_bullet SYSTEM INTERFACE /usr/include/bullet)
target_compile_definitions(ambf_bullet INTERFACE BT_USE_DOUBLE_PRECISION)
target_link_libraries(ambf_bullet INTERFACE
  BulletSoftBody-float64
  BulletDynamics-float64
  BulletCollision-float64
  LinearMath-float64)

find_package(yaml-cpp REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(pugixml REQUIRED)
find_package(assimp REQUIRED)  # these two in a process of their own
find_package(urdfdom REQUIRED)
find_package(glfw3 REQUIRED)
find_path(AMBF_IMGUI_INCLUDE imgui/imgui.h)
find_library(AMBF_IMGUI_LIBRARY imgui)
find_library(AMBF_STB_LIBRARY stb)  # which Debian's Dear ImGui reads fonts with
mark_as_advanced(AMBF_IMGUI_INCLUDE AMBF_IMGUI_LIBRARY AMBF_STB_LIBRARY)
if(NOT AMBF_IMGUI_INCLUDE OR NOT AMBF_IMGUI_LIBRARY OR NOT AMBF_STB_LIBRARY)
  message(FATAL_ERROR "Dear ImGui not found. On Debian: apt-get install libimgui-dev, or run './dev deps'.")
endif()
add_library(ambf_imgui INTERFACE)
target_include_directories(ambf_imgui SYSTEM INTERFACE ${AMBF_IMGUI_INCLUDE})
target_link_libraries(ambf_imgui INTERFACE ${AMBF_IMGUI_LIBRARY} ${AMBF_STB_LIBRARY})
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)   # textures
find_package(JPEG REQUIRED)

option(AMBF_WITH_ROS "Build the ROS 1 messages and the built-in ROS communication (needs catkin and roscpp)" ON)
if(AMBF_WITH_ROS)
  find_package(roscpp QUIET)
  # Looked for by file: finding catkin's packages here would set catkin up for the whole tree instead of for ambf_msgs.
  find_file(AMBF_MESSAGE_GENERATION message_generation/cmake/message_generationConfig.cmake PATH_SUFFIXES share)
  find_file(AMBF_STD_MSGS_HEADER std_msgs/msg/Header.msg PATH_SUFFIXES share)
  mark_as_advanced(AMBF_MESSAGE_GENERATION AMBF_STD_MSGS_HEADER)
  set(missing)
  if(NOT roscpp_FOUND)
    list(APPEND missing libroscpp-dev)
  endif()
  if(NOT AMBF_MESSAGE_GENERATION)
    list(APPEND missing ros-message-generation)
  endif()
  if(NOT AMBF_STD_MSGS_HEADER)
    list(APPEND missing ros-std-msgs)
  endif()
  if(missing)
    list(JOIN missing ", " missing)
    message(STATUS "Building without ROS (missing: ${missing}). The simulator will run, but offer no topics.")
    set(AMBF_WITH_ROS OFF)
  endif()
endif()

if(AMBF_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
