# Completion for bash and zsh, and manual pages where help2man is installed, made from the program's help.
# They are part of a whole build, not of the target culet: the first command need not wait for them.
set(completion ${CMAKE_BINARY_DIR}/completion)
add_custom_command(OUTPUT ${completion}/culet ${completion}/_culet
  COMMAND sh ${CMAKE_SOURCE_DIR}/cmake/manuals/make_completion.sh $<TARGET_FILE:culet> ${completion}
  DEPENDS culet ${CMAKE_SOURCE_DIR}/cmake/manuals/make_completion.sh VERBATIM)
add_custom_target(completion ALL DEPENDS ${completion}/culet ${completion}/_culet)
install(FILES ${completion}/culet DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program OPTIONAL)
# Where zsh looks under /usr/local, and where Debian's looks under /usr.
foreach(folder site-functions vendor-completions)
  install(FILES ${completion}/_culet DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder} COMPONENT program OPTIONAL)
endforeach()

find_program(CULET_HELP2MAN help2man)
set(manuals ${CMAKE_BINARY_DIR}/man)
if(CULET_HELP2MAN)
  add_custom_command(OUTPUT ${manuals}/culet.1.gz
    COMMAND sh ${CMAKE_SOURCE_DIR}/cmake/manuals/make_man_pages.sh $<TARGET_FILE:culet> ${manuals}
    DEPENDS culet ${CMAKE_SOURCE_DIR}/cmake/manuals/make_man_pages.sh VERBATIM)
  add_custom_target(man ALL DEPENDS ${manuals}/culet.1.gz)
  file(MAKE_DIRECTORY ${manuals})
  install(DIRECTORY ${manuals}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program FILES_MATCHING PATTERN "*.1.gz")
else()
  # The package is then made without manual pages.
  add_custom_target(man)
endif()
