# Runs when indet is installed: makes the man pages (if help2man is there) and the completion of bash, in `folder`, by the
# program `indet`, and installs them.
execute_process(COMMAND ${indet} completion bash OUTPUT_FILE ${folder}/indet.bash COMMAND_ERROR_IS_FATAL ANY)
file(INSTALL DESTINATION ${CMAKE_INSTALL_PREFIX}/${completion_destination} TYPE FILE RENAME indet
  FILES ${folder}/indet.bash)

if(NOT help2man)
  message(STATUS "No man pages: help2man is missing")
  return()
endif()
foreach(subcommand IN ITEMS "" simulate import analyze limit compare sample ensemble submit status merge report inspect verify export trajectory
    completion)
  string(REGEX REPLACE "-$" "" page indet-${subcommand})
  execute_process(COMMAND ${help2man} --no-info --no-discard-stderr --version-string=${version} --name=${description}
      --output=${folder}/${page}.1 "${indet} ${subcommand}"
    COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL DESTINATION ${CMAKE_INSTALL_PREFIX}/${manual_destination} TYPE FILE FILES ${folder}/${page}.1)
endforeach()
