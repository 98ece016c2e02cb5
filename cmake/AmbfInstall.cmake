# `cmake --install` gives a relocatable tree; CPack makes a .deb of it.
include(GNUInstallDirs)
install(TARGETS ambf_framework LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
