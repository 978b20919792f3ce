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
  set(name ${description})
  if(subcommand)  # what its help begins with, up to the line with the usage
    execute_process(COMMAND ${indet} ${subcommand} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX REPLACE "\nUsage:.*" "" name "${help}")
    string(REGEX REPLACE "[ \n]+" " " name "${name}")
  endif()
  execute_process(COMMAND ${help2man} --no-info --no-discard-stderr --version-string=${version} --name=${name}
      --output=${folder}/${page}.1 "${indet} ${subcommand}"
    COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL DESTINATION ${CMAKE_INSTALL_PREFIX}/${manual_destination} TYPE FILE FILES ${folder}/${page}.1)
endforeach()
