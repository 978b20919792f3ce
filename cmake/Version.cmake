# The commit is provenance for the files that are written; a build outside git says "unknown".
find_package(Git QUIET)
set(INDET_GIT_REVISION unknown)
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${PROJECT_SOURCE_DIR} describe --always --dirty --abbrev=12
    OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(INDET_GIT_REVISION ${revision})
  endif()
endif()
