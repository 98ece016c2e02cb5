# `cmake --install DIR --prefix P` gives a relocatable tree; `cpack -G DEB` makes a .deb of it.
#
#   bin/ambf_simulator   lib/libambf_{core,view}.so   lib/ambf/{ambf_file_reader,plugins}
#   include/ambf/<folder>/x.h   lib/cmake/AMBF
#   share/ambf/models    share/ambf/plugin_examples    share/ambf/setup.sh
#   ambf_msgs and the Python packages where catkin puts them
#
# Folders are plain lib/, not lib/<architecture>/, so that programs find the libraries beside themselves wherever the
# tree is.
include(CMakePackageConfigHelpers)
set(config_dir lib/cmake/AMBF)

install(TARGETS ambf_core ambf_view EXPORT AMBFTargets LIBRARY DESTINATION lib)
install(TARGETS ambf_file_reader RUNTIME DESTINATION lib/ambf)
install(DIRECTORY ambf_framework/ DESTINATION include/ambf
        FILES_MATCHING PATTERN "*.h" PATTERN detail EXCLUDE PATTERN ambf_framework/render EXCLUDE
        REGEX "/ambf_framework/(model|physics|mesh)/[^/.]+$" EXCLUDE)
# Other rooms of model/, physics/, mesh/ and render/ are private; of render/ there is what opens windows and takes
# pictures.
foreach(header
    camera/camera.h
    camera/stereo.h
    camera/matrix.h
    images/image_file.h
    images/jpeg.h
    pictures/offscreen.h
    gl/offscreen_backend.h
    pictures/picture_streamer.h
    pictures/video_writer.h
    scene/quality.h
    shaders/shaders.h
    window/data_recording.h
    window/viewer.h)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ambf_framework/render/${header} DESTINATION include/ambf/render/${folder})
endforeach()
# Public headers of model/ include them.
install(DIRECTORY ambf_framework/model/effectors/ DESTINATION include/ambf/model/effectors
        FILES_MATCHING PATTERN "*.h")
if(TARGET ambf_simulator)
  install(TARGETS ambf_simulator RUNTIME DESTINATION bin)
endif()
if(TARGET ambf_arm_guard)
  install(TARGETS ambf_arm_guard RUNTIME DESTINATION bin)
endif()
if(TARGET ambf_legacy_states)
  install(TARGETS ambf_legacy_states RUNTIME DESTINATION bin)
endif()
install(DIRECTORY ambf_models/ DESTINATION share/ambf/models OPTIONAL PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY ambf_client_py/ DESTINATION lib/python3/dist-packages OPTIONAL
        FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "arms.yaml"
        PATTERN examples EXCLUDE PATTERN build EXCLUDE PATTERN "*.egg-info" EXCLUDE PATTERN "__pycache__" EXCLUDE)
if(TARGET _ambf_core)
  install(TARGETS _ambf_core _ambf_view LIBRARY DESTINATION lib/python3/dist-packages)
endif()
install(DIRECTORY ambf_client_py/examples DESTINATION share/ambf OPTIONAL FILES_MATCHING PATTERN "*.py")
install(DIRECTORY ambf_plugins/examples/ DESTINATION share/ambf/plugin_examples)
install(FILES LICENSE DESTINATION share/doc/ambf RENAME copyright)
install(FILES cmake/setup.sh DESTINATION share/ambf)

# find_package(AMBF) for plugins built elsewhere
install(EXPORT AMBFTargets NAMESPACE AMBF:: DESTINATION ${config_dir})
configure_package_config_file(
  cmake/AMBFConfig.cmake.in ${PROJECT_BINARY_DIR}/AMBFConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/AMBFConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/AMBFConfig.cmake ${PROJECT_BINARY_DIR}/AMBFConfigVersion.cmake
        DESTINATION ${config_dir})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ambf)
set(CPACK_PACKAGE_CONTACT "AMBF contributors <maintainers@ambf.example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
    "python3-rosmaster, python3-rospy, python3-geometry-msgs, python3-numpy, libosmesa6, libgl1-mesa-dri")
include(CPack)
