# cmake --install: a tree that can be moved as a whole, for Debian 12 packages of the libraries it uses.
#
#   bin/lekalo                     lib/liblekalo_*.a              lib/cmake/lekalo (find_package(lekalo))
#   include/lekalo/{geometry,render}  include/lekalo/external.h   share/lekalo/scenes
#   share/texmf/tex/latex/lekalo, share/lekalo/publishing   share/man, share/bash-completion, share/zsh, share/fish

include(CMakePackageConfigHelpers)

if(TARGET lekalo)
  install(TARGETS lekalo RUNTIME DESTINATION bin)
endif()

set_target_properties(lekalo_geometry PROPERTIES EXPORT_NAME geometry)
if(TARGET lekalo_render)
  set_target_properties(lekalo_render PROPERTIES EXPORT_NAME render)
endif()
install(TARGETS ${lekalo_libraries} EXPORT lekalo ARCHIVE DESTINATION lib)
install(EXPORT lekalo NAMESPACE lekalo:: FILE lekaloTargets.cmake DESTINATION lib/cmake/lekalo)
install(DIRECTORY geometry render DESTINATION include/lekalo FILES_MATCHING PATTERN "*.h")
install(FILES include/lekalo/external.h DESTINATION include/lekalo)

configure_package_config_file(cmake/lekaloConfig.cmake.in ${CMAKE_BINARY_DIR}/lekaloConfig.cmake
  INSTALL_DESTINATION lib/cmake/lekalo NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/lekaloConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/lekaloConfig.cmake ${CMAKE_BINARY_DIR}/lekaloConfigVersion.cmake
  DESTINATION lib/cmake/lekalo)

install(DIRECTORY scenes/ DESTINATION share/lekalo/scenes)
install(FILES docs/man/lekalo.1 DESTINATION share/man/man1)
install(FILES tools/completions/lekalo.bash DESTINATION share/bash-completion/completions RENAME lekalo)
install(FILES tools/completions/lekalo.zsh DESTINATION share/zsh/site-functions RENAME _lekalo)
install(FILES tools/completions/lekalo.fish DESTINATION share/fish/vendor_completions.d)
install(FILES tools/viewer/viewer.js tools/viewer/LICENSE.three DESTINATION share/lekalo/viewer)
install(FILES tools/publishing/lekalo.sty DESTINATION share/texmf/tex/latex/lekalo)
install(FILES tools/publishing/lekalo.lua tools/publishing/lekalo_sphinx.py DESTINATION share/lekalo/publishing)
install(FILES LICENSE README.md DESTINATION share/doc/lekalo)
