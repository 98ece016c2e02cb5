# What `pip install .` puts beside the packages that pyproject.toml names: libraries, the reader of files and the
# models, which find each other by where they are.
if(NOT TARGET _ambf_core)
  message(FATAL_ERROR "The wheel takes Python's headers and nanobind; pip fetches the latter.")
endif()
add_custom_target(ambf_wheel DEPENDS ambf_core ambf_view ambf_file_reader _ambf_core _ambf_view)

# Wheels have no links, so that each library is one file.
set_target_properties(ambf_core ambf_view PROPERTIES VERSION ${PROJECT_VERSION_MAJOR})
install(TARGETS ambf_core ambf_view LIBRARY DESTINATION ambf_core/lib NAMELINK_SKIP)
install(TARGETS ambf_file_reader RUNTIME DESTINATION ambf_core/lib/ambf)
install(TARGETS _ambf_core _ambf_view LIBRARY DESTINATION .)
install(DIRECTORY ambf_models/ DESTINATION ambf_core/models
        PATTERN scripts EXCLUDE PATTERN "__pycache__" EXCLUDE PATTERN "*.md" EXCLUDE)
